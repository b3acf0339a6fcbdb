//! A wisp: the guide's curve, and how a place in the wisp is transported along it.
//!
//! The members of a wisp keep to a cross-section whose radius varies along it (Choe & Ko 2005).
//! They curl together: each is the guide displaced by a vector that turns as the *axis* of the
//! wisp turns. The axis is the guide averaged over one turn of its curl, so that neither the curl
//! nor the twist of the guide makes the hairs of a ringlet wind about each other.

use std::f64::consts::TAU;

use frisure_rod::Equilibrium;
use glam::{DMat3, DQuat, DVec3, Vec3};

use crate::math::smooth_step;

/// A guide at rest, sampled evenly from root to tip.
#[derive(Clone, Debug)]
pub(crate) struct Wisp {
    pub(crate) length: f64,
    /// Stations from the root to the tip, less one.
    steps: f64,
    /// The guide at the stations, from the root to the tip and perhaps beyond.
    positions: Stations,
    /// The axis that the curl winds about: means of the positions over one turn; the positions themselves without a curl.
    axis: Stations,
    /// Direction (unit) of the axis at the root.
    forward: DVec3,
    /// Rotation of the axis from the root.
    turns: Vec<DQuat>,
    /// Director d1 of the guide at each position up to its tip.
    directors: Vec<Vec3>,
}

/// Turns of the curl as shares of the guide's length: up to the first the curl winds about its axis, from the second on it
/// only bends, and the guide is its own axis. Chosen by eye; not measured.
const WINDING: (f64, f64) = (0.35, 0.5);

/// Where along a wisp: after which of its stations, and how far from there to the next one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) station: usize,
    pub(crate) part: f64,
    /// Weights of the cubic through the station before that, this one and two after it.
    weights: [f64; 4],
}

impl Place {
    fn new(station: usize, part: f64) -> Self {
        // Hermite's cubic with central differences as tangents (Catmull & Rom 1974).
        let (t, t2) = (part, part * part);
        let t3 = t2 * t;
        let weights = [
            t2 - 0.5 * (t + t3),
            1.0 - 2.5 * t2 + 1.5 * t3,
            0.5 * t + 2.0 * t2 - 1.5 * t3,
            0.5 * (t3 - t2),
        ];
        Self { station, part, weights }
    }
}

/// Points (m) at the stations of a wisp, with one more before the first and one after the last, where the line goes on straight.
#[derive(Clone, Debug)]
struct Stations(Vec<DVec3>);

impl Stations {
    /// Of at least two points.
    fn new(points: &[DVec3]) -> Self {
        let last = points.len() - 1;
        let before = points[0] * 2.0 - points[1];
        let after = points[last] * 2.0 - points[last - 1];
        Self([&[before], points, &[after]].concat())
    }

    fn last(&self) -> usize {
        self.0.len() - 3
    }

    /// The interpolating cubic through the points.
    fn at(&self, place: &Place) -> DVec3 {
        let [a, b, c, d] = place.weights;
        let near = &self.0[place.station..place.station + 4];
        near[0] * a + near[1] * b + near[2] * c + near[3] * d
    }
}

/// Longest window (m) for the axis of hair without a curl. Chosen by trial; not measured further.
const STRAIGHT_WINDOW: f64 = 0.01;

/// How far (m) beyond the end of its guide a hair can end: one whose curl drifts, or that was cut. All wisps of a head are known as far, whether
/// hair was cut or not: what is known beyond its tip turns the axis there. Chosen by trial; not measured further.
const BEYOND: f64 = 0.05;

impl Wisp {
    /// Samples a guide at `samples` points, and goes on beyond the tip, by its own length at most, for hairs that end a little farther out.
    pub(crate) fn new(guide: &Equilibrium, samples: usize) -> Self {
        let line = guide.sample(samples);
        let length = guide.rod.length();
        let spacing = length / (samples - 1) as f64;
        let strain = guide.rod.natural().mean(0.0, length).length();
        // One turn of the curl, over which its winding averages out; hair that turns less than twice has no axis to find.
        let period = TAU / strain.max(1e-9);
        let winds = 1.0 - smooth_step(WINDING.0, WINDING.1, period / length);
        let window = if period < 0.5 * length { period } else { STRAIGHT_WINDOW.min(length) };
        let half = (0.5 * window / spacing).max(1.0);
        // The mean over a turn needs half a turn more at both ends.
        let more = if winds > 0.0 { half.ceil() as usize + 1 } else { 0 };
        let beyond = ((BEYOND.min(length) / spacing) as usize).min(MOST_BEYOND);
        let after = continued(guide, line[samples - 1], length, spacing, beyond + more);
        let before = continued(guide, line[0], 0.0, -spacing, more);
        let directors = line.iter().map(|(_, frame)| frame.x_axis.as_vec3()).collect();
        let known: Vec<DVec3> = line.into_iter().map(|(p, _)| p).chain(after).collect();
        let last = known.len() - more.min(known.len() - samples);
        let axis = axis(&known, &before, half, winds, last);
        let positions = &known[..last];
        let (forward, turns) = transported(positions, half);
        Self {
            length,
            steps: (samples - 1) as f64,
            positions: Stations::new(positions),
            axis: Stations::new(&axis),
            forward,
            turns,
            directors,
        }
    }

