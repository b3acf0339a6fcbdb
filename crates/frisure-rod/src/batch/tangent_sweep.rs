//! Sweeps for the motion of rods at rest in their own weight with their parameters: one factorisation, then two linear passes for
//! each parameter. docs/theory.md, "Rods in lanes", (L14) to (L16).

use super::elimination::{Elimination, Pivot, Stiffness, SweepResult};
use super::lanes::Lanes;
use super::linear::{Mat3, Sym3, Vec3};
use super::rod_lanes::{Half, RodLanes, both};
use super::rotation::RotationTable;

/// One element of each rod, with what all directions share.
#[derive(Clone, Copy)]
pub(super) struct TangentJoint<F> {
    /// a (N m), as in [`super::weight_sweep::Joint`].
    pub(super) arm: Vec3<F>,
    /// c (rad).
    pub(super) control: Vec3<F>,
    /// Frames before the element, before the joint, after it, and at the end; the right Jacobian of the joint.
    start: Mat3<F>,
    before: Mat3<F>,
    after: Mat3<F>,
    finish: Mat3<F>,
    jacobian: Mat3<F>,
    /// Advance (m) and first moment (m²) of both halves (world).
    advance: [Vec3<F>; 2],
    halves: [Vec3<F>; 2],
    /// Position of the end from the root (m).
    end: Vec3<F>,
    /// First moment of what is beyond the joint, about it (m², world), and the length beyond the element (m).
    moment: Vec3<F>,
    beyond: F,
    /// The eliminated joint, its feedback, and the rotation into the frame after the joint before.
    pivot: Pivot<F>,
    gain: Mat3<F>,
    back: Mat3<F>,
}

impl<F: Lanes> TangentJoint<F> {
    pub(super) fn zero(zero: F) -> Self {
        let (v, m) = (Vec3::splat(zero), Mat3::splat(zero));
        Self {
            arm: v,
            control: v,
            start: m,
            before: m,
            after: m,
            finish: m,
            jacobian: m,
            advance: [v; 2],
            halves: [v; 2],
            end: v,
            moment: v,
            beyond: zero,
            pivot: Pivot::zero(zero),
            gain: m,
            back: m,
        }
    }
}

/// A change of the parameters of each rod.
pub(super) struct TangentDirection<F> {
    /// Change of the turn u⁰ h/2 (rad) of both halves of each element, or of all; empty for none.
    pub(super) turns: Vec<[Vec3<F>; 2]>,
    /// Change of the stiffness of a joint (N m), of the weight per length (N/m), and rotation of the root (rad, world).
    pub(super) stiffness: Vec3<F>,
    pub(super) weight: F,
    pub(super) rotation: Vec3<F>,
    /// Relative magnification of the whole rod, besides what it changes of strain and weight.
    pub(super) magnification: F,
}

/// What each direction leaves in a joint between its two passes.
#[derive(Clone, Copy)]
struct Passing<F> {
    /// Rotation of the joint's frame with all joints as they are (rad, world).
    carried: Vec3<F>,
    /// `H⁻¹ r`.
    step: Vec3<F>,
}

/// How a half moves with the change of its turn, in the frame before it.
#[derive(Clone, Copy)]
struct PieceChange<F> {
    /// Rotation of its end, in the frame there; advance (m); first moment (m²).
    turn: Vec3<F>,
    advance: Vec3<F>,
    moment: Vec3<F>,
}

impl<F: Lanes> PieceChange<F> {
    #[inline(always)]
    fn new(piece: &Half<F>, turn: Vec3<F>) -> Self {
        Self {
            turn: piece.turn_by.mul_vec(turn),
            advance: piece.advance_by.mul_vec(turn),
            moment: piece.moment_by.mul_vec(turn),
        }
    }
}

/// Rods side by side, each divided into the same number of elements.
pub(super) struct TangentBundle<F> {
    pub(super) joints: Vec<TangentJoint<F>>,
    pub(super) rods: RodLanes<F>,
    passing: Vec<Passing<F>>,
}

impl<F: Lanes> TangentBundle<F> {
    #[inline(always)]
    pub(super) fn new(zero: F, elements: usize, uniform: bool) -> Self {
        let v = Vec3::splat(zero);
        Self {
            joints: vec![TangentJoint::zero(zero); elements],
            rods: RodLanes::new(zero, elements, uniform),
            passing: vec![Passing { carried: v, step: v }; elements],
        }
    }

