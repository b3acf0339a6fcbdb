//! Rollers, inside the windings of the hair on them.
//!
//! Each wisp is wound by itself, but rollers do not pass through each other, and on a head several neighbouring locks share one. So
//! those rollers are there, the roundest windings first, that have room beside the others.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::accessory::Accessory;
use super::kind::AccessoryKind;
use super::mesh::{Axis, turned};
use super::place::clearance;
use super::winding::{Winding, span};
use crate::hairstyle::{Grip, Hairstyle, Mould};
use crate::head::Head;
use crate::parallel;

/// Least turns of hair that is on a roller. Chosen: less does not hold one.
const TURNS: f64 = 0.75;

/// Least radius of a roller over that of the helix that its hair is held in: hair that lies flatter or is pulled longer is wound on
/// nothing round. Chosen by eye.
const ROUND: f64 = 0.5;

/// Length (m) of hair at the root that comes to the roller rather than lying on it. Chosen.
const COMING: f64 = 0.01;

/// How far (m) a roller reaches beyond its winding on either side. Chosen.
const BEYOND: f64 = 6e-3;

/// Longest roller (m). Chosen: usual ones have 60 to 70 mm.
const LONGEST: f64 = 0.07;

/// Shortest roller over its radius: a flat winding is at the foot of a roller that stands on the skin. Chosen.
const SHORTEST: f64 = 1.6;

/// Distance (m) of a roller from the skin at least. Chosen: less than the thickness of hair between them.
const OFF_SKIN: f64 = 1e-3;

/// Thickness of its wall, and radius of its rounded rims, over its radius. Chosen.
const WALL: f64 = 0.16;

/// A roller that could be.
#[derive(Clone, Debug)]
struct Candidate {
    axis: Axis,
    radius: f64,
    /// From the centre to either end along the axis (m).
    ends: (f64, f64),
    wisp: usize,
    /// Its radius over that of the helix.
    round: f64,
}

/// The rollers of a hairstyle.
pub(super) fn rollers(hairstyle: &Hairstyle, head: &Head) -> Vec<Accessory> {
    let held = hairstyle.wisps().iter().enumerate().filter_map(|(i, wisp)| match wisp.grip {
        Some(Grip::Mould { mould: Mould::Roller { radius, .. }, .. }) => Some((i, radius)),
        _ => None,
    });
    let held: Vec<(usize, f64)> = held.collect();
    let candidates = parallel::map_slice(&held, |&(i, radius)| {
        let winding = Winding::of(i, &hairstyle.equilibria()[i], TURNS)?;
        Candidate::new(&winding, radius, head)
    });
    let mut candidates: Vec<Candidate> = candidates.into_iter().flatten().collect();
    candidates.sort_by(|a, b| b.round.total_cmp(&a.round).then(a.wisp.cmp(&b.wisp)));
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in candidates {
        if kept.iter().all(|other| other.is_clear_of(&candidate)) {
            kept.push(candidate);
        }
    }
    kept.sort_by_key(|roller| roller.wisp);
    kept.into_iter().filter_map(|roller| roller.accessory(head)).collect()
}

impl Candidate {
    /// The roller inside a winding of hair that is held in a helix of this radius (m), as far as skin leaves room; none if it does not.
    fn new(winding: &Winding, helix: f64, head: &Head) -> Option<Self> {
        let axis = winding.axis;
        let spacing = winding.points.get(1)?.distance(winding.points[0]).max(1e-6);
        let coming = (COMING / spacing) as usize;
        let wound = &winding.points[coming.min(winding.points.len() - 1)..];
        let off = |p: &DVec3| axis.split(*p).1.length();
        let radius = wound.iter().map(off).fold(helix, f64::min);
        if radius < ROUND * helix {
            return None;
        }
        let (low, high) = span(wound, &axis);
        let (middle, least) = (0.5 * (low + high), SHORTEST * radius);
        let reach = (0.5 * (high - low) + BEYOND).min(0.5 * LONGEST);
        let around = (middle - reach - least, middle + reach + least);
        let (lowest, highest) = room(head, &axis, radius, around)?;
        let (from, to) = ((middle - reach).max(lowest), (middle + reach).min(highest));
        if to <= from || highest - lowest < least {
            return None;
        }
        // Where skin cuts it short, it goes on at the other end.
        let missing = (least - (to - from)).max(0.0);
        let beyond = missing.min(highest - to);
        let ends = (from - (missing - beyond), to + beyond);
        Some(Self { axis, radius, ends, wisp: winding.wisp, round: radius / helix })
    }

    /// The ends of its axis (m).
    fn segment(&self) -> [DVec3; 2] {
        let at = |along: f64| self.axis.centre + along * self.axis.direction;
        [at(self.ends.0), at(self.ends.1)]
    }

