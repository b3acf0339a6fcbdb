//! Newton's sweeps for rods in contact: the position of a joint matters then, and the whole frame, not only the vertical
//! in it.
//!
//! Joints are connected by rigid links: the end of link i is `p⁺ = p + G b`, with G the frame after joint i and b
//! constant. Contact energies at the ends of links extend the model of [`super::weight_sweep`] by a shift ξ of the
//! position (world), docs/theory.md, "Rods in lanes", (L8) to (L10).

use super::contact_term::ContactTerm;
use super::elimination::{
    Elimination, Stiffness, SweepResult, ValueFunction, add_joint_energy, stepped,
};
use super::lanes::Lanes;
use super::linear::{Mat3, Sym3, Vec3};
use super::rotation::RotationTable;
use super::transport::Transport;

/// A joint and its link in one shape.
#[derive(Clone, Copy)]
struct State<F> {
    /// Its turn c (rad).
    control: Vec3<F>,
    /// G: the frame after it.
    frame: Mat3<F>,
    /// The end of the link (m).
    end: Vec3<F>,
    contact: ContactTerm<F>,
}

impl<F: Lanes> State<F> {
    fn zero(zero: F) -> Self {
        let v = Vec3::splat(zero);
        Self { control: v, frame: Mat3::splat(zero), end: v, contact: ContactTerm::zero(zero) }
    }

    #[inline(always)]
    fn select(mask: F::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            control: Vec3::select(mask, yes.control, no.control),
            frame: Mat3::select(mask, yes.frame, no.frame),
            end: Vec3::select(mask, yes.end, no.end),
            contact: ContactTerm::select(mask, &yes.contact, &no.contact),
        }
    }
}

/// One joint of each rod, and the link after it.
#[derive(Clone, Copy)]
pub(super) struct Joint<F> {
    /// a (N m) and b (m), in the frame after the joint.
    pub(super) arm: Vec3<F>,
    pub(super) link: Vec3<F>,
    current: State<F>,
    trial: State<F>,
    /// Feedback law: the step is `−(step + by_turnᵀ θ + by_shiftᵀ ξ)`.
    step: Vec3<F>,
    by_turn: Mat3<F>,
    by_shift: Mat3<F>,
    /// `exp([c]×)`.
    rotation: Mat3<F>,
}

impl<F: Lanes> Joint<F> {
    pub(super) fn zero(zero: F) -> Self {
        let (v, m, state) = (Vec3::splat(zero), Mat3::splat(zero), State::zero(zero));
        Self {
            arm: v,
            link: v,
            current: state,
            trial: state,
            step: v,
            by_turn: m,
            by_shift: m,
            rotation: m,
        }
    }

    /// The joint's turn (rad) in one rod.
    pub(super) fn control(&self, lane: usize) -> glam::DVec3 {
        self.current.control.get(lane)
    }

    /// The step without feedback (rad).
    #[cfg(test)]
    pub(super) fn feedforward(&self, lane: usize) -> glam::DVec3 {
        -self.step.get(lane)
    }

    /// The joint's turn (rad) in one rod after the trial step.
    #[cfg(test)]
    pub(super) fn trial_control(&self, lane: usize) -> glam::DVec3 {
        self.trial.control.get(lane)
    }

    /// The frame after the joint of one rod, and the end of its link (m).
    #[inline(always)]
    pub(super) fn link_end(&self, lane: usize) -> (glam::DMat3, glam::DVec3) {
        (self.current.frame.get(lane), self.current.end.get(lane))
    }

    /// Makes a given shape the next trial of one rod: a step of zero from its control.
    pub(super) fn begin(&mut self, lane: usize, control: glam::DVec3) {
        let zero = glam::DMat3::ZERO;
        self.current.control.set(lane, control);
        self.step.set(lane, glam::DVec3::ZERO);
        self.by_turn.set(lane, &zero);
        self.by_shift.set(lane, &zero);
    }
}