    /// Positions of the nodes from the root (m) and frames there, the root's first.
    #[inline(always)]
    pub(super) fn shape(&self, mut node: impl FnMut(usize, Vec3<F>, &Mat3<F>)) {
        node(0, Vec3::splat(self.rods.weight.splat(0.0)), &self.rods.root);
        for (i, joint) in self.joints.iter().enumerate() {
            node(i + 1, joint.end, &joint.finish);
        }
    }

    /// Factorises the Hessian of each rod, for [`Self::along`].
    #[inline(always)]
    pub(super) fn factorise(&mut self) -> SweepResult<F> {
        self.forward();
        self.backward()
    }

    /// Frames and positions, from root to tip.
    #[inline(always)]
    fn forward(&mut self) {
        let mut frame = self.rods.root;
        let mut position = Vec3::splat(self.rods.weight.splat(0.0));
        for i in 0..self.joints.len() {
            let [first, second] = both(&self.rods.halves, i);
            let joint = &mut self.joints[i];
            let table = RotationTable::of(joint.control);
            joint.jacobian = table.jacobian(joint.control);
            joint.start = frame;
            joint.before = frame.mul_mat(first.turn);
            joint.after = joint.before.mul_mat(table.rotation(joint.control));
            joint.finish = joint.after.mul_mat(second.turn);
            joint.advance = [frame.mul_vec(first.advance), joint.after.mul_vec(second.advance)];
            joint.halves = [frame.mul_vec(first.moment), joint.after.mul_vec(second.moment)];
            joint.end = position + joint.advance[0] + joint.advance[1];
            (frame, position) = (joint.finish, joint.end);
        }
    }

    /// The Hessian eliminated from tip to root. (L3) to (L6)
    #[inline(always)]
    fn backward(&mut self) -> SweepResult<F> {
        let zero = self.rods.weight.splat(0.0);
        let mut result = SweepResult::new(zero);
        let stiffness = Stiffness::new(self.rods.stiffness, zero);
        let half_length = zero.splat(0.5) * self.rods.spacing;
        let (mut slope, mut hessian) = (Vec3::splat(zero), Sym3::splat(zero));
        let (mut moment, mut beyond) = (Vec3::splat(zero), zero);
        for i in (0..self.joints.len()).rev() {
            let joint = &mut self.joints[i];
            // 1. First moments about the joint and about the start.
            joint.beyond = beyond;
            joint.moment = moment + joint.advance[1].mul_add(beyond, joint.halves[1]);
            beyond = beyond + half_length;
            moment = joint.moment + joint.advance[0].mul_add(beyond, joint.halves[0]);
            beyond = beyond + half_length;
            // 2. The weight at the joint, and the joint eliminated.
            let value = self.rods.bearing(joint.arm, joint.after, slope, hessian);
            let c = joint.control;
            let eliminated =
                Elimination::linear(c, &stiffness, &value, Vec3::splat(zero), &mut result);
            joint.pivot = eliminated.pivot();
            joint.gain = eliminated.feedback(eliminated.by_turn);
            // 3. Into the frame after the joint before.
            let frame = joint.after;
            if i > 0 {
                let back = self.joints[i - 1].after.transpose_mul_mat(frame);
                slope = back.mul_vec(value.slope);
                let left = eliminated.reduce_hessian(value.hessian, eliminated.by_turn);
                hessian = back.congruence(left);
                self.joints[i].back = back;
            }
        }
        result
    }

    /// How each node moves along a direction: a shift (m) and a rotation (rad), in the world.
    #[inline(always)]
    pub(super) fn along(
        &mut self,
        direction: &TangentDirection<F>,
        node: impl FnMut(usize, Vec3<F>, Vec3<F>),
    ) {
        let turns: &[[Vec3<F>; 2]] = &direction.turns;
        // A curl that is the same all along changes the same all along.
        let same = match (turns, self.rods.halves.as_slice()) {
            ([[first, second]], [piece]) => {
                Some([PieceChange::new(piece, *first), PieceChange::new(piece, *second)])
            }
            _ => None,
        };
        let none = Vec3::splat(self.rods.weight.splat(0.0));
        let still = PieceChange { turn: none, advance: none, moment: none };
        let halves = std::mem::take(&mut self.rods.halves);
        let change = |i: usize| match (&same, turns) {
            (Some(same), _) => *same,
            (None, []) => [still; 2],
            (None, turns) => {
                let [first, second] = both(&halves, i);
                let turn = if turns.len() == 1 { turns[0] } else { turns[i] };
                [PieceChange::new(first, turn[0]), PieceChange::new(second, turn[1])]
            }
        };
        self.carry(direction, &change);
        self.bear(direction, &change);
        self.rest(direction, &change, node);
        self.rods.halves = halves;
    }

