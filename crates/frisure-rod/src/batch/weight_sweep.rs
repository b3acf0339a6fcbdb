//! Newton's sweeps for rods in their own weight: backward for the feedback laws, forward to apply them.
//!
//! The quadratic model of the energy beyond a joint is carried from tip to root with the turns of the joints eliminated
//! (differential dynamic programming, as in [`crate::minimise`]). Under weight alone it depends on a frame only through
//! the vertical y seen in it, docs/theory.md, "Rods in lanes", (L2) to (L7).

use super::elimination::{
    Elimination, Stiffness, SweepResult, ValueFunction, add_joint_energy, stepped,
};
use super::lanes::Lanes;
use super::linear::{Mat3, Sym3, Vec3};
use super::rotation::RotationTable;
use super::transport::Transport;

/// One joint of each rod.
#[derive(Clone, Copy)]
pub(super) struct Joint<F> {
    /// a (N m).
    pub(super) arm: Vec3<F>,
    /// Its turn c (rad), and y: the vertical in the frame after it.
    pub(super) control: Vec3<F>,
    pub(super) up: Vec3<F>,
    /// The same after the trial step.
    pub(super) trial: Vec3<F>,
    pub(super) trial_up: Vec3<F>,
    /// Feedback law: the step is `−(step + gainᵀ θ)`, θ the turn of the vertical before the joint.
    step: Vec3<F>,
    gain: Mat3<F>,
    /// `exp([c]×)`.
    rotation: Mat3<F>,
}

impl<F: Lanes> Joint<F> {
    pub(super) fn zero(zero: F) -> Self {
        let (v, m) = (Vec3::splat(zero), Mat3::splat(zero));
        Self { arm: v, control: v, up: v, trial: v, trial_up: v, step: v, gain: m, rotation: m }
    }

    /// The step without feedback (rad).
    #[cfg(test)]
    pub(super) fn feedforward(&self, lane: usize) -> glam::DVec3 {
        -self.step.get(lane)
    }
}

/// Rods side by side, each divided into the same number of joints.
pub(super) struct Bundle<F> {
    pub(super) joints: Vec<Joint<F>>,
    pub(super) transport: Transport<F>,
    /// ζ: the vertical in the frame before the first joint.
    pub(super) root: Vec3<F>,
    /// K (N m).
    pub(super) stiffness: Vec3<F>,
}

impl<F: Lanes> Bundle<F> {
    /// Accepts the trial where `accepted`, and computes the feedback laws of the next step with the stiffness
    /// `(1 + damping) K`.
    #[inline(always)]
    pub(super) fn backward(&mut self, accepted: F::Mask, damping: F) -> SweepResult<F> {
        let zero = damping.splat(0.0);
        let half = damping.splat(0.5);
        let stiffness = Stiffness::new(self.stiffness, damping);
        let mut result = SweepResult::new(zero);
        let mut hessian = Sym3::splat(zero);
        let (mut slope, mut exact_slope) = (Vec3::splat(zero), Vec3::splat(zero));
        for i in (0..self.joints.len()).rev() {
            // 1. The shape.
            let joint = &mut self.joints[i];
            let c = Vec3::select(accepted, joint.trial, joint.control);
            let up = Vec3::select(accepted, joint.trial_up, joint.up);
            (joint.control, joint.up) = (c, up);
            // 2. The weight at the joint: y·a to second order, g += a × y, P += ½ (a yᵀ + y aᵀ) − (a·y) I. (L3)
            let arm = joint.arm;
            let moment = arm.cross(up);
            let value = ValueFunction {
                slope: slope + moment,
                exact_slope: exact_slope + moment,
                hessian: hessian.add_outer(arm * half, up).add_diagonal(Vec3::splat(-arm.dot(up))),
            };
            // 3. The joint eliminated. (L4) to (L6)
            let eliminated = Elimination::new(c, &stiffness, &value, &mut result);
            joint.step = eliminated.step();
            joint.gain = eliminated.feedback(eliminated.by_turn);
            joint.rotation = eliminated.rotation;
            if i == 0 {
                break;
            }
            // 4. Into the frame after the joint before: C exp([c]×).
            let back = self.transport.after(i - 1).mul_mat(eliminated.rotation);
            slope = back.mul_vec(eliminated.reduce_slope(value.slope, eliminated.by_turn));
            exact_slope = back.mul_vec(value.exact_slope);
            hessian = back.congruence(eliminated.reduce_hessian(value.hessian, eliminated.by_turn));
        }
        result
    }

    /// Tries the step; the energy there (J), without the part that no joint changes.
    #[inline(always)]
    pub(super) fn forward(&mut self) -> F {
        let mut energy = self.root.x.splat(0.0);
        let mut before = self.root;
        let last = self.joints.len() - 1;
        for i in 0..=last {
            let joint = &mut self.joints[i];
            // 1. θ: how the vertical turned. To first order, since turns about the vertical cost nothing.
            // ζ seen through the old turn of the joint; its cross product with y is the sine of the angle between them.
            let seen = joint.rotation.transpose_mul(before);
            let turned = seen.cross(joint.up);
            // 2. The step, within the trust region. (L7)
            let feedback = joint.gain.transpose_mul(turned) + joint.step;
            let c = stepped(joint.control, feedback);
            // 3. The vertical after the joint, and the energy. (L2)
            let up = RotationTable::of(c).back(c, before);
            energy = add_joint_energy(energy, c, self.stiffness, joint.arm, up);
            (joint.trial, joint.trial_up) = (c, up);
            if i < last {
                before = self.transport.after(i).transpose_mul(up);
            }
        }
        energy
    }
}
