//! The backward sweep: the Hessian of all controls factorised block by block, `L D Lᵀ`, in linear time.
//!
//! A rod is a discrete optimal-control problem: the state is the frame (and the position, where a potential depends on
//! it), the control is the element's. Going from tip to root, each control is eliminated from the quadratic model of
//! the energy beyond (a Riccati recursion), which leaves a feedback law; the eliminated 3×3 blocks are the pivots of
//! the Hessian. The second-order terms of rotations are kept, so that Newton's method converges quadratically.
//! docs/theory.md, "A problem of optimal control", (M1) to (M5).

use glam::{DMat3, DVec3};

use super::block::BlockFactor;
use super::linearise::{Linearisation, Stage};
use crate::potential::Derivatives;
use crate::rotation::{cross_matrix, scaled_identity, symmetric_outer};

/// Feedback law of an element, `x = k + G_η η + G_ξ ξ`: its best step when its start moved by η and ξ. (M3)
#[derive(Clone, Copy)]
pub(super) struct FeedbackLaw {
    /// k (rad).
    pub(super) step: DVec3,
    /// `G_η`.
    pub(super) by_rotation: DMat3,
    /// `G_ξ` (1/m).
    pub(super) by_position: DMat3,
}

impl FeedbackLaw {
    /// No step, no feedback.
    pub(super) const NONE: Self =
        Self { step: DVec3::ZERO, by_rotation: DMat3::ZERO, by_position: DMat3::ZERO };
}

/// The result of a backward sweep.
pub(super) struct BackwardSweep {
    pub(super) laws: Vec<FeedbackLaw>,
    /// Decrease of the quadratic model by a full step, `½ Σ qᵀ H⁻¹ q` (J). (M5)
    pub(super) decrease: f64,
}

/// A pivot that is not positive definite, with the laws of all elements after it.
pub(super) struct FailedPivot {
    pub(super) element: usize,
    pub(super) pivot: DMat3,
    pub(super) laws: Vec<FeedbackLaw>,
}

/// V: quadratic model of the energy beyond a node, by its frame (η) and position (ξ), with all later controls
/// eliminated. (M2)
#[derive(Clone, Copy)]
pub(super) struct ValueFunction {
    pub(super) rotation: DVec3,
    pub(super) position: DVec3,
    pub(super) rotation_rotation: DMat3,
    pub(super) rotation_position: DMat3,
    pub(super) position_position: DMat3,
}

impl ValueFunction {
    pub(super) const ZERO: Self = Self {
        rotation: DVec3::ZERO,
        position: DVec3::ZERO,
        rotation_rotation: DMat3::ZERO,
        rotation_position: DMat3::ZERO,
        position_position: DMat3::ZERO,
    };

    #[inline]
    fn add(&mut self, node: &Derivatives) {
        self.rotation += node.rotation;
        self.position += node.position;
        self.rotation_rotation += node.rotation_rotation;
        self.rotation_position += node.rotation_position;
        self.position_position += node.position_position;
    }
}

impl<const POSITION: bool> Linearisation<'_, POSITION> {
    /// The backward sweep. `damping` adds that fraction of the elastic stiffness K/h to each pivot
    /// (Levenberg–Marquardt).
    pub(super) fn sweep(&self, damping: f64) -> Result<BackwardSweep, FailedPivot> {
        let n = self.stages.len();
        let mut laws = vec![FeedbackLaw::NONE; n];
        let mut decrease = 0.0;
        let mut value = ValueFunction::ZERO;
        for i in (0..n).rev() {
            // 1. Terms of the node at the end of the element.
            if let Some(node) = self.nodes.get(i) {
                value.add(node);
            }
            // 2. The model q(η, ξ, x) of the element and everything beyond. (M1), (M2)
            let model = self.stages[i].model::<POSITION>(&value);
            // 3. The pivot H_xx, damped, and its factors; not positive definite: no minimum of the model.
            let stiffness = self.stages[i].element.stiffness;
            let pivot = model.control_control + DMat3::from_diagonal(stiffness * damping);
            let Some(factor) = BlockFactor::new(&pivot) else {
                return Err(FailedPivot { element: i, pivot, laws });
            };
            // 4. The law: k = −H_xx⁻¹ q_x, G = −H_xx⁻¹ q_x·. (M3)
            let step = -factor.solve(model.control);
            let by_rotation = factor.solve_transposed(&model.rotation_control) * -1.0;
            decrease -= 0.5 * step.dot(model.control);
            // 5. V of the node before: x eliminated. (M5)
            value.rotation = model.rotation + model.rotation_control * step;
            value.rotation_rotation =
                // Symmetric again after rounding, so that its errors do not add up over hundreds of elements.
                symmetric(model.rotation_rotation + model.rotation_control * by_rotation);
            let by_position = if POSITION {
                let by_position = factor.solve_transposed(&model.position_control) * -1.0;
                value.position = model.position + model.position_control * step;
                value.rotation_position =
                    model.rotation_position + model.rotation_control * by_position;
                value.position_position =
                    symmetric(model.position_position + model.position_control * by_position);
                by_position
            } else {
                DMat3::ZERO
            };
            laws[i] = FeedbackLaw { step, by_rotation, by_position };
        }
        Ok(BackwardSweep { laws, decrease })
    }

    /// The pivot that shows a direction of negative curvature beyond rounding, if there is one; `gradient_norm` as of
    /// [`super::Problem::neutral_eigenvalue`].
    pub(super) fn negative_pivot(&self, gradient_norm: f64) -> Option<FailedPivot> {
        // An eigenvalue that is zero but for rounding may fail the undamped sweep; it does not fail that of H + σM.
        let failed = self.sweep(0.0).err()?;
        self.sweep(self.problem.neutral_eigenvalue(gradient_norm)).is_err().then_some(failed)
    }
}

