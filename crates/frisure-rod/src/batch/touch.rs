//! The sweeps of [`super::sweep`] for hair that touches something: where a joint is counts then, and the whole
//! frame, not only which way up is in it.
//!
//! Joints are rigid links: after joint i the next one is `p⁺ = p + G b`, with G the frame after the joint and b
//! constant. Energies of where the ends of links are enlarge the model by a shift ξ of the position (world):
//! `λ·ε + μ·ξ + ½ εᵀ P ε + εᵀ Q ξ + ½ ξᵀ S ξ`.

use super::lanes::{Lanes, Mat3, Sym3, Vec3};
use super::pivot::{Factor, JointModel};
use super::sweep::{Backward, LARGEST_TURN};
use super::turn::Table;
use super::turns::Turns;

/// What touches the end of a link: energy (J), gradient and Hessian by its position.
#[derive(Clone, Copy)]
pub(super) struct Felt<F> {
    pub(super) energy: F,
    pub(super) gradient: Vec3<F>,
    pub(super) hessian: Sym3<F>,
}

/// A joint and the link after it.
#[derive(Clone, Copy)]
struct State<F> {
    /// Its turn c (rad).
    control: Vec3<F>,
    /// The frame after it.
    frame: Mat3<F>,
    /// The end of the link (m).
    end: Vec3<F>,
    felt: Felt<F>,
}

/// One joint of each hair.
#[derive(Clone, Copy)]
pub(super) struct Joint<F> {
    /// What hangs from it (N m), and the link after it (m), in the frame after it.
    pub(super) arm: Vec3<F>,
    pub(super) link: Vec3<F>,
    now: State<F>,
    trial: State<F>,
    /// What the step is, and how it answers to a turn and a shift: `−(step + by_turn θ + by_shift ξ)`.
    step: Vec3<F>,
    by_turn: Mat3<F>,
    by_shift: Mat3<F>,
    /// `exp([c]×)`.
    rotation: Mat3<F>,
}

/// So many hairs side by side, divided into as many joints each.
pub(super) struct Bundle<F> {
    pub(super) joints: Vec<Joint<F>>,
    pub(super) turns: Turns<F>,
    /// The frame before the first joint, and where that is (m).
    pub(super) frame: Mat3<F>,
    pub(super) start: Vec3<F>,
    /// K (N m).
    pub(super) stiffness: Vec3<F>,
}

impl<F: Lanes> Felt<F> {
    pub(super) fn nothing(zero: F) -> Self {
        Self { energy: zero, gradient: Vec3::all(zero), hessian: Sym3::all(zero) }
    }

    /// Adds what one hair feels.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        lane: usize,
        energy: f64,
        gradient: glam::DVec3,
        hessian: &glam::DMat3,
    ) {
        self.energy.set(lane, self.energy.get(lane) + energy);
        self.gradient.set(lane, self.gradient.get(lane) + gradient);
        self.hessian.add(lane, hessian);
    }
}

impl<F: Lanes> State<F> {
    fn nothing(zero: F) -> Self {
        let v = Vec3::all(zero);
        Self { control: v, frame: Mat3::all(zero), end: v, felt: Felt::nothing(zero) }
    }

    #[inline(always)]
    fn choose(truth: F::Truth, yes: &Self, no: &Self) -> Self {
        let felt = Felt {
            energy: F::choose(truth, yes.felt.energy, no.felt.energy),
            gradient: Vec3::choose(truth, yes.felt.gradient, no.felt.gradient),
            hessian: Sym3::choose(truth, yes.felt.hessian, no.felt.hessian),
        };
        Self {
            control: Vec3::choose(truth, yes.control, no.control),
            frame: Mat3::choose(truth, yes.frame, no.frame),
            end: Vec3::choose(truth, yes.end, no.end),
            felt,
        }
    }
}

impl<F: Lanes> Joint<F> {
    pub(super) fn nothing(zero: F) -> Self {
        let (v, m, state) = (Vec3::all(zero), Mat3::all(zero), State::nothing(zero));
        Self {
            arm: v,
            link: v,
            now: state,
            trial: state,
            step: v,
            by_turn: m,
            by_shift: m,
            rotation: m,
        }
    }

    /// The joint's turn (rad) in one hair.
    pub(super) fn control(&self, lane: usize) -> glam::DVec3 {
        self.now.control.get(lane)
    }

