//! Friction between wisps: what touches sticks together until it slips.
//!
//! docs/theory.md, "Friction"

use glam::{DMat3, DVec3};

use super::friction::FrictionGap;
use crate::math::outer;

/// Distance δ (m) that two wisps shift against each other before they slip. Chosen: a tenth of the radius of a wisp, so that
/// what sticks is about as stiff as the wisps are soft, and conjugate gradients still see both.
const SLIP_DISTANCE: f64 = 5e-4;

/// Share of the mean limit of a guide's contacts below which one does not count in the ratio of forces.
const LIGHT: f64 = 0.1;

/// Two points of wisps that stick together, seen from the guide of the first.
///
/// Wisps that overlap mix: their hairs rub on each other whichever way they move, so that the shift u is the whole change of
/// the separation. They pay `μλ u²/2δ` up to u = δ, then `μλ (u − δ/2)`. (F4)
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold {
    /// The other guide, and the index of its point.
    pub(super) other: (u32, u32),
    /// Separation (m) at which they stuck.
    anchor: DVec3,
    /// μ λ_n: the most friction (N/m), per length of the own hair.
    limit: f64,
}

impl Hold {
    /// Energy per length of the own hair (J/m) at a separation (m).
    pub(super) fn energy(&self, separation: DVec3) -> f64 {
        let u = separation.distance(self.anchor);
        let within = 0.5 * u * u / SLIP_DISTANCE;
        self.limit * if u < SLIP_DISTANCE { within } else { u - 0.5 * SLIP_DISTANCE }
    }

    /// The gradient (N/m) of [`Self::energy`].
    pub(super) fn force(&self, separation: DVec3) -> DVec3 {
        let shift = separation - self.anchor;
        shift * (self.limit / shift.length().max(SLIP_DISTANCE))
    }

    /// Its Hessian (Pa) as `s I − b bᵀ`: s, and b.
    pub(super) fn stiffness(&self, separation: DVec3) -> (f64, DVec3) {
        let shift = separation - self.anchor;
        let u = shift.length();
        if u < SLIP_DISTANCE {
            return (self.limit / SLIP_DISTANCE, DVec3::ZERO);
        }
        // What slips keeps the size of its force: no stiffness along the way.
        let s = self.limit / u;
        (s, shift * (s.sqrt() / u))
    }

    /// [`Self::stiffness`] as a matrix (Pa).
    pub(super) fn hessian(&self, separation: DVec3) -> DMat3 {
        let (s, b) = self.stiffness(separation);
        DMat3::from_diagonal(DVec3::splat(s)) - outer(b, b)
    }

    /// The anchor after what slipped has followed. (F2)
    fn followed(&self, separation: DVec3) -> DVec3 {
        let shift = separation - self.anchor;
        let u = shift.length();
        if u > SLIP_DISTANCE { separation - shift * (SLIP_DISTANCE / u) } else { self.anchor }
    }
}

/// What sticks to the points of one guide.
#[derive(Clone, Debug, Default)]
pub(super) struct Holds {
    /// Where those of each point begin; one more than points.
    starts: Vec<u32>,
    /// Of each point in the order of the others.
    holds: Vec<Hold>,
}

/// Points that touch: the other, the separation (m), and the normal force per length of the own hair (N/m).
pub(super) type Touching = ((u32, u32), DVec3, f64);

impl Holds {
    pub(super) fn of_point(&self, k: usize) -> &[Hold] {
        match self.starts.get(k..k + 2) {
            Some(&[from, to]) => &self.holds[from as usize..to as usize],
            _ => &[],
        }
    }

