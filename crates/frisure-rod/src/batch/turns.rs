//! How frames turn from each joint to the next, which no step changes.

use super::joints::Joints;
use super::lanes::{Lanes, Mat3};

/// C after each joint of each hair; one for all joints if those of every hair are alike.
pub(super) struct Turns<F>(Vec<Mat3<F>>);

impl<F: Lanes> Turns<F> {
    /// Room for `n` joints, or for one that stands for all.
    #[inline(always)]
    pub(super) fn new(zero: F, n: usize, alike: bool) -> Self {
        Self(vec![Mat3::all(zero); if alike { 1 } else { n }])
    }

    /// Takes over a hair's; there is none after the last joint.
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
