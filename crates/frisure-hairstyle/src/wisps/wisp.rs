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
    /// Distance (m) of the positions.
    spacing: f64,
    /// From the root to the tip and perhaps beyond.
    positions: Vec<DVec3>,
    /// The axis that the curl winds about: means of the positions over one turn; the positions themselves without a curl.
    axis: Vec<DVec3>,
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

/// How the curl of a guide lies about its axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisPoint {
    /// From the axis to the guide (m).
    pub(crate) curl: DVec3,
    /// Direction of the axis (unit).
    pub(crate) direction: DVec3,
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
        let positions = known[..last].to_vec();
        let (forward, turns) = transported(&positions, half);
        Self { length, spacing, positions, axis, forward, turns, directors }
    }

    /// How far it is known, 1 for the tip.
    pub(crate) fn end(&self) -> f64 {
        (self.positions.len() - 1) as f64 * self.spacing / self.length
    }

    /// Index of the sample before `x`, and how far it is from there to the next one.
    fn place(&self, x: f64) -> (usize, f64) {
        let last = self.positions.len() - 1;
        let place = (x.max(0.0) * self.length / self.spacing).min(last as f64);
        let i = (place as usize).min(last - 1);
        (i, place - i as f64)
    }

    /// Place on the axis (m) and rotation of the axis from the root, at `x` from 0 (root) to 1 (tip) or to [`Self::end`].
    pub(crate) fn centre(&self, x: f64) -> (DVec3, DQuat) {
        let (i, t) = self.place(x);
        (catmull_rom(&self.axis, i, t), self.turns[i].lerp(self.turns[i + 1], t).normalize())
    }

    /// The direction of the axis and the curl about it, at `x` where [`Self::centre`] is known.
    pub(crate) fn axis(&self, x: f64, (centre, turn): (DVec3, DQuat)) -> AxisPoint {
        let (i, t) = self.place(x);
        let curl = catmull_rom(&self.positions, i, t) - centre;
        AxisPoint { curl, direction: turn * self.forward }
    }

    /// Position (m) and rotation of the axis from the root, at `x` from 0 (root) to 1 (tip) or to
    /// [`Self::end`].
    pub(crate) fn at(&self, x: f64) -> (DVec3, DQuat) {
        let (i, t) = self.place(x);
        (catmull_rom(&self.positions, i, t), self.turns[i].lerp(self.turns[i + 1], t).normalize())
    }
}

impl Wisp {
    /// The director d1 of the guide at `x` from 0 (root) to 1 (tip).
    pub(crate) fn director(&self, x: f64) -> Vec3 {
        let last = self.directors.len() - 1;
        let place = (x.max(0.0) * self.length / self.spacing).min(last as f64);
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

/// The interpolating cubic through evenly spaced points, between points `i` and `i + 1`.
fn catmull_rom(points: &[DVec3], i: usize, t: f64) -> DVec3 {
    let (b, c) = (points[i], points[i + 1]);
    let a = if i > 0 { points[i - 1] } else { b * 2.0 - c };
    let d = points.get(i + 2).copied().unwrap_or(c * 2.0 - b);
    // Hermite's cubic with central differences as tangents.
    let (m0, m1) = ((c - a) * 0.5, (d - b) * 0.5);
    let (t2, t3) = (t * t, t * t * t);
    b * (2.0 * t3 - 3.0 * t2 + 1.0)
        + m0 * (t3 - 2.0 * t2 + t)
        + c * (3.0 * t2 - 2.0 * t3)
        + m1 * (t3 - t2)
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
                let (a, b) = (short.at(s / 0.06).0, long.at(s / 0.12).0);
                // The midpoint rule: (h |u|)²/24 of the way beyond the tip, with h = 0.25 mm and |u| = 232/m.
                assert!(a.distance(b) < 1.5e-4 * 0.03, "{s}: {}", a.distance(b));
            }
        }
    }

    #[test]
    fn a_curl_winds_about_its_axis_from_the_root_to_the_tip() {
        let rest = equilibrium(&weightless(0.12), &[], &Options::default());
        let wisp = Wisp::new(&rest, 481);
        let (start, along) = (wisp.centre(0.0).0, wisp.axis(0.0, wisp.centre(0.0)).direction);
        for k in 0..=20 {
            let x = f64::from(k) / 20.0 * wisp.end();
            let (centre, AxisPoint { curl, direction }) =
                (wisp.centre(x).0, wisp.axis(x, wisp.centre(x)));
            // Radius of the helix, and a straight axis.
            assert!((curl.length() - 0.004).abs() < 1e-4, "{x}: {}", curl.length());
            assert!(curl.dot(direction).abs() < 2e-4, "{x}: {}", curl.dot(direction));
            assert!((centre - start).cross(along).length() < 2e-4, "{x}");
            assert!((centre + curl).distance(wisp.at(x).0) < 1e-12);
        }
    }
}
