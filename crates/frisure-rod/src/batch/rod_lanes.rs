//! Rods side by side in lanes: what the sweeps for their derivatives share.

use glam::{DMat3, DVec3};

use super::division::Joints;
use super::elimination::{SweepResult, ValueFunction};
use super::lanes::Lanes;
use super::linear::{Mat3, Sym3, Vec3};
use super::rotation::LARGEST_SQUARE;
use crate::derivatives::AT_REST;
use crate::rod::Rod;
use crate::rotation::{RotationSeries, right_jacobian};
use crate::strain::NaturalStrain;
use crate::stumpff::stumpff;

/// Half of an element, a piece of the natural helix, and how it moves with its natural strain.
#[derive(Clone, Copy)]
pub(super) struct Half<F> {
    /// Rotation, advance (m) and first moment (m²).
    pub(super) turn: Mat3<F>,
    pub(super) advance: Vec3<F>,
    pub(super) moment: Vec3<F>,
    /// By the turn c = u⁰ h/2 of the piece: the turn of its end frame in itself, the advance (m) and the first moment (m²).
    pub(super) turn_by: Mat3<F>,
    pub(super) advance_by: Mat3<F>,
    pub(super) moment_by: Mat3<F>,
}

/// [`Half`] of one rod.
struct HalfOfOne {
    turn: DMat3,
    advance: DVec3,
    moment: DVec3,
    turn_by: DMat3,
    advance_by: DMat3,
    moment_by: DMat3,
}

impl HalfOfOne {
    /// A piece of the natural strain `strain` (rad/m) and the length `half` (m).
    fn new(strain: DVec3, half: f64) -> Self {
        // h φ_1 e_3 is the advance and h² φ_2 e_3 the first moment. docs/theory.md, "Elements"
        let c = strain * half;
        let table = stumpff(c.length_squared());
        let advance = RotationSeries::phi(1, &table, half, DVec3::Z);
        let moment = RotationSeries::phi(2, &table, half * half, DVec3::Z);
        Self {
            turn: crate::rotation::exponential(c, &table),
            advance: advance.value(c),
            moment: moment.value(c),
            turn_by: right_jacobian(c, &table),
            advance_by: advance.jacobian(c),
            moment_by: moment.jacobian(c),
        }
    }
}

impl<F: Lanes> Half<F> {
    fn zero(zero: F) -> Self {
        let (v, m) = (Vec3::splat(zero), Mat3::splat(zero));
        Self { turn: m, advance: v, moment: v, turn_by: m, advance_by: m, moment_by: m }
    }

    fn set(&mut self, lane: usize, one: &HalfOfOne) {
        self.turn.set(lane, &one.turn);
        self.advance.set(lane, one.advance);
        self.moment.set(lane, one.moment);
        self.turn_by.set(lane, &one.turn_by);
        self.advance_by.set(lane, &one.advance_by);
        self.moment_by.set(lane, &one.moment_by);
    }
}

/// Rods of the same number of elements, each at rest in its own weight.
pub(super) struct RodLanes<F> {
    /// Two for each element, or one for all.
    pub(super) halves: Vec<Half<F>>,
    pub(super) root: Mat3<F>,
    /// K (N m), apparent weight per length (N/m), the vertical against it (world), and length of an element (m).
    pub(super) stiffness: Vec3<F>,
    pub(super) weight: F,
    pub(super) up: Vec3<F>,
    pub(super) spacing: F,
}

impl<F: Lanes> RodLanes<F> {
    /// Space for rods; `uniform` says that each has the same natural strain all along.
    #[inline(always)]
    pub(super) fn new(zero: F, elements: usize, uniform: bool) -> Self {
        Self {
            halves: vec![Half::zero(zero); if uniform { 1 } else { 2 * elements }],
            root: Mat3::splat(zero),
            stiffness: Vec3::splat(zero.splat(1.0)),
            weight: zero,
            up: Vec3::splat(zero),
            spacing: zero.splat(1.0),
        }
    }

    /// Sets the rod of a lane, with its division.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, rod: &Rod, joints: &Joints) {
        self.root.set(lane, &rod.root().frame());
        self.stiffness.set(lane, joints.stiffness);
        self.weight.set(lane, rod.weight());
        self.up.set(lane, rod.up());
        self.spacing.set(lane, joints.h);
        let half = 0.5 * joints.h;
        match rod.natural() {
            NaturalStrain::Uniform(strain) => {
                let one = HalfOfOne::new(*strain, half);
                self.halves.iter_mut().for_each(|place| place.set(lane, &one));
            }
            NaturalStrain::Varying(_) => {
                for (place, strain) in self.halves.iter_mut().zip(rod.natural().means(half)) {
                    place.set(lane, &HalfOfOne::new(strain, half));
                }
            }
        }
    }

    /// What is beyond a joint, with the weight at the joint; `after` is the frame there. (L3)
    #[inline(always)]
    pub(super) fn bearing(
        &self,
        arm: Vec3<F>,
        after: Mat3<F>,
        slope: Vec3<F>,
        hessian: Sym3<F>,
    ) -> ValueFunction<F> {
        let half = self.weight.splat(0.5);
        let up = after.transpose_mul(self.up);
        let slope = slope + arm.cross(up);
        ValueFunction {
            slope,
            exact_slope: slope,
            hessian: hessian.add_outer(arm * half, up).add_diagonal(Vec3::splat(-arm.dot(up))),
        }
    }
}

/// The halves of an element, before and after its joint.
pub(super) fn both<F>(halves: &[Half<F>], element: usize) -> [&Half<F>; 2] {
    match halves {
        [same] => [same; 2],
        halves => [&halves[2 * element], &halves[2 * element + 1]],
    }
}

/// Whether a rod is at a minimum, with its rotations in the range of the series, as a sweep over it has found.
pub(super) fn is_minimum<F: Lanes>(result: &SweepResult<F>, lane: usize, rod: &Rod) -> bool {
    let at_rest = result.gradient.get(lane).sqrt() <= AT_REST * rod.moment_scale();
    // NaN fails too.
    at_rest && result.turned.get(lane) < LARGEST_SQUARE && result.pivot.get(lane) > 0.0
}
