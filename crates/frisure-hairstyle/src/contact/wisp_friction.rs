//! Friction between wisps: what touches sticks together until it slips.
//!
//! docs/theory.md, "Friction"

use glam::{DMat3, DVec3};

use super::friction::{FrictionGap, Scales, Way};
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
    /// Half of the scales of either, as the own hair goes over the other: each rubs on those of the other.
    scales: [Scales; 2],
}

impl Hold {
    /// The way that the two have shifted at a separation (m).
    fn way(&self, separation: DVec3) -> Way {
        Way::new(separation - self.anchor, self.scales)
    }

    /// Energy per length of the own hair (J/m) at a separation (m).
    pub(super) fn energy(&self, separation: DVec3) -> f64 {
        self.limit * self.way(separation).energy(SLIP_DISTANCE)
    }

    /// The gradient (N/m) of [`Self::energy`].
    pub(super) fn force(&self, separation: DVec3) -> DVec3 {
        self.way(separation).force(SLIP_DISTANCE) * self.limit
    }

    /// Its Hessian (Pa) as `s I − b bᵀ + c cᵀ + d dᵀ`: s, b, and c and d.
    pub(super) fn stiffness(&self, separation: DVec3) -> (f64, DVec3, [DVec3; 2]) {
        let way = self.way(separation);
        let (s, b) = way.stiffness(SLIP_DISTANCE);
        let s = s * self.limit;
        (s, b * self.limit.sqrt(), way.ridges.map(|c| c * s.sqrt()))
    }

    /// [`Self::stiffness`] as a matrix (Pa).
    pub(super) fn hessian(&self, separation: DVec3) -> DMat3 {
        let (s, b, [c, d]) = self.stiffness(separation);
        DMat3::from_diagonal(DVec3::splat(s)) - outer(b, b) + outer(c, c) + outer(d, d)
    }

    /// The anchor after what slipped has followed. (F2)
    fn followed(&self, separation: DVec3) -> DVec3 {
        let way = self.way(separation).length;
        if way > SLIP_DISTANCE {
            separation - (separation - self.anchor) * (SLIP_DISTANCE / way)
        } else {
            self.anchor
        }
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

/// Two points that touch, seen from the guide of the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touching {
    /// The other guide, and the index of its point.
    pub(super) other: (u32, u32),
    /// Separation (m).
    pub(super) separation: DVec3,
    /// Normal force per length of the own hair (N/m).
    pub(super) force: f64,
    /// Coefficient of friction along the scales.
    pub(super) coefficient: f64,
    /// Scales of both.
    pub(super) scales: [Scales; 2],
}

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
        touching: impl Iterator<Item = Vec<Touching>>,
        spacing: f64,
    ) -> (Self, FrictionGap) {
        let mut next = Self::default();
        let mut gap = FrictionGap::default();
        let mut used = Vec::new();
        for (k, mut touching) in touching.enumerate() {
            next.starts.push(next.holds.len() as u32);
            touching.sort_unstable_by_key(|touching| touching.other);
            let before = self.of_point(k);
            let mut ended: f64 = before.iter().map(|hold| hold.limit).sum();
            for touching in touching {
                let Touching { other, separation, .. } = touching;
                let known = before.binary_search_by_key(&other, |hold| hold.other).ok();
                let known = known.map(|at| before[at]);
                let limit = touching.coefficient * touching.force;
                let anchor = known.map_or(separation, |hold| hold.followed(separation));
                if let Some(hold) = known {
                    ended -= hold.limit;
                    used.push((hold.limit * hold.way(separation).used(SLIP_DISTANCE), limit));
                }
                gap.change += (known.map_or(0.0, |hold| hold.limit) - limit).abs() * spacing;
                gap.limit += limit * spacing;
                let [own, of_other] = touching.scales;
                let scales = [own, of_other.of_other()].map(|scales| scales.weighed(0.5));
                next.holds.push(Hold { other, anchor, limit, scales });
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
        let scales = [Scales::new(DVec3::new(0.6, 0.8, 0.0), 1.4), Scales::new(DVec3::Z, 1.7)];
        Hold { other: OTHER, anchor: DVec3::new(1e-3, -2e-3, 5e-4), limit: 0.02, scales }
    }

    /// Two hairs that touch, with a normal force of 0.1 N/m.
    fn touching(separation: DVec3, along: [DVec3; 2], against: f64) -> Touching {
        let scales = along.map(|along| Scales::new(along, against));
        Touching { other: OTHER, separation, force: 0.1, coefficient: 0.5, scales }
    }

    #[test]
    fn most_friction_is_that_of_the_direction() {
        let most = |along: [DVec3; 2], shift: DVec3| {
            let press = |before: &Holds, separation| {
                before.pressed(std::iter::once(vec![touching(separation, along, 1.4)]), 1e-3).0
            };
            let held = press(&Holds::default(), DVec3::X);
            held.of_point(0)[0].force(DVec3::X + shift).length() / 0.05
        };
        let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
        // Tip towards tip: both are against the scales as they meet, along them as they part.
        let opposed = [DVec3::Y, DVec3::NEG_Y];
        same(most(opposed, DVec3::Y * 1e-3), 1.4);
        same(most(opposed, DVec3::NEG_Y * 1e-3), 1.0);
        same(most(opposed, DVec3::Z * 1e-3), 1.0);
        // Side by side one of the two is against its scales, whichever goes on: the mean of the squares.
        let alike = [DVec3::Y; 2];
        for way in [DVec3::Y, DVec3::NEG_Y] {
            same(most(alike, way * 1e-3), (0.5 * (1.0 + 1.4 * 1.4_f64)).sqrt());
        }
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
            assert!(hold.force(at).length() <= 1.7 * hold.limit * (1.0 + 1e-12));
        }
    }

    #[test]
    fn both_sides_stick_with_opposite_anchors() {
        let pressed = |before: &Holds, separation: DVec3| {
            before.pressed(std::iter::once(vec![touching(separation, [DVec3::Y; 2], 1.0)]), 1e-3)
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
        let (holds, _) = Holds::default()
            .pressed(std::iter::once(vec![touching(DVec3::X, [DVec3::Y; 2], 1.0)]), 1.0);
        let (holds, gap) = holds.pressed(std::iter::once(Vec::new()), 1.0);
        assert!(holds.of_point(0).is_empty());
        assert!((gap.change - 0.05).abs() < 1e-12);
    }
}