/// Quadratic model of the energy beyond a joint's link, by the turn ε of the frame and the shift ξ of the position:
/// `g·ε + f·ξ + ½ εᵀ P ε + εᵀ Q ξ + ½ ξᵀ S ξ`. (L8)
struct PositionModel<F> {
    /// g of the model, and of the energy with later joints as they are.
    slope: Vec3<F>,
    exact_slope: Vec3<F>,
    /// f of the model, and of the energy with later joints as they are.
    force: Vec3<F>,
    exact_force: Vec3<F>,
    /// P.
    turn_turn: Sym3<F>,
    /// Q, its rows as columns.
    turn_shift: Mat3<F>,
    /// S.
    shift_shift: Sym3<F>,
}

impl<F: Lanes> PositionModel<F> {
    #[inline(always)]
    fn zero(zero: F) -> Self {
        let (v, s) = (Vec3::splat(zero), Sym3::splat(zero));
        Self {
            slope: v,
            exact_slope: v,
            force: v,
            exact_force: v,
            turn_turn: s,
            turn_shift: Mat3::splat(zero),
            shift_shift: s,
        }
    }

    #[inline(always)]
    fn add_contact(&mut self, contact: &ContactTerm<F>) {
        self.force = self.force + contact.gradient;
        self.exact_force = self.exact_force + contact.gradient;
        self.shift_shift = self.shift_shift + contact.hessian;
    }

    /// The model at the start of a link b, with the weight a of its joint, by the turn of the frame there; and Q there.
    /// A turn ε moves the end of the link by `ξ = G (ε × b) + ½ G (ε × (ε × b))`. (L9)
    #[inline(always)]
    fn through_link(
        &self,
        arm: Vec3<F>,
        b: Vec3<F>,
        frame: Mat3<F>,
        vertical: Vec3<F>,
    ) -> (ValueFunction<F>, Mat3<F>) {
        let half = arm.x.splat(0.5);
        let s = self.shift_shift;
        // 1. Slopes: the moment of the weight, a × y, and that of the force at the end of the link, b × Gᵀ f.
        // y = Gᵀ e.
        let up = frame.transpose_mul(vertical);
        let moment = arm.cross(up);
        let pull = frame.transpose_mul(self.force);
        let slope = self.slope + moment + b.cross(pull);
        let exact_slope =
            self.exact_slope + moment + b.cross(frame.transpose_mul(self.exact_force));
        // 2. W: the columns of ε ↦ G (ε × b), and S W.
        let moved = Mat3 {
            x: frame.y * -b.z + frame.z * b.y,
            y: frame.x * b.z + frame.z * -b.x,
            z: frame.x * -b.y + frame.y * b.x,
        };
        let stiff = Mat3 { x: s.mul_vec(moved.x), y: s.mul_vec(moved.y), z: s.mul_vec(moved.z) };
        // 3. Q + Wᵀ S, by rows as columns.
        let q = self.turn_shift;
        let turn_shift = Mat3 { x: q.x + stiff.x, y: q.y + stiff.y, z: q.z + stiff.z };
        // 4. Q W + (Q W)ᵀ + Wᵀ S W = T + Tᵀ with T = (Q + ½ (S W)ᵀ) W.
        // Half of Wᵀ S W on either side keeps the sum symmetric with half of the products.
        let mixed = |row: Vec3<F>, stiff: Vec3<F>| stiff.mul_add(half, row);
        let (rx, ry, rz) = (mixed(q.x, stiff.x), mixed(q.y, stiff.y), mixed(q.z, stiff.z));
        let both = |a: Vec3<F>, x: Vec3<F>, b: Vec3<F>, y: Vec3<F>| a.dot(x) + b.dot(y);
        let moving = Sym3 {
            xx: both(rx, moved.x, rx, moved.x),
            xy: both(rx, moved.y, ry, moved.x),
            xz: both(rx, moved.z, rz, moved.x),
            yy: both(ry, moved.y, ry, moved.y),
            yz: both(ry, moved.z, rz, moved.y),
            zz: both(rz, moved.z, rz, moved.z),
        };
        // 5. P, with the second-order terms of the weight and of the force.
        let hessian = (self.turn_turn + moving)
            .add_outer(arm * half, up)
            .add_outer(pull * half, b)
            .add_diagonal(Vec3::splat(-(arm.dot(up) + pull.dot(b))));
        (ValueFunction { slope, exact_slope, hessian }, turn_shift)
    }
}

