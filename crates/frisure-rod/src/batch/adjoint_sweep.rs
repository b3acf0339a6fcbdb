//! Sweeps for the derivatives of rods at rest in their own weight: the linear system of the adjoint, and its products with the
//! parameters. docs/theory.md, "Derivatives of an equilibrium" and "Rods in lanes", (L11) to (L13).

use super::elimination::{Elimination, Stiffness, SweepResult};
use super::lanes::Lanes;
use super::linear::{Mat3, Sym3, Vec3};
use super::rod_lanes::{Half, RodLanes, both};
use super::rotation::RotationTable;

/// One element of each rod.
#[derive(Clone, Copy)]
pub(super) struct AdjointJoint<F> {
    /// a (N m), as in [`super::weight_sweep::Joint`].
    pub(super) arm: Vec3<F>,
    /// c (rad).
    pub(super) control: Vec3<F>,
    /// Derivatives of the loss by the node at the end of the element: its position (per m, world) and its frame (per rad, world).
    pub(super) by_position: Vec3<F>,
    pub(super) by_frame: Vec3<F>,
    /// Frames before the element, before the joint and after it, and the right Jacobian of the joint.
    start: Mat3<F>,
    before: Mat3<F>,
    after: Mat3<F>,
    jacobian: Mat3<F>,
    /// Positions of the joint and of the end, from the root (m).
    at: Vec3<F>,
    end: Vec3<F>,
    /// First moment of what is beyond the joint, about it, and of what is beyond the end, about that (m², world).
    moment: Vec3<F>,
    end_moment: Vec3<F>,
    /// Sums of the derivatives by all later nodes: by a shift, and by a rotation about the root.
    force: Vec3<F>,
    torque: Vec3<F>,
    /// `H⁻¹ r` and the feedback, see [`Elimination`].
    step: Vec3<F>,
    gain: Mat3<F>,
    /// Rotation of the frame after the joint by all joints up to it, and by it alone (rad, world).
    turned: Vec3<F>,
    turned_alone: Vec3<F>,
    /// Derivative by the natural strain of both halves, before and after the joint (loss per rad/m).
    pub(super) by_strain: [Vec3<F>; 2],
}

impl<F: Lanes> AdjointJoint<F> {
    fn zero(zero: F) -> Self {
        let (v, m) = (Vec3::splat(zero), Mat3::splat(zero));
        Self {
            arm: v,
            control: v,
            by_position: v,
            by_frame: v,
            start: m,
            before: m,
            after: m,
            jacobian: m,
            at: v,
            end: v,
            moment: v,
            end_moment: v,
            force: v,
            torque: v,
            step: v,
            gain: m,
            turned: v,
            turned_alone: v,
            by_strain: [v; 2],
        }
    }
}

/// The derivatives of each rod that are sums over its elements.
pub(super) struct AdjointSums<F> {
    /// Σ of the derivatives by the nodes beyond the root: by a shift, by a rotation about the root, and by a magnification.
    pub(super) force: Vec3<F>,
    pub(super) torque: Vec3<F>,
    pub(super) magnification: F,
    /// By the load per length (loss m/N), and `−Σ a c` of the stiffness (loss).
    pub(super) load: Vec3<F>,
    pub(super) bent: Vec3<F>,
    /// `aᵀ H a` and `aᵀ K a` of the adjoint a: their ratio is at least the smallest eigenvalue.
    pub(super) curvature: F,
    pub(super) elastic: F,
}

/// Rods side by side, each divided into the same number of elements.
pub(super) struct AdjointBundle<F> {
    pub(super) joints: Vec<AdjointJoint<F>>,
    pub(super) rods: RodLanes<F>,
    /// Derivative of the loss by the energy of each rod (1/J). At rest it asks nothing of the joints.
    pub(super) by_energy: F,
}

/// What a sweep to the root leaves there: the sums of the loss over all nodes, and the first moment (m²) of the rod.
struct AtRoot<F> {
    force: Vec3<F>,
    torque: Vec3<F>,
    magnification: F,
    moment: Vec3<F>,
}