    /// How far it is known, 1 for the tip.
    pub(crate) fn end(&self) -> f64 {
        self.positions.last() as f64 / self.steps
    }

    /// The place at `x` from 0 (root) to 1 (tip) or to [`Self::end`].
    pub(crate) fn place(&self, x: f64) -> Place {
        let last = self.positions.last();
        let place = (x.max(0.0) * self.steps).min(last as f64);
        let station = (place as usize).min(last - 1);
        Place::new(station, place - station as f64)
    }

    /// Where `x` is of each station.
    pub(crate) fn stations(&self) -> impl Iterator<Item = f64> {
        let steps = self.steps;
        (0..=self.positions.last()).map(move |station| station as f64 / steps)
    }

    /// The axis (m).
    pub(crate) fn axis(&self, place: &Place) -> DVec3 {
        self.axis.at(place)
    }

    /// The guide (m).
    pub(crate) fn guide(&self, place: &Place) -> DVec3 {
        self.positions.at(place)
    }

    /// Rotation of the axis from the root.
    pub(crate) fn turn(&self, place: &Place) -> DQuat {
        self.turn_unscaled(place).normalize()
    }

    /// What the axis makes of a vector at the root, as it turns.
    pub(crate) fn turned(&self, place: &Place, v: DVec3) -> DVec3 {
        // A rotation by a quaternion that is not of unit length is scaled by the square of its length.
        let turn = self.turn_unscaled(place);
        let (b, w) = (DVec3::new(turn.x, turn.y, turn.z), turn.w);
        let bb = b.length_squared();
        let rotated = v * (w * w - bb) + b * (2.0 * v.dot(b)) + b.cross(v) * (2.0 * w);
        rotated / (w * w + bb)
    }

    /// Direction (unit) of the axis.
    pub(crate) fn direction(&self, place: &Place) -> DVec3 {
        self.turned(place, self.forward)
    }

    fn turn_unscaled(&self, place: &Place) -> DQuat {
        let (from, to) = (self.turns[place.station], self.turns[place.station + 1]);
        // The shorter way round.
        let sign = if from.dot(to) < 0.0 { -1.0 } else { 1.0 };
        from * (1.0 - place.part) + to * (sign * place.part)
    }
}

impl Wisp {
    /// The director d1 of the guide at `x` from 0 (root) to 1 (tip).
    pub(crate) fn director(&self, x: f64) -> Vec3 {
        let last = self.directors.len() - 1;
        let place = (x.max(0.0) * self.steps).min(last as f64);
        let i = (place as usize).min(last - 1);
        let t = (place - i as f64) as f32;
        self.directors[i].lerp(self.directors[i + 1], t).normalize_or(self.directors[i])
    }
}

/// Most samples beyond the tip. A guard on memory.
const MOST_BEYOND: usize = 200;

/// Points beyond an end of the guide, `step` (m) apart, where it goes on with its natural strain at `s` (m): the moment of a
/// free end is zero. (The last control would not do: a joint's is its turn less the natural one, so that a curl would go on
/// straight.) A negative step goes back from the root.
fn continued(
    guide: &Equilibrium,
    (mut p, mut frame): (DVec3, DMat3),
    s: f64,
    step: f64,
    count: usize,
) -> Vec<DVec3> {
    let turn = guide.rod.natural().at(s) * step;
    let half = DMat3::from_quat(DQuat::from_scaled_axis(0.5 * turn));
    (0..count)
        // The midpoint rule: half a turn, a step along the tangent there, half a turn.
        .map(|_| {
            frame *= half;
            p += frame.z_axis * step;
            frame *= half;
            p
        })
        .collect()
}