    /// What sticks now that the points touch so: where they touched before the anchors follow what slipped, where they did not
    /// they stick as they are. Also how far forces were from the law. (F3)
    pub(super) fn pressed(
        &self,
        coefficient: f64,
        touching: impl Iterator<Item = Vec<Touching>>,
        spacing: f64,
    ) -> (Self, FrictionGap) {
        let mut next = Self::default();
        let mut gap = FrictionGap::default();
        let mut used = Vec::new();
        for (k, mut touching) in touching.enumerate() {
            next.starts.push(next.holds.len() as u32);
            touching.sort_unstable_by_key(|(other, ..)| *other);
            let before = self.of_point(k);
            let mut ended: f64 = before.iter().map(|hold| hold.limit).sum();
            for (other, separation, force) in touching {
                let limit = coefficient * force;
                let known = before.binary_search_by_key(&other, |hold| hold.other).ok();
                let known = known.map(|at| before[at]);
                let anchor = known.map_or(separation, |hold| hold.followed(separation));
                if let Some(hold) = known {
                    ended -= hold.limit;
                    used.push((hold.force(separation).length(), limit));
                }
                gap.change += (known.map_or(0.0, |hold| hold.limit) - limit).abs() * spacing;
                gap.limit += limit * spacing;
                next.holds.push(Hold { other, anchor, limit });
            }
            // What does not touch any more.
            gap.change += ended.max(0.0) * spacing;
        }
        next.starts.push(next.holds.len() as u32);
        let light = LIGHT * gap.limit / (spacing * next.holds.len().max(1) as f64);
        let heavy = used.iter().filter(|(_, limit)| *limit > light);
        gap.ratio = heavy.map(|(used, limit)| used / limit).fold(0.0, f64::max);
        (next, gap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OTHER: (u32, u32) = (7, 3);

    fn hold() -> Hold {
        Hold { other: OTHER, anchor: DVec3::new(1e-3, -2e-3, 5e-4), limit: 0.02 }
    }

    #[test]
    fn derivatives_agree_with_differences_where_it_sticks_and_where_it_slips() {
        let hold = hold();
        for shift in [DVec3::new(1e-4, 2e-4, -1e-4), DVec3::new(2e-3, -1e-3, 3e-3)] {
            let at = hold.anchor + shift;
            let h = 1e-8;
            for axis in 0..3 {
                let mut step = DVec3::ZERO;
                step[axis] = h;
                let slope = (hold.energy(at + step) - hold.energy(at - step)) / (2.0 * h);
                assert!((slope - hold.force(at)[axis]).abs() < 1e-6 * hold.limit);
                let column = (hold.force(at + step) - hold.force(at - step)) / (2.0 * h);
                let exact = hold.hessian(at).col(axis);
                assert!((column - exact).length() < 1e-5 * hold.limit / SLIP_DISTANCE);
            }
            assert!(hold.force(at).length() <= hold.limit * (1.0 + 1e-12));
        }
    }

    #[test]
    fn both_sides_stick_with_opposite_anchors() {
        let pressed = |before: &Holds, separation: DVec3| {
            before.pressed(0.5, std::iter::once(vec![(OTHER, separation, 0.1)]), 1e-3)
        };
        let (first, then) = (DVec3::X * 3e-3, DVec3::new(3e-3, 2e-3, 0.0));
        let sides = [1.0, -1.0].map(|side| {
            let (holds, gap) = pressed(&Holds::default(), first * side);
            assert_eq!((gap.ratio, gap.limit), (0.0, 0.5 * 0.1 * 1e-3));
            pressed(&holds, then * side)
        });
        let [(a, gap), (b, _)] = sides;
        assert_eq!(a.of_point(0)[0].anchor, -b.of_point(0)[0].anchor);
        // It slipped: all of its limit is used, and the anchor has followed to the slip distance.
        assert!((gap.ratio - 1.0).abs() < 1e-12 && gap.change == 0.0);
        let left = a.of_point(0)[0].anchor.distance(then);
        assert!((left - SLIP_DISTANCE).abs() < 1e-12, "{left}");
    }

    #[test]
    fn what_does_not_touch_any_more_is_let_go() {
        let (holds, _) =
            Holds::default().pressed(0.5, std::iter::once(vec![(OTHER, DVec3::X, 0.1)]), 1.0);
        let (holds, gap) = holds.pressed(0.5, std::iter::once(Vec::new()), 1.0);
        assert!(holds.of_point(0).is_empty());
        assert!((gap.change - 0.05).abs() < 1e-12);
    }
}