    /// How the frame of each joint turns with the joints as they are. (L14)
    #[inline(always)]
    fn carry(
        &mut self,
        direction: &TangentDirection<F>,
        change: &impl Fn(usize) -> [PieceChange<F>; 2],
    ) {
        let mut carried = direction.rotation;
        for (i, (joint, passing)) in self.joints.iter().zip(&mut self.passing).enumerate() {
            let [first, second] = change(i);
            carried = carried + joint.before.mul_vec(first.turn);
            passing.carried = carried;
            carried = carried + joint.finish.mul_vec(second.turn);
        }
    }

    /// The change −δg of each joint's moment, and the joints eliminated with it, from tip to root. (L15)
    #[inline(always)]
    fn bear(
        &mut self,
        direction: &TangentDirection<F>,
        change: &impl Fn(usize) -> [PieceChange<F>; 2],
    ) {
        let zero = self.rods.weight.splat(0.0);
        let half_length = zero.splat(0.5) * self.rods.spacing;
        let (mut moved, mut later) = (Vec3::splat(zero), Vec3::splat(zero));
        for i in (0..self.joints.len()).rev() {
            let [first, second] = change(i);
            let earlier = match i {
                0 => direction.rotation,
                // Of the frame at the start of the element: that of the joint before, and its second half.
                _ => {
                    self.passing[i - 1].carried
                        + self.joints[i].start.mul_vec(change(i - 1)[1].turn)
                }
            };
            let (joint, passing) = (&self.joints[i], &mut self.passing[i]);
            // 1. Change of the first moment of what is beyond the joint, about it.
            let carried = passing.carried;
            let lever = joint.advance[1].mul_add(joint.beyond, joint.halves[1]);
            let piece = second.advance.mul_add(joint.beyond, second.moment);
            moved = moved + carried.cross(lever) + joint.after.mul_vec(piece);
            // 2. g = K c + Jᵀ Gᵀ (w m × e), where m × e = −e × m.
            let torque = self.rods.up.cross(joint.moment);
            let bearing = carried.cross(torque) * self.rods.weight
                - self.rods.up.cross(moved) * self.rods.weight
                - torque * direction.weight;
            let right = direction.stiffness.component_mul(joint.control)
                + joint.jacobian.transpose_mul(joint.after.transpose_mul(bearing) + later);
            let reduced = joint.pivot.reduce(right);
            passing.step = joint.pivot.raise(reduced);
            // 3. About the start of the element, and into the frame after the joint before.
            let beyond = joint.beyond + half_length;
            let lever = joint.advance[0].mul_add(beyond, joint.halves[0]);
            let piece = first.advance.mul_add(beyond, first.moment);
            moved = moved + earlier.cross(lever) + joint.start.mul_vec(piece);
            later = joint.back.mul_vec(joint.pivot.reduce_slope(later, reduced));
        }
    }

    /// The change of each joint from root to tip, and what it moves. (L16)
    #[inline(always)]
    fn rest(
        &mut self,
        direction: &TangentDirection<F>,
        change: &impl Fn(usize) -> [PieceChange<F>; 2],
        mut node: impl FnMut(usize, Vec3<F>, Vec3<F>),
    ) {
        let zero = self.rods.weight.splat(0.0);
        let (mut turned, mut shift) = (Vec3::splat(zero), Vec3::splat(zero));
        let mut rotation = direction.rotation;
        node(0, shift, rotation);
        for (i, (joint, passing)) in self.joints.iter().zip(&self.passing).enumerate() {
            let [first, second] = change(i);
            shift = shift + rotation.cross(joint.advance[0]) + joint.start.mul_vec(first.advance);
            let seen = joint.after.transpose_mul(turned);
            let step = Vec3::splat(zero) - (passing.step + joint.gain.transpose_mul(seen));
            turned = turned + joint.after.mul_vec(joint.jacobian.mul_vec(step));
            rotation = passing.carried + turned;
            shift = shift + rotation.cross(joint.advance[1]) + joint.after.mul_vec(second.advance);
            rotation = rotation + joint.finish.mul_vec(second.turn);
            node(i + 1, shift + joint.end * direction.magnification, rotation);
        }
    }
}