impl<F: Lanes> AdjointBundle<F> {
    #[inline(always)]
    pub(super) fn new(zero: F, elements: usize, uniform: bool) -> Self {
        Self {
            joints: vec![AdjointJoint::zero(zero); elements],
            rods: RodLanes::new(zero, elements, uniform),
            by_energy: zero,
        }
    }

    /// The least pivot of `H − λ K/h` of each rod with λ = `least`, less its rounding error: positive if all eigenvalues are above λ.
    /// Frames and positions are those of [`Self::shape`].
    #[inline(always)]
    pub(super) fn pivot_above(&mut self, least: F) -> F {
        let mut result = SweepResult::new(least.splat(0.0));
        self.backward(&mut result, -least);
        result.pivot
    }

    /// Solves `H a = (∂x/∂c)ᵀ ∂ℓ/∂x` of each rod and forms the products with the parameters.
    ///
    /// The least pivot of `H − λ K/h` with λ = `least` is returned, too: it is positive if all eigenvalues are above λ.
    #[inline(always)]
    pub(super) fn solve(&mut self, least: f64) -> (AdjointSums<F>, SweepResult<F>, F) {
        self.shape();
        let zero = self.rods.weight.splat(0.0);
        // What this sweep leaves in the joints the next one replaces.
        let above = self.pivot_above(zero.splat(least));
        let mut result = SweepResult::new(zero);
        let AtRoot { force, torque, magnification, moment } = self.backward(&mut result, zero);
        let (bent, elastic) = self.forward();
        let load = self.products() - moment * self.by_energy;
        let curvature = result.decrease + result.decrease;
        let sums = AdjointSums { force, torque, magnification, load, bent, curvature, elastic };
        (sums, result, above)
    }

