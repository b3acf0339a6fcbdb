//! Hairs that touch nothing, into and out of the lanes.

use glam::DVec3;

use super::joints::Joints;
use super::lanes::{Lanes, Vec3};
use super::settle::Sweeps;
use super::sweep::{Backward, Bundle, Joint};
use super::turns::Turns;
use crate::stumpff::stumpff;

/// Hairs in their own weight alone.
pub(super) struct Hanging<F>(Bundle<F>);

impl<F: Lanes> Hanging<F> {
    /// Lanes for hairs of `n` joints, between which those of each hair turn alike or not.
    #[inline(always)]
    pub(super) fn new(zero: F, n: usize, alike: bool) -> Self {
        Self(Bundle {
            joints: vec![Joint::nothing(zero); n],
            turns: Turns::new(zero, n, alike),
            root: Vec3::all(zero),
            stiffness: Vec3::all(zero.all(1.0)),
        })
    }
}

impl<F: Lanes> Sweeps<F> for Hanging<F> {
    #[inline(always)]
    fn load(&mut self, lane: usize, _: usize, joints: &Joints, start: &[DVec3]) -> Option<f64> {
        let Self(bundle) = self;
        bundle.root.set(lane, joints.up);
        bundle.stiffness.set(lane, joints.stiffness);
        let mut up = joints.up;
        let mut energy = 0.0;
        let last = start.len() - 1;
        bundle.turns.set(lane, joints);
        for (i, control) in start.iter().enumerate() {
            if *control != DVec3::ZERO {
                let table = stumpff(control.length_squared());
                let once = control.cross(up);
                up += control.cross(once) * table[2] - once * table[1];
            }
            let joint = &mut bundle.joints[i];
            joint.arm.set(lane, joints.arms[i]);
            joint.control.set(lane, *control);
            joint.up.set(lane, up);
            energy += 0.5 * control.dot(joints.stiffness * *control) + joints.arms[i].dot(up);
            if i < last {
                up = joints.turn(i).transpose() * up;
            }
        }
        Some(energy)
    }

    #[inline(always)]
    fn begin(&mut self, _: usize) {}

    #[inline(always)]
    fn backward(&mut self, accepted: F::Truth, damping: F) -> Backward<F> {
        self.0.backward(accepted, damping)
    }

    #[inline(always)]
    fn forward(&mut self) -> F {
        self.0.forward()
    }

    #[inline(always)]
    fn save(&mut self, lane: usize, _: usize, controls: &mut [DVec3]) {
        for (control, joint) in controls.iter_mut().zip(&self.0.joints) {
            *control = joint.control.get(lane);
        }
    }
}