impl Stage<'_> {
    /// Quadratic model of the energy from this element on, by its start and its control.
    ///
    /// The end moves by `η⁺ = Qᵀη + J x + ½ (Qᵀη)×(J x) + ½ D(x, x)` and
    /// `ξ⁺ = ξ + R (exp[η] p(c + x) − p)`, to second order. (M1)
    #[inline]
    pub(super) fn model<const POSITION: bool>(&self, value: &ValueFunction) -> Derivatives {
        let (q, j) = (&self.rotation, &self.turning);
        let qt = q.transpose();
        let jt = j.transpose();
        let mut m = self.own;
        let lambda = value.rotation;
        let hessian = &value.rotation_rotation;
        let hessian_j = *hessian * *j;

        // First order: λ·(Qᵀη + J x).
        m.rotation += *q * lambda;
        m.control += jt * lambda;
        // Second order: the Hessian of V through Qᵀη + J x, and λ contracted with the terms ½ (Qᵀη)×(J x) and ½ D(x, x).
        m.rotation_rotation += *q * (*hessian * qt);
        m.control_control += jt * hessian_j + self.element.motion.turning_derivative(lambda);
        m.rotation_control += *q * (hessian_j - cross_matrix(lambda) * *j * 0.5);
        if POSITION {
            self.add_position(value, &mut m);
        }
        m
    }

    /// Adds what V's dependence on the position contributes to the model.
    fn add_position(&self, value: &ValueFunction, m: &mut Derivatives) {
        let (q, j, r) = (&self.rotation, &self.turning, &self.element.frame);
        let p = self.advance;
        let pull = r.transpose() * value.position;
        let (gradient, hessian) = self.element.motion.reach(1.0, 0.0).contracted(pull);
        // ξ⁺ = ξ + S η + T x + …, with S = −R [p]× and T = R ∂p/∂c.
        // The second derivative in η of f·R exp[η] p is ½ (Rᵀf pᵀ + p fᵀR) − (Rᵀf·p) I, and that in η and x is −[Rᵀf]× ∂p/∂c.
        let s = *r * cross_matrix(p) * -1.0;
        let t = *r * self.advance_jacobian;
        let (st, tt) = (s.transpose(), t.transpose());
        let rp = &value.rotation_position;
        let pp = &value.position_position;
        let rp_t = *rp * t;
        let pp_t = *pp * t;
        let jt_rp_t = j.transpose() * rp_t;
        let q_rp_s = *q * (*rp * s);

        // First order: f·(ξ + S η + T x).
        m.position += value.position;
        m.rotation += p.cross(pull);
        m.control += gradient;
        // Second order: the Hessian of V through both, and f contracted with the second derivative of ξ⁺.
        m.rotation_rotation +=
            q_rp_s + q_rp_s.transpose() + st * (*pp * s) + symmetric_outer(pull, p) * 0.5
                - scaled_identity(pull.dot(p));
        m.control_control += jt_rp_t + jt_rp_t.transpose() + tt * pp_t + hessian;
        let rp_j = rp.transpose() * *j;
        m.rotation_control +=
            *q * rp_t + st * (rp_j + pp_t) - cross_matrix(pull) * self.advance_jacobian;
        m.position_control += rp_j + pp_t;
        m.rotation_position += *q * *rp + st * *pp;
        m.position_position += *pp;
    }
}

#[inline]
fn symmetric(m: DMat3) -> DMat3 {
    (m + m.transpose()) * 0.5
}