    /// The frame after the joint of one hair, and where its link ends (m).
    #[inline(always)]
    pub(super) fn link(&self, lane: usize) -> (glam::DMat3, glam::DVec3) {
        (self.now.frame.get(lane), self.now.end.get(lane))
    }

    /// Lets the next trial of one hair be a shape that is given.
    pub(super) fn begin(&mut self, lane: usize, control: glam::DVec3) {
        let zero = glam::DMat3::ZERO;
        self.now.control.set(lane, control);
        self.step.set(lane, glam::DVec3::ZERO);
        self.by_turn.set(lane, &zero);
        self.by_shift.set(lane, &zero);
    }
}

impl<F: Lanes> Bundle<F> {
    /// As [`super::sweep::Bundle::backward`].
    #[inline(always)]
    pub(super) fn backward(&mut self, accepted: F::Truth, damping: F) -> Backward<F> {
        let zero = damping.all(0.0);
        let one = damping.all(1.0);
        let half = damping.all(0.5);
        let stiffness = self.stiffness;
        let damped = stiffness.scaled(one + damping);
        let mut found = Backward { gradient: zero, decrease: zero, pivot: one, turned: zero };
        let (mut p_next, mut q_next, mut s) = (Sym3::all(zero), Mat3::all(zero), Sym3::all(zero));
        // Of the model, and of the energy itself with no joint moved.
        let (mut slope, mut force) = (Vec3::all(zero), Vec3::all(zero));
        let (mut pure, mut pure_force) = (slope, force);
        for i in (0..self.joints.len()).rev() {
            let joint = &mut self.joints[i];
            joint.now = State::choose(accepted, &joint.trial, &joint.now);
            let State { control: c, frame, felt, .. } = joint.now;
            let (arm, b) = (joint.arm, joint.link);

            // What is felt at the end of the link, and the link.
            force = force.plus(felt.gradient);
            pure_force = pure_force.plus(felt.gradient);
            s = s.plus(felt.hessian);
            let up = Vec3::new(frame.x.z, frame.y.z, frame.z.z);
            let hanging = arm.cross(up);
            let pull = frame.transposed_times(force);
            let g = slope.plus(hanging).plus(b.cross(pull));
            let h = pure.plus(hanging).plus(b.cross(frame.transposed_times(pure_force)));
            // ε moves the end by G (ε × b): the columns of that map, and S after them.
            let moved = Mat3 {
                x: frame.y.scaled(-b.z).plus(frame.z.scaled(b.y)),
                y: frame.x.scaled(b.z).plus(frame.z.scaled(-b.x)),
                z: frame.x.scaled(-b.y).plus(frame.y.scaled(b.x)),
            };
            let stiff = Mat3 { x: s.times(moved.x), y: s.times(moved.y), z: s.times(moved.z) };
            // εᵀ Q ξ; Q by its rows: those of Q⁺ and the columns of `stiff`.
            let q = Mat3 {
                x: q_next.x.plus(stiff.x),
                y: q_next.y.plus(stiff.y),
                z: q_next.z.plus(stiff.z),
            };
            // Qε + its transpose + what S makes of the moves: (Q⁺ + ½ stiffᵀ) moved, and its transpose.
            let mixed = |row: Vec3<F>, stiff: Vec3<F>| stiff.scaled_plus(half, row);
            let (rx, ry, rz) =
                (mixed(q_next.x, stiff.x), mixed(q_next.y, stiff.y), mixed(q_next.z, stiff.z));
            let both = |a: Vec3<F>, x: Vec3<F>, b: Vec3<F>, y: Vec3<F>| a.dot(x) + b.dot(y);
            let moving = Sym3 {
                xx: both(rx, moved.x, rx, moved.x),
                xy: both(rx, moved.y, ry, moved.x),
                xz: both(rx, moved.z, rz, moved.x),
                yy: both(ry, moved.y, ry, moved.y),
                yz: both(ry, moved.z, rz, moved.y),
                zz: both(rz, moved.z, rz, moved.z),
            };
            let p = p_next
                .plus(moving)
                .plus_outer(arm.scaled(half), up)
                .plus_outer(pull.scaled(half), b)
                .plus_diagonal(Vec3::all(-(arm.dot(up) + pull.dot(b))));

            // The joint.
            let table = Table::of(c);
            let rotation = table.rotation(c);
            let j = table.jacobian(c);
            let bent = stiffness.each(c);
            let residue = j.transposed_times(g).plus(bent);
            let exact = j.transposed_times(h).plus(bent);
            found.gradient = found.gradient.largest(exact.dot(exact));
            found.turned = found.turned.largest(c.dot(c));
            let JointModel { block, rows } = JointModel::new(&table, c, j, g, p);
            let factor = Factor::of(block.plus_diagonal(damped));
            found.pivot = found.pivot.smallest(factor.least);
            let lowered = factor.lower(residue);
            let d = factor.inverse;
            let z = lowered.each(d);
            found.decrease = half.times_plus(lowered.dot(z), found.decrease);
            let turned = factor.lower_rows(rows);
            // Jᵀ Q by rows: Q's rows are kept as columns.
            let shifted = factor.lower_rows([q.times(j.x), q.times(j.y), q.times(j.z)]);
            joint.step = factor.raise(z);
            joint.by_turn = factor.raise_rows(turned);
            joint.by_shift = factor.raise_rows(shifted);
            joint.rotation = rotation;
            if i == 0 {
                break;
            }

            let less = |v: Vec3<F>, [x, y, w]: [Vec3<F>; 3]| {
                w.scaled_plus(-z.z, y.scaled_plus(-z.y, x.scaled_plus(-z.x, v)))
            };
            let [t1, t2, t3] = turned;
            let [u1, u2, u3] = shifted;
            let before = p.minus_square(d.x, t1).minus_square(d.y, t2).minus_square(d.z, t3);
            s = s.minus_square(d.x, u1).minus_square(d.y, u2).minus_square(d.z, u3);
            let (e1, e2, e3) = (u1.scaled(d.x), u2.scaled(d.y), u3.scaled(d.z));
            let row = |v: Vec3<F>, a: F, b: F, c: F| {
                e3.scaled_plus(-c, e2.scaled_plus(-b, e1.scaled_plus(-a, v)))
            };
            // Rows of Q in the frame before the joint, as columns.
            let crossed = Mat3 {
                x: row(q.x, t1.x, t2.x, t3.x),
                y: row(q.y, t1.y, t2.y, t3.y),
                z: row(q.z, t1.z, t2.z, t3.z),
            };
            let slope_before = less(g, turned);
            force = less(force, shifted);
            let back = self.turns.after(i - 1).product(rotation);
            slope = back.times(slope_before);
            pure = back.times(h);
            p_next = back.turned(before);
            q_next = back.rows_of(crossed);
        }
        found
    }