    /// Frames and positions, from root to tip.
    #[inline(always)]
    pub(super) fn shape(&mut self) {
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
            joint.at = position + frame.mul_vec(first.advance);
            joint.end = joint.at + joint.after.mul_vec(second.advance);
            frame = joint.after.mul_mat(second.turn);
            position = joint.end;
        }
    }

    /// The Hessian, with `damping` times the stiffness, eliminated from tip to root with the loss on its right-hand side. (L11)
    #[inline(always)]
    fn backward(&mut self, result: &mut SweepResult<F>, damping: F) -> AtRoot<F> {
        let zero = self.rods.weight.splat(0.0);
        let stiffness = Stiffness::new(self.rods.stiffness, damping);
        let half_length = zero.splat(0.5) * self.rods.spacing;
        let none = Vec3::splat(zero);
        let (mut force, mut torque, mut magnification) = (none, none, zero);
        let (mut slope, mut hessian, mut later) = (none, Sym3::splat(zero), none);
        // First moment about the node and length beyond it.
        let (mut moment, mut beyond) = (none, zero);
        for i in (0..self.joints.len()).rev() {
            let [first, second] = both(&self.rods.halves, i);
            let joint = &mut self.joints[i];
            // 1. What later nodes ask of a shift and of a rotation about the root.
            force = force + joint.by_position;
            torque = torque + joint.end.cross(joint.by_position) + joint.by_frame;
            magnification = magnification + joint.end.dot(joint.by_position);
            (joint.force, joint.torque) = (force, torque);
            // 2. First moments about the end, the joint and the start: that of a piece, and what is beyond it at its end.
            joint.end_moment = moment;
            let piece = second.advance.mul_add(beyond, second.moment);
            joint.moment = moment + joint.after.mul_vec(piece);
            beyond = beyond + half_length;
            let piece = first.advance.mul_add(beyond, first.moment);
            moment = joint.moment + joint.start.mul_vec(piece);
            beyond = beyond + half_length;
            // 3. The weight at the joint, and the joint eliminated. (L3) to (L6)
            let value = self.rods.bearing(joint.arm, joint.after, slope, hessian);
            let asked = joint.after.transpose_mul(torque - joint.at.cross(force));
            let c = joint.control;
            let eliminated = Elimination::linear(c, &stiffness, &value, later - asked, result);
            joint.step = eliminated.step();
            joint.gain = eliminated.feedback(eliminated.by_turn);
            // 4. Into the frame after the joint before.
            let frame = joint.after;
            if i > 0 {
                let back = self.joints[i - 1].after.transpose_mul_mat(frame);
                later = back.mul_vec(eliminated.reduce_slope(later, eliminated.by_turn));
                slope = back.mul_vec(value.slope);
                let left = eliminated.reduce_hessian(value.hessian, eliminated.by_turn);
                hessian = back.congruence(left);
            }
        }
        AtRoot { force, torque, magnification, moment }
    }

    /// The adjoint a from root to tip, `−Σ a c`, with ½ Σ c² of the energy, and `aᵀ K a`. (L12)
    #[inline(always)]
    fn forward(&mut self) -> (Vec3<F>, F) {
        let zero = self.rods.weight.splat(0.0);
        let (mut turned, mut bent) = (Vec3::splat(zero), Vec3::splat(zero));
        let mut elastic = zero;
        let by_energy = zero.splat(0.5) * self.by_energy;
        for joint in &mut self.joints {
            let seen = joint.after.transpose_mul(turned);
            let a = Vec3::splat(zero) - (joint.step + joint.gain.transpose_mul(seen));
            let c = joint.control;
            bent = bent + (c * by_energy - a).component_mul(c);
            elastic = elastic + a.dot(self.rods.stiffness.component_mul(a));
            joint.turned_alone = joint.after.mul_vec(joint.jacobian.mul_vec(a));
            turned = turned + joint.turned_alone;
            joint.turned = turned;
        }
        (bent, elastic)
    }

    /// Derivatives by natural strain, and by the load per length. (L13)
    #[inline(always)]
    fn products(&mut self) -> Vec3<F> {
        let zero = self.rods.weight.splat(0.0);
        let (w, half_length) = (self.rods.weight, zero.splat(0.5) * self.rods.spacing);
        // ∫ δr ds of what later joints move, and the length beyond.
        let (mut moved, mut beyond) = (Vec3::splat(zero), zero);
        // e × v.
        let vertical = self.rods.up;
        let around = |v: Vec3<F>| vertical.cross(v);
        // The energy w e·∫ r ds sees a rotation and a shift as a rotation by the joints before the piece does, with −e for e × it.
        let of_energy = vertical * self.by_energy;
        for i in (0..self.joints.len()).rev() {
            let [first, second] = both(&self.rods.halves, i);
            let earlier = match i {
                0 => Vec3::splat(zero),
                _ => self.joints[i - 1].turned,
            };
            let joint = &mut self.joints[i];
            // A piece whose end is at `at` moves what is beyond: a rotation of that about the end, a shift of it, and the piece's
            // own first moment; `about` is e × the rotation by the joints before the piece.
            let by_piece = |piece: &Half<F>,
                            frame: Mat3<F>,
                            at: Vec3<F>,
                            moment: Vec3<F>,
                            moved: Vec3<F>,
                            beyond: F,
                            about: Vec3<F>| {
                let rotation = joint.torque
                    - at.cross(joint.force)
                    - (moment.cross(about) - around(moved)) * w;
                let shift = joint.force - about * (w * beyond);
                let end = piece.turn.transpose_mul(frame.transpose_mul(rotation));
                let by = piece.turn_by.transpose_mul(end)
                    + piece.advance_by.transpose_mul(frame.transpose_mul(shift))
                    - piece.moment_by.transpose_mul(frame.transpose_mul(about)) * w;
                by * half_length
            };
            let about = around(joint.turned) - of_energy;
            let after =
                by_piece(second, joint.after, joint.end, joint.end_moment, moved, beyond, about);
            moved = moved + joint.turned_alone.cross(joint.moment);
            beyond = beyond + half_length;
            let about = around(earlier) - of_energy;
            let before = by_piece(first, joint.start, joint.at, joint.moment, moved, beyond, about);
            beyond = beyond + half_length;
            joint.by_strain = [before, after];
        }
        moved
    }
}
