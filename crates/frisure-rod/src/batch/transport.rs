//! The constant rotation from each joint to the next.

use super::division::Joints;
use super::lanes::Lanes;
use super::linear::Mat3;

/// C after each joint of each rod; one for all joints if every rod has the same C after each of its joints.
pub(super) struct Transport<F>(Vec<Mat3<F>>);

impl<F: Lanes> Transport<F> {
    /// Space for `n` joints, or for one that stands for all.
    #[inline(always)]
    pub(super) fn new(zero: F, n: usize, uniform: bool) -> Self {
        Self(vec![Mat3::splat(zero); if uniform { 1 } else { n }])
    }

    /// Sets those of one rod; there is none after the last joint.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, joints: &Joints) {
        let between = joints.arms.len() - 1;
        for (i, turn) in self.0.iter_mut().enumerate().take(between) {
            turn.set(lane, joints.turn(i));
        }
    }

    /// C after a joint.
    #[inline(always)]
    pub(super) fn after(&self, joint: usize) -> &Mat3<F> {
        if self.0.len() == 1 { &self.0[0] } else { &self.0[joint] }
    }
}
