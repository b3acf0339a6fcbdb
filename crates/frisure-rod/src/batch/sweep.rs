//! Newton's sweeps over the joints of many hairs: backward for the laws, forward to apply them.
//!
//! The exact second-order model of the energy of all that hangs from a joint, as a function of which way up
//! is there, is carried from tip to root with the turns of the joints eliminated (differential dynamic
//! programming, as in [`crate::minimise::Newton`]). A turn ε of up, `y → exp(−[ε]) y`, changes the energy by
//! `g·ε + ½ εᵀ P ε`. With a joint's turn `c + x` and up turned by θ after it,
//!
//! ```text
//! ε = J x + ½ x·D x + θ − ½ (J x) × θ + …
//! ```
//!
//! so that x is eliminated by the 3×3 block `H = K + Jᵀ P J + D(g)` and `M = Jᵀ (P + ½ [g]×)`.

use super::lanes::{Lanes, Mat3, Sym3, Vec3};
use super::pivot::{Factor, JointModel};
use super::turn::Table;
use super::turns::Turns;

/// One joint of each hair.
#[derive(Clone, Copy)]
pub(super) struct Joint<F> {
    /// a (N m).
    pub(super) arm: Vec3<F>,
    /// Its turn c (rad), and which way up is after it.
    pub(super) control: Vec3<F>,
    pub(super) up: Vec3<F>,
    /// The same after the step that is being tried.
    pub(super) trial: Vec3<F>,
    pub(super) trial_up: Vec3<F>,
    /// What the step is, and how it answers to up having turned: `−(step + gain θ)`.
    step: Vec3<F>,
    gain: Mat3<F>,
    /// `exp([c]×)`.
    rotation: Mat3<F>,
}

/// So many hairs side by side, divided into as many joints each.
pub(super) struct Bundle<F> {
    pub(super) joints: Vec<Joint<F>>,
    pub(super) turns: Turns<F>,
    /// ζ before the first joint.
    pub(super) root: Vec3<F>,
    /// K (N m).
    pub(super) stiffness: Vec3<F>,
}

/// What a backward sweep finds of each hair.
pub(super) struct Backward<F> {
    /// Square of the largest derivative of the energy by a joint's turn (N² m²).
    pub(super) gradient: F,
    /// What the quadratic model loses by the whole step (J).
    pub(super) decrease: F,
    /// The least pivot of the eliminations (N m), but for rounding: positive where the second variation is.
    pub(super) pivot: F,
    /// Square of the largest turn of a joint (rad²).
    pub(super) turned: F,
}

/// Largest change of a joint's turn in one step (rad).
pub(super) const LARGEST_TURN: f64 = 1.0;

impl<F: Lanes> Joint<F> {
    pub(super) fn nothing(zero: F) -> Self {
        let (v, m) = (Vec3::all(zero), Mat3::all(zero));
        Self { arm: v, control: v, up: v, trial: v, trial_up: v, step: v, gain: m, rotation: m }
    }
}

impl<F: Lanes> Bundle<F> {
    /// Takes over the trial where `accepted`, and finds the next step with stiffness `1 + damping` times as
    /// great.
    #[inline(always)]
    pub(super) fn backward(&mut self, accepted: F::Truth, damping: F) -> Backward<F> {
        let zero = damping.all(0.0);
        let one = damping.all(1.0);
        let half = damping.all(0.5);
        let stiffness = self.stiffness;
        let damped = stiffness.scaled(one + damping);
        let mut found = Backward { gradient: zero, decrease: zero, pivot: one, turned: zero };
        let mut hessian = Sym3::all(zero);
        // Of the model, and of the energy itself with no joint moved.
        let (mut slope, mut pure) = (Vec3::all(zero), Vec3::all(zero));
        for i in (0..self.joints.len()).rev() {
            let joint = &mut self.joints[i];
            let c = Vec3::choose(accepted, joint.trial, joint.control);
            let up = Vec3::choose(accepted, joint.trial_up, joint.up);
            (joint.control, joint.up) = (c, up);
            let arm = joint.arm;
            let pull = arm.cross(up);
            let (g, h) = (slope.plus(pull), pure.plus(pull));
            let p = hessian.plus_outer(arm.scaled(half), up).plus_diagonal(Vec3::all(-arm.dot(up)));

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
            let q = lowered.each(factor.inverse);
            found.decrease = half.times_plus(lowered.dot(q), found.decrease);
            let [m1, m2, m3] = factor.lower_rows(rows);
            joint.step = factor.raise(q);
            joint.gain = factor.raise_rows([m1, m2, m3]);
            joint.rotation = rotation;

            if i == 0 {
                break;
            }
            let slope_before = m3.scaled_plus(-q.z, m2.scaled_plus(-q.y, m1.scaled_plus(-q.x, g)));
            let d = factor.inverse;
            let hessian_before =
                p.minus_square(d.x, m1).minus_square(d.y, m2).minus_square(d.z, m3);
            let back = self.turns.after(i - 1).product(rotation);
            slope = back.times(slope_before);
            pure = back.times(h);
            hessian = back.turned(hessian_before);
        }
        found
    }

    /// Tries the step, and gives the energy there (J), but for what no joint can change.
    #[inline(always)]
    pub(super) fn forward(&mut self) -> F {
        let one = self.root.x.all(1.0);
        let most = one.all(LARGEST_TURN);
        let half = one.all(0.5);
        let mut energy = one.all(0.0);
        let mut before = self.root;
        let last = self.joints.len() - 1;
        for i in 0..=last {
            let joint = &mut self.joints[i];
            let seen = joint.rotation.transposed_times(before);
            let turned = seen.cross(joint.up);
            let answer = joint.gain.transposed_times(turned).plus(joint.step);
            let square = answer.dot(answer);
            let long = (most * most).less(square);
            let answer = match F::any(long) {
                true => answer.scaled(F::choose(long, most / square.root(), one)),
                false => answer,
            };
            let c = answer.scaled_plus(-one, joint.control);
            let table = Table::of(c);
            let up = table.back(c, before);
            let elastic = c.dot(self.stiffness.each(c));
            energy = half.times_plus(elastic, energy) + joint.arm.dot(up);
            (joint.trial, joint.trial_up) = (c, up);
            if i < last {
                before = self.turns.after(i).transposed_times(up);
            }
        }
        energy
    }
}
