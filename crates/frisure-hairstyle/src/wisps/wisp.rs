//! A wisp: the guide's curve, and how a place in the wisp is transported along it.
//!
//! The members of a wisp keep to a cross-section whose radius varies along it (Choe & Ko 2005).
//! They curl together: each is the guide displaced by a vector that turns as the *axis* of the
//! wisp turns. The axis is the guide averaged over one turn of its curl, so that neither the curl
//! nor the twist of the guide makes the hairs of a ringlet wind about each other.

use std::f64::consts::TAU;

use frisure_rod::Equilibrium;
use glam::{DMat3, DQuat, DVec3, Vec3};

/// A guide at rest, sampled evenly from root to tip.
#[derive(Clone, Debug)]
pub(crate) struct Wisp {
    pub(crate) length: f64,
    /// Distance (m) of the positions.
    spacing: f64,
    /// From the root to the tip and perhaps beyond.
    positions: Vec<DVec3>,
    /// Rotation of the axis from the root.
    turns: Vec<DQuat>,
    /// Director d1 of the guide at each position up to its tip.
    directors: Vec<Vec3>,
}

/// Longest window (m) for the axis of hair without a curl. Chosen by trial; not measured further.
const STRAIGHT_WINDOW: f64 = 0.01;

impl Wisp {
    /// Samples a guide at `samples` points, and goes on `beyond` the tip (m) for hairs that end a little farther out.
    pub(crate) fn new(guide: &Equilibrium, samples: usize, beyond: f64) -> Self {
        let line = guide.sample(samples);
        let length = guide.rod.length();
        let spacing = length / (samples - 1) as f64;
        let more = beyond_tip(guide, line[samples - 1], spacing, (beyond / spacing) as usize);
        let directors = line.iter().map(|(_, frame)| frame.x_axis.as_vec3()).collect();
        let positions: Vec<DVec3> = line.into_iter().map(|(p, _)| p).chain(more).collect();
        let strain = guide.rod.natural().mean(0.0, length).length();
        // One turn of the curl, over which its winding averages out; hair that turns less than twice has no axis to find.
        let period = TAU / strain.max(1e-9);
        let window = if period < 0.5 * length { period } else { STRAIGHT_WINDOW.min(length) };
        let half = (0.5 * window / length * (samples - 1) as f64).max(1.0);
        let turns = transported(&positions, half);
        Self { length, spacing, positions, turns, directors }
    }

    /// How far it is known, 1 for the tip.
    pub(crate) fn end(&self) -> f64 {
        (self.positions.len() - 1) as f64 * self.spacing / self.length
    }

    /// Position (m) and rotation of the axis from the root, at `x` from 0 (root) to 1 (tip) or to
    /// [`Self::end`].
    pub(crate) fn at(&self, x: f64) -> (DVec3, DQuat) {
        let last = self.positions.len() - 1;
        let place = (x.max(0.0) * self.length / self.spacing).min(last as f64);
        let i = (place as usize).min(last - 1);
        let t = place - i as f64;
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

/// Points beyond the tip, where the guide goes on with its natural strain there: the moment of a free end is zero. (The last
/// control would not do: a joint's is its turn less the natural one, so that a curl would go on straight.)
fn beyond_tip(
    guide: &Equilibrium,
    (mut p, mut frame): (DVec3, DMat3),
    spacing: f64,
    count: usize,
) -> Vec<DVec3> {
    let turn = guide.rod.natural().at(guide.rod.length()) * spacing;
    let half = DMat3::from_quat(DQuat::from_scaled_axis(0.5 * turn));
    (0..count.min(MOST_BEYOND))
        // The midpoint rule: half a turn, a step along the tangent there, half a turn.
        .map(|_| {
            frame *= half;
            p += frame.z_axis * spacing;
            frame *= half;
            p
        })
        .collect()
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

/// Parallel transport along the axis: chords over `2 half` samples.
fn transported(positions: &[DVec3], half: f64) -> Vec<DQuat> {
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
    let mut previous = axis(0);
    (0..positions.len())
        .map(|k| {
            let next = axis(k);
            // The least rotation from chord to chord: parallel transport, without twist about the axis.
            turn = (DQuat::from_rotation_arc(previous, next) * turn).normalize();
            previous = next;
            turn
        })
        .collect()
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
            let (short, long) = (Wisp::new(&of(0.06), 241, 0.03), Wisp::new(&of(0.12), 481, 0.0));
            assert!(short.end() > 1.49);
            for s in [0.05, 0.061, 0.07, 0.08, 0.089] {
                let (a, b) = (short.at(s / 0.06).0, long.at(s / 0.12).0);
                // The midpoint rule: (h |u|)²/24 of the way beyond the tip, with h = 0.25 mm and |u| = 232/m.
                assert!(a.distance(b) < 1.5e-4 * 0.03, "{s}: {}", a.distance(b));
            }
        }
    }
}
