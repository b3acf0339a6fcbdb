//! The shapes that rods in contact start from.

use glam::{DMat3, DQuat, DVec3};

use super::contact::ConfinementTube;
use super::division::Joints;

/// The material frames that rods start with, by their index and arc length (m).
pub type Frames<'a> = &'a (dyn Fn(usize, f64) -> DMat3 + Sync);

/// What rods in contact start from.
pub enum InitialShape<'a> {
    /// The turn of each joint (rad), those of a rod one after the other.
    Controls(Vec<DVec3>),
    /// The material frame of each rod at an arc length.
    Frames(Frames<'a>),
}

/// Fraction of its distance from the middle of the tube that a rod approaches it per link. Chosen by trial.
const APPROACH: f64 = 0.2;

/// Largest turn of a joint at the start (rad). Chosen by trial.
const LARGEST_START: f64 = 1.0;

/// The path from root to tip of a rod that starts with given frames, in the middle of its tubes.
pub(super) struct GuidedStart<'a> {
    joints: &'a Joints,
    frames: Frames<'a>,
    /// The frame before the next joint.
    before: DMat3,
    /// Position (m) of that joint, and where it would be in the middle of its tube.
    at: DVec3,
    wanted: DVec3,
}

impl<'a> GuidedStart<'a> {
    pub(super) fn new(joints: &'a Joints, frames: Frames<'a>) -> Self {
        Self { joints, frames, before: joints.frame, at: joints.start, wanted: joints.start }
    }

    /// The turn (rad) of the next joint: its link follows the tube, turned about it as the given frames.
    pub(super) fn turn(&mut self, joint: usize, rod: usize, tube: &ConfinementTube) -> DVec3 {
        let Self { joints, frames, before, at, wanted } = self;
        let link = joints.links[joint];
        // 1. The given frame after the joint.
        let node = frames(rod, (joint + 1) as f64 * joints.h);
        let mut frame = node * joints.halves(joint)[1].turn.transpose();
        // 2. Turned so that its link leads along the middle of the tube, and a little towards it.
        if tube.radius.is_finite() {
            let along = tube.centre - *wanted + (*wanted - *at) * APPROACH;
            let (from, to) = (frame * link.normalize_or(DVec3::Z), along.normalize_or_zero());
            if to != DVec3::ZERO {
                frame = DMat3::from_quat(DQuat::from_rotation_arc(from, to)) * frame;
            }
            *wanted = tube.centre;
        }
        // 3. The turn of the joint to that frame, limited.
        let turn = DQuat::from_mat3(&(before.transpose() * frame)).normalize().to_scaled_axis();
        let turn = turn.clamp_length_max(LARGEST_START);
        frame = *before * DMat3::from_quat(DQuat::from_scaled_axis(turn));
        *at += frame * link;
        if joint + 1 < joints.links.len() {
            *before = frame * *joints.turn(joint);
        }
        turn
    }
}
