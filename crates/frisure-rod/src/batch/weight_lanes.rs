//! Rods in their own weight, into and out of the lanes.

use glam::DVec3;

use super::division::Joints;
use super::elimination::SweepResult;
use super::lanes::Lanes;
use super::linear::Vec3;
use super::newton::LaneSweeps;
use super::transport::Transport;
use super::weight_sweep::{Bundle, Joint};
use crate::stumpff::stumpff;

/// Lanes of rods without contact.
pub(super) struct WeightLanes<F>(pub(super) Bundle<F>);

impl<F: Lanes> WeightLanes<F> {
    /// Lanes for rods of `n` joints. `uniform`: every rod has the same rotation between all of its joints.
    #[inline(always)]
    pub(super) fn new(zero: F, n: usize, uniform: bool) -> Self {
        Self(Bundle {
            joints: vec![Joint::zero(zero); n],
            transport: Transport::new(zero, n, uniform),
            root: Vec3::splat(zero),
            stiffness: Vec3::splat(zero.splat(1.0)),
        })
    }
}

impl<F: Lanes> LaneSweeps<F> for WeightLanes<F> {
    #[inline(always)]
    fn load(&mut self, lane: usize, _: usize, joints: &Joints, start: &[DVec3]) -> Option<f64> {
        let Self(bundle) = self;
        bundle.root.set(lane, joints.up);
        bundle.stiffness.set(lane, joints.stiffness);
        let mut up = joints.up;
        let mut energy = 0.0;
        let last = start.len() - 1;
        bundle.transport.set(lane, joints);
        for (i, control) in start.iter().enumerate() {
            // The vertical after the joint, y = exp(−[c]×) ζ. (L1), (L2)
            if *control != DVec3::ZERO {
                let table = stumpff(control.length_squared());
                let once = control.cross(up);
                up += control.cross(once) * table[2] - once * table[1];
            }
            let joint = &mut bundle.joints[i];
            joint.arm.set(lane, joints.arms[i]);
            joint.control.set(lane, *control);
            joint.up.set(lane, up);
            // In f64 also where lanes are f32: the energy at the start is compared with all later ones.
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
    fn backward(&mut self, accepted: F::Mask, damping: F) -> SweepResult<F> {
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