    fn is_clear_of(&self, other: &Self) -> bool {
        apart(self.segment(), other.segment()) > self.radius + other.radius
    }

    fn accessory(self, head: &Head) -> Option<Accessory> {
        let (low, high) = self.ends;
        let centre = self.axis.centre + 0.5 * (low + high) * self.axis.direction;
        let axis = Axis { centre, direction: self.axis.direction };
        let length = high - low;
        let mesh = turned(axis, &tube(self.radius, length))?;
        if clearance(&mesh, head) <= 0.0 {
            return None;
        }
        let (kind, wisps, radius) = (AccessoryKind::Roller, vec![self.wisp], self.radius);
        Some(Accessory { kind, wisps, centre, axis: axis.direction, radius, length, mesh })
    }
}

/// The longest part between two places along the axis of a roller (m) in which it is off the skin; none if there is none.
fn room(head: &Head, axis: &Axis, radius: f64, (low, high): (f64, f64)) -> Option<(f64, f64)> {
    const AROUND: usize = 24;
    const STEP: f64 = 1e-3;
    let skin = head.signed_distance();
    let u = axis.direction.any_orthonormal_vector();
    let v = axis.direction.cross(u);
    let is_free = |along: f64| {
        let centre = axis.centre + along * axis.direction;
        let rim = (0..AROUND).map(|k| {
            let (sine, cosine) = (std::f64::consts::TAU * k as f64 / AROUND as f64).sin_cos();
            centre + radius * (cosine * u + sine * v)
        });
        rim.chain([centre]).all(|p| skin.value(p) > OFF_SKIN)
    };
    let count = ((high - low) / STEP) as usize;
    let (mut best, mut from) = ((0, 0), 0);
    for k in 0..=count {
        if !is_free(low + k as f64 * STEP) {
            from = k + 1;
        } else if k + 1 - from > best.1 - best.0 {
            best = (from, k + 1);
        }
    }
    let at = |k: usize| low + k as f64 * STEP;
    (best.1 > best.0).then(|| (at(best.0), at(best.1 - 1)))
}

/// The profile of a tube with rounded rims: points at a distance from the axis and along it (m), counter-clockwise.
fn tube(radius: f64, length: f64) -> Vec<[f64; 2]> {
    const ROUNDED: usize = 4;
    let wall = WALL * radius;
    let bend = (0.5 * wall).min(0.25 * length);
    let (inside, half) = (radius - wall, 0.5 * length);
    let corner = |r: f64, z: f64, quarter: usize| {
        (0..=ROUNDED).map(move |k| {
            let (sine, cosine) =
                (FRAC_PI_2 * (quarter as f64 + k as f64 / ROUNDED as f64)).sin_cos();
            [r + bend * cosine, z + bend * sine]
        })
    };
    let corners = [
        corner(radius - bend, half - bend, 0),
        corner(inside + bend, half - bend, 1),
        corner(inside + bend, bend - half, 2),
        corner(radius - bend, bend - half, 3),
    ];
    let mut profile: Vec<[f64; 2]> = corners.into_iter().flatten().collect();
    // Rims as thick as the wall make neighbouring corners one point.
    profile.dedup_by(|a, b| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9);
    profile
}

/// The least distance (m) of two straight pieces.
fn apart([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    // The least of a convex function of two parts is found by turns: each step is exact.
    const TURNS: usize = 24;
    let near = |p: DVec3, [from, to]: [DVec3; 2]| {
        let along = to - from;
        let part = (p - from).dot(along) / along.length_squared().max(1e-24);
        from + part.clamp(0.0, 1.0) * along
    };
    let mut p = 0.5 * (a + b);
    let mut q = near(p, [c, d]);
    for _ in 0..TURNS {
        p = near(q, [a, b]);
        q = near(p, [c, d]);
    }
    p.distance(q)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_as_far_apart_as_their_nearest_points() {
        let piece = |a: [f64; 3], b: [f64; 3]| [DVec3::from(a), DVec3::from(b)];
        let crossed = apart(
            piece([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            piece([0.0, -1.0, 0.5], [0.0, 1.0, 0.5]),
        );
        assert!((crossed - 0.5).abs() < 1e-9);
        let behind =
            apart(piece([0.0; 3], [1.0, 0.0, 0.0]), piece([2.0, 0.0, 0.0], [3.0, 0.0, 0.0]));
        assert!((behind - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_profile_of_a_tube_is_within_its_radius_and_length() {
        let profile = tube(0.01, 0.06);
        assert!(
            profile
                .iter()
                .all(|[r, z]| *r <= 0.01 + 1e-12 && *r > 0.008 && z.abs() <= 0.03 + 1e-12)
        );
        let shifted = profile.iter().skip(1).chain(&profile[..1]);
        let area: f64 =
            profile.iter().zip(shifted).map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum();
        assert!(area > 0.0, "counter-clockwise");
    }
}