/// The axis at the first `count` of the `known` points: means over `2 half` steps, of which the axis has the share `winds`.
/// `before` has the points before the first, nearest first.
fn axis(known: &[DVec3], before: &[DVec3], half: f64, winds: f64, count: usize) -> Vec<DVec3> {
    if winds == 0.0 {
        return known[..count].to_vec();
    }
    let all: Vec<DVec3> = before.iter().rev().chain(known).copied().collect();
    // ∫ of the polygon up to each point.
    let mut sum = DVec3::ZERO;
    let mut sums = vec![sum];
    for pair in all.windows(2) {
        sum += (pair[0] + pair[1]) * 0.5;
        sums.push(sum);
    }
    let integral = |x: f64| {
        let x = x.clamp(0.0, (all.len() - 1) as f64);
        let i = (x as usize).min(all.len() - 2);
        let t = x - i as f64;
        sums[i] + (all[i] * (1.0 - 0.5 * t) + all[i + 1] * (0.5 * t)) * t
    };
    let mean = |k: usize| {
        let x = (k + before.len()) as f64;
        // The window has no more than what is known on both sides.
        let half = half.min(x).min((all.len() - 1) as f64 - x);
        if half > 0.0 { (integral(x + half) - integral(x - half)) / (2.0 * half) } else { known[k] }
    };
    (0..count).map(|k| known[k].lerp(mean(k), winds)).collect()
}

/// Direction of the axis at the root, and parallel transport along it: chords over `2 half` samples.
fn transported(positions: &[DVec3], half: f64) -> (DVec3, Vec<DQuat>) {
    let last = (positions.len() - 1) as f64;
    let point = |x: f64| {
        let x = x.clamp(0.0, last);
        let i = (x as usize).min(positions.len() - 2);
        positions[i].lerp(positions[i + 1], x - i as f64)
    };
    // At the ends the window shortens; a chord of one whole turn is taken all the same.
    let axis = |k: usize| {
        let middle = (k as f64).clamp(half.min(0.5 * last), last - half.min(0.5 * last));
        (point(middle + half) - point(middle - half)).normalize_or(DVec3::NEG_Z)
    };
    let mut turn = DQuat::IDENTITY;
    let forward = axis(0);
    let mut previous = forward;
    let turns = (0..positions.len())
        .map(|k| {
            let next = axis(k);
            // The least rotation from chord to chord: parallel transport, without twist about the axis.
            turn = (DQuat::from_rotation_arc(previous, next) * turn).normalize();
            previous = next;
            turn
        })
        .collect();
    (forward, turns)
}

#[cfg(test)]
mod tests {
    use frisure_rod::{
        ElementKind, Load, Material, NaturalStrain, Options, Rod, RodSpec, Root, Section,
        TorsionConstant, equilibrium,
    };

    use super::*;

    fn weightless(length: f64) -> Rod {
        Rod::new(RodSpec {
            length,
            section: Section::from_diameter(70e-6, 1.4).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(0.004, 0.01).unwrap(),
            root: Root::from_tangent(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap(),
            load: Load::NONE,
        })
        .unwrap()
    }

    #[test]
    fn a_curl_goes_on_curling_beyond_the_end_of_its_guide() {
        for element in [ElementKind::Jointed, ElementKind::Helix] {
            let options = Options { element, ..Options::default() };
            let of = |length| equilibrium(&weightless(length), &[], &options);
            // Without weight both are the natural helix.
            let (short, long) = (Wisp::new(&of(0.06), 241), Wisp::new(&of(0.12), 481));
            assert!(short.end() > 1.49);
            for s in [0.05, 0.061, 0.07, 0.08, 0.089] {
                let (a, b) =
                    (short.guide(&short.place(s / 0.06)), long.guide(&long.place(s / 0.12)));
                // The midpoint rule: (h |u|)²/24 of the way beyond the tip, with h = 0.25 mm and |u| = 232/m.
                assert!(a.distance(b) < 1.5e-4 * 0.03, "{s}: {}", a.distance(b));
            }
        }
    }

    #[test]
    fn a_curl_winds_about_its_axis_from_the_root_to_the_tip() {
        let rest = equilibrium(&weightless(0.12), &[], &Options::default());
        let wisp = Wisp::new(&rest, 481);
        let root = wisp.place(0.0);
        let (start, along) = (wisp.axis(&root), wisp.direction(&root));
        for k in 0..=20 {
            let x = f64::from(k) / 20.0 * wisp.end();
            let place = wisp.place(x);
            let (centre, direction) = (wisp.axis(&place), wisp.direction(&place));
            let curl = wisp.guide(&place) - centre;
            assert!((wisp.turn(&place) * wisp.forward).distance(direction) < 1e-14);
            // Radius of the helix, and a straight axis.
            assert!((curl.length() - 0.004).abs() < 1e-4, "{x}: {}", curl.length());
            assert!(curl.dot(direction).abs() < 2e-4, "{x}: {}", curl.dot(direction));
            assert!((centre - start).cross(along).length() < 2e-4, "{x}");
        }
    }
}
