//! Nodes of rods at rest, in lanes.

use fearless_simd::{Level, dispatch};
use glam::{DMat3, DVec3};

use super::division::Joints;
use super::lanes::Lanes;
use super::linear::{Mat3, Vec3};
use super::rotation::{LARGEST_SQUARE, RotationTable};
use super::solution::BatchSolution;
use super::solver::{f64s, uniform};
use crate::rod::Rod;

/// One element of each rod.
#[derive(Clone, Copy)]
struct NodeJoint<F> {
    /// c (rad).
    control: Vec3<F>,
    /// From the joint to the next, and to the end of the element (m), in the frame after the joint.
    link: Vec3<F>,
    second: Vec3<F>,
}

/// Rods side by side, each divided into the same number of elements.
struct NodeBundle<F> {
    joints: Vec<NodeJoint<F>>,
    /// C after each joint but the last, or one for all; the rotation of the half after each joint, as it is wanted.
    turns: Vec<Mat3<F>>,
    seconds: Vec<Mat3<F>>,
    /// Position (m) and frame of the root, and before the first joint.
    root: (Vec3<F>, Mat3<F>),
    start: (Vec3<F>, Mat3<F>),
}

/// What is made of the position (m) and the frame of a node of a rod; of the frame only where it is wanted.
trait Place {
    const FRAMES: bool;
    fn put(&mut self, index: usize, position: DVec3, frame: impl FnOnce() -> DMat3);
}

impl Place for &mut [DVec3] {
    const FRAMES: bool = false;

    #[inline(always)]
    fn put(&mut self, index: usize, position: DVec3, _: impl FnOnce() -> DMat3) {
        self[index] = position;
    }
}

impl Place for &mut [[f64; 3]] {
    const FRAMES: bool = false;

    #[inline(always)]
    fn put(&mut self, index: usize, position: DVec3, _: impl FnOnce() -> DMat3) {
        self[index] = position.to_array();
    }
}

impl Place for &mut [(DVec3, DMat3)] {
    const FRAMES: bool = true;

    #[inline(always)]
    fn put(&mut self, index: usize, position: DVec3, frame: impl FnOnce() -> DMat3) {
        self[index] = (position, frame());
    }
}

impl<F: Lanes> NodeBundle<F> {
    #[inline(always)]
    fn new(zero: F, elements: usize, uniform: bool, frames: bool) -> Self {
        let (v, m) = (Vec3::splat(zero), Mat3::splat(zero));
        let turns = if uniform { 1 } else { elements };
        Self {
            joints: vec![NodeJoint { control: v, link: v, second: v }; elements],
            turns: vec![m; turns],
            seconds: vec![m; if frames { turns } else { 0 }],
            root: (v, m),
            start: (v, m),
        }
    }

    #[inline(always)]
    fn load(&mut self, lane: usize, joints: &Joints, controls: &[DVec3]) {
        self.root.0.set(lane, joints.root.0);
        self.root.1.set(lane, &joints.root.1);
        self.start.0.set(lane, joints.start);
        self.start.1.set(lane, &joints.frame);
        for (i, turn) in self.turns.iter_mut().enumerate() {
            // There is none after the last joint.
            if !joints.turns.is_empty() {
                turn.set(lane, joints.turn(i.min(controls.len().saturating_sub(2))));
            }
        }
        for (i, second) in self.seconds.iter_mut().enumerate() {
            second.set(lane, &joints.halves(i)[1].turn);
        }
        for (i, (joint, control)) in self.joints.iter_mut().zip(controls).enumerate() {
            joint.control.set(lane, *control);
            joint.link.set(lane, joints.links[i]);
            joint.second.set(lane, joints.halves(i)[1].advance);
        }
    }

