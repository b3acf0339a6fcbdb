//! One rod of a batch outside of the lanes: energy and gradient of a given shape, for what couples rods with each other.

use glam::{DMat3, DVec3};

use super::division::Joints;
use crate::rod::Rod;
use crate::rotation::{exponential, right_jacobian};
use crate::stumpff::stumpff;

/// A rod divided into joints and rigid links, as [`super::Batch`] divides it.
///
/// Its *contact points* are those at which a [`super::ContactField`] is evaluated: the ends of the links. The first joint,
/// which does not move, counts as point 0.
#[derive(Clone, Debug)]
pub struct JointChain {
    /// C after each joint but the last; one for all if they are equal.
    turns: Vec<DMat3>,
    /// Arm (N m) of the weight and link (m) of each joint, in the frame after it.
    arms: Vec<DVec3>,
    links: Vec<DVec3>,
    /// Frame and position (m) before the first joint.
    frame: DMat3,
    start: DVec3,
    /// The apparent vertical (world).
    up: DVec3,
    /// K (N m).
    stiffness: DVec3,
    /// The part of the energy that no joint changes (J).
    constant: f64,
    /// Length of an element (m).
    h: f64,
}

impl JointChain {
    /// Divides a rod into `elements` elements.
    ///
    /// # Panics
    /// If there are no elements.
    #[must_use]
    pub fn new(rod: &Rod, elements: usize) -> Self {
        let mut joints = Joints::default();
        joints.divide(rod, elements);
        let Joints { turns, arms, links, frame, start, h, vertical, stiffness, constant, .. } =
            joints;
        Self { turns, arms, links, frame, start, up: vertical, stiffness, constant, h }
    }

    /// Number of joints, which is that of contact points but point 0.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.links.len()
    }

    /// Arc length (m) of contact point `point`, and the length (m) of rod at it; point 0 has no length.
    #[must_use]
    pub fn at(&self, point: usize) -> (f64, f64) {
        match point {
            0 => (0.5 * self.h, 0.0),
            // As contact in the lanes: the tip has half a share.
            _ if point == self.joints() => (self.joints() as f64 * self.h, 0.5 * self.h),
            _ => ((point as f64 + 0.5) * self.h, self.h),
        }
    }

    /// Puts the contact points (m, world) of a shape, whose joints are turned by `controls` (rad), into `points`, and the frames
    /// after its joints into `frames`. Returns the energy of bending, twisting and weight (J), as [`super::RodSolution`] without
    /// contact.
    ///
    /// # Panics
    /// If the lengths do not fit: one more point than joints.
    pub fn shape(&self, controls: &[DVec3], points: &mut [DVec3], frames: &mut [DMat3]) -> f64 {
        let n = self.joints();
        assert!(controls.len() == n && points.len() == n + 1 && frames.len() == n, "a shape");
        let (mut before, mut at, mut energy) = (self.frame, self.start, self.constant);
        points[0] = at;
        for (i, &c) in controls.iter().enumerate() {
            let frame = before * exponential(c, &stumpff(c.length_squared()));
            at += frame * self.links[i];
            // (L2)
            energy += 0.5 * c.dot(self.stiffness * c) + (frame * self.arms[i]).dot(self.up);
            (points[i + 1], frames[i]) = (at, frame);
            before = frame * *self.turn(i);
        }
        energy
    }

    /// Puts the gradient (N m) of the energy by the turn of each joint into `gradient`, at a shape of [`Self::shape`]; `forces` is
    /// the gradient (N) of every other energy by the contact points.
    ///
    /// # Panics
    /// As [`Self::shape`].
    pub fn gradient(
        &self,
        controls: &[DVec3],
        points: &[DVec3],
        frames: &[DMat3],
        forces: &[DVec3],
        gradient: &mut [DVec3],
    ) {
        let n = self.joints();
        assert!(points.len() == n + 1 && forces.len() == n + 1 && gradient.len() == n, "a shape");
        // Force and moment about joint i of all that is beyond it; a turn ε of the frame after it changes the energy by ε·M.
        let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
        for i in (0..n).rev() {
            let (c, frame) = (controls[i], frames[i]);
            force += forces[i + 1];
            moment +=
                (points[i + 1] - points[i]).cross(force) + (frame * self.arms[i]).cross(self.up);
            let jacobian = right_jacobian(c, &stumpff(c.length_squared()));
            // r = Jᵀ Gᵀ M + K c. (L4)
            gradient[i] = jacobian.transpose() * (frame.transpose() * moment) + self.stiffness * c;
        }
    }

    /// Arm (N m) of the weight that a joint bears, in the frame after it.
    pub(super) fn arm(&self, joint: usize) -> DVec3 {
        self.arms[joint]
    }

    /// The apparent vertical (world).
    pub(super) fn up(&self) -> DVec3 {
        self.up
    }

    /// Stiffness of each joint (N m).
    #[must_use]
    pub fn stiffness(&self) -> DVec3 {
        self.stiffness
    }

    fn turn(&self, joint: usize) -> &DMat3 {
        // What is after the last joint is not used.
        self.turns.get(joint).or(self.turns.last()).unwrap_or(&DMat3::IDENTITY)
    }
}