    /// Tries the step, and gives the energy there (J), but for what no joint can change; `feel` tells what touches
    /// the end of a joint's link.
    #[inline(always)]
    pub(super) fn forward(&mut self, mut feel: impl FnMut(usize, &Vec3<F>) -> Felt<F>) -> F {
        let one = self.start.x.all(1.0);
        let most = one.all(LARGEST_TURN);
        let half = one.all(0.5);
        let mut energy = one.all(0.0);
        let (mut before, mut at) = (self.frame, self.start);
        let mut shift = Vec3::all(one.all(0.0));
        let last = self.joints.len() - 1;
        for i in 0..=last {
            let joint = &mut self.joints[i];
            let turned = joint.now.frame.deviation(before.product(joint.rotation));
            let answer = joint
                .by_turn
                .transposed_times(turned)
                .plus(joint.by_shift.transposed_times(shift))
                .plus(joint.step);
            let square = answer.dot(answer);
            let long = (most * most).less(square);
            let answer = match F::any(long) {
                true => answer.scaled(F::choose(long, most / square.root(), one)),
                false => answer,
            };
            let c = answer.scaled_plus(-one, joint.now.control);
            let table = Table::of(c);
            let frame = before.product(table.rotation(c));
            let end = at.plus(frame.times(joint.link));
            let felt = feel(i, &end);
            let up = Vec3::new(frame.x.z, frame.y.z, frame.z.z);
            let elastic = c.dot(self.stiffness.each(c));
            energy = half.times_plus(elastic, energy) + joint.arm.dot(up) + felt.energy;
            shift = end.minus(joint.now.end);
            joint.trial = State { control: c, frame, end, felt };
            at = end;
            if i < last {
                before = frame.product(*self.turns.after(i));
            }
        }
        energy
    }
}