    /// The position (m) of each node, and the frame that half a turn makes of the one after its joint, from root to tip.
    #[inline(always)]
    fn nodes(&self, mut node: impl FnMut(usize, Vec3<F>, &Mat3<F>, Option<&Mat3<F>>)) {
        let (mut position, mut frame) = self.start;
        node(0, self.root.0, &self.root.1, None);
        for (i, joint) in self.joints.iter().enumerate() {
            let after = frame.mul_mat(RotationTable::of(joint.control).rotation(joint.control));
            let second = self.seconds.get(i).or(self.seconds.first());
            node(i + 1, position + after.mul_vec(joint.second), &after, second);
            position = position + after.mul_vec(joint.link);
            let turn = if self.turns.len() == 1 { &self.turns[0] } else { &self.turns[i] };
            frame = after.mul_mat(*turn);
        }
    }
}

impl BatchSolution {
    /// The positions (m) of the nodes of the rods that were solved, one more for each than elements, those of a rod one after the other,
    /// the root first: what [`Self::shape`] has of each, computed on this thread.
    ///
    /// # Panics
    /// If the rods are not as many as were solved.
    #[must_use]
    pub fn positions(&self, rods: &[Rod]) -> Vec<DVec3> {
        let mut positions = vec![DVec3::ZERO; rods.len() * (self.elements + 1)];
        let place = positions.as_mut_slice();
        dispatch!(Level::new(), simd => in_lanes(f64s(simd), rods, self, place));
        positions
    }

    /// Puts the [`Self::positions`] (m) into memory that is there.
    ///
    /// # Panics
    /// If the rods are not as many as were solved, or the places fewer than the nodes.
    pub fn put_positions(&self, rods: &[Rod], places: &mut [[f64; 3]]) {
        assert!(places.len() >= rods.len() * (self.elements + 1), "a place for each node");
        dispatch!(Level::new(), simd => in_lanes(f64s(simd), rods, self, &mut *places));
    }

    /// [`Self::positions`], and the frame at each node: its columns are d1, d2 and the tangent.
    ///
    /// # Panics
    /// As [`Self::positions`].
    #[must_use]
    pub fn nodes(&self, rods: &[Rod]) -> Vec<(DVec3, DMat3)> {
        let mut nodes = vec![(DVec3::ZERO, DMat3::IDENTITY); rods.len() * (self.elements + 1)];
        let place = nodes.as_mut_slice();
        dispatch!(Level::new(), simd => in_lanes(f64s(simd), rods, self, place));
        nodes
    }
}

#[inline(always)]
fn in_lanes<F: Lanes, P: Place>(zero: F, rods: &[Rod], found: &BatchSolution, mut place: P) {
    assert_eq!(rods.len(), found.rods.len(), "the rods that were solved");
    let n = found.elements;
    let mut bundle = NodeBundle::new(zero, n, uniform(rods), P::FRAMES);
    let mut joints = Joints::default();
    for first in (0..rods.len()).step_by(F::LANES) {
        let lanes = F::LANES.min(rods.len() - first);
        for (lane, rod) in (0..lanes).zip(first..) {
            joints.divide(&rods[rod], n);
            bundle.load(lane, &joints, &found.controls[rod * n..(rod + 1) * n]);
        }
        bundle.nodes(|node, position, after, second| {
            let frame = if P::FRAMES { second.map(|second| after.mul_mat(*second)) } else { None };
            let frame = frame.as_ref().unwrap_or(after);
            for (lane, rod) in (0..lanes).zip(first..) {
                place.put(rod * (n + 1) + node, position.get(lane), || frame.get(lane));
            }
        });
        // Joints that turn farther than the series reach.
        for (rod, of) in rods.iter().enumerate().skip(first).take(lanes) {
            let controls = &found.controls[rod * n..(rod + 1) * n];
            if controls.iter().any(|c| !(c.length_squared() < LARGEST_SQUARE)) {
                let shape = found.shape(of, rod);
                let nodes = shape.positions.iter().zip(&shape.frames).enumerate();
                nodes.for_each(|(node, (x, r))| place.put(rod * (n + 1) + node, *x, || *r));
            }
        }
    }
}