/// Rods side by side, each divided into the same number of joints.
pub(super) struct Bundle<F> {
    pub(super) joints: Vec<Joint<F>>,
    pub(super) transport: Transport<F>,
    /// Frame and position (m) before the first joint.
    pub(super) frame: Mat3<F>,
    pub(super) start: Vec3<F>,
    /// e: the apparent vertical (world).
    pub(super) up: Vec3<F>,
    /// K (N m).
    pub(super) stiffness: Vec3<F>,
}

impl<F: Lanes> Bundle<F> {
    /// As [`super::weight_sweep::Bundle::backward`].
    #[inline(always)]
    pub(super) fn backward(&mut self, accepted: F::Mask, damping: F) -> SweepResult<F> {
        let zero = damping.splat(0.0);
        let stiffness = Stiffness::new(self.stiffness, damping);
        let mut result = SweepResult::new(zero);
        let mut model = PositionModel::zero(zero);
        for i in (0..self.joints.len()).rev() {
            // 1. The shape.
            let joint = &mut self.joints[i];
            joint.current = State::select(accepted, &joint.trial, &joint.current);
            let State { control: c, frame, contact, .. } = joint.current;
            // 2. Contact at the end of the link, then the link with its weight. (L8), (L9)
            model.add_contact(&contact);
            let (value, turn_shift) = model.through_link(joint.arm, joint.link, frame, self.up);
            // 3. The joint eliminated, as without contact; N = Jᵀ Q is its mixed block by the shift. (L10)
            let eliminated = Elimination::new(c, &stiffness, &value, &mut result);
            let (q, j, by_turn) = (turn_shift, eliminated.jacobian, eliminated.by_turn);
            let by_shift = eliminated.lower_rows([q.mul_vec(j.x), q.mul_vec(j.y), q.mul_vec(j.z)]);
            joint.step = eliminated.step();
            joint.by_turn = eliminated.feedback(by_turn);
            joint.by_shift = eliminated.feedback(by_shift);
            joint.rotation = eliminated.rotation;
            if i == 0 {
                break;
            }
            // 4. Into the frame after the joint before: C exp([c]×). The position stays in the world.
            let back = self.transport.after(i - 1).mul_mat(eliminated.rotation);
            model.slope = back.mul_vec(eliminated.reduce_slope(value.slope, by_turn));
            model.exact_slope = back.mul_vec(value.exact_slope);
            model.force = eliminated.reduce_slope(model.force, by_shift);
            model.turn_turn = back.congruence(eliminated.reduce_hessian(value.hessian, by_turn));
            model.turn_shift = back.rows_of(eliminated.reduce_mixed(q, by_turn, by_shift));
            // A shift before the joint is the same shift after it: f and S need no turn.
            model.shift_shift = eliminated.reduce_hessian(model.shift_shift, by_shift);
        }
        result
    }

    /// Tries the step; the energy there (J), without the part that no joint changes. `contact_at` is the contact of all
    /// rods at the end of a joint's link.
    #[inline(always)]
    pub(super) fn forward(
        &mut self,
        mut contact_at: impl FnMut(usize, &Vec3<F>) -> ContactTerm<F>,
    ) -> F {
        let zero = self.start.x.splat(0.0);
        let mut energy = zero;
        let (mut before, mut at) = (self.frame, self.start);
        let mut shift = Vec3::splat(zero);
        let last = self.joints.len() - 1;
        for i in 0..=last {
            let joint = &mut self.joints[i];
            // 1. θ and ξ of the nonlinear chain, and the step, within the trust region. (L7)
            let turned = joint.current.frame.deviation(before.mul_mat(joint.rotation));
            let feedback = joint.by_turn.transpose_mul(turned)
                + joint.by_shift.transpose_mul(shift)
                + joint.step;
            let c = stepped(joint.current.control, feedback);
            // 2. The frame after the joint, the end of its link, and contact there.
            let frame = before.mul_mat(RotationTable::of(c).rotation(c));
            let end = at + frame.mul_vec(joint.link);
            let contact = contact_at(i, &end);
            // 3. The energy. (L2), (L8)
            let up = frame.transpose_mul(self.up);
            energy = add_joint_energy(energy, c, self.stiffness, joint.arm, up) + contact.energy;
            shift = end - joint.current.end;
            joint.trial = State { control: c, frame, end, contact };
            at = end;
            if i < last {
                before = frame.mul_mat(*self.transport.after(i));
            }
        }
        energy
    }
}
