//! The interface of an energy: its value, gradient and Hessian on one element and on one node.

use glam::{DMat3, DVec3};

use crate::chain::{Chain, Shape};
use crate::element::Motion;
use crate::rotation::{cross_matrix, scaled_identity, symmetric_outer};

/// A conservative energy of a rod (J).
pub trait Potential: Sync {
    /// Whether any term depends on positions. Where none does, the minimiser works with frames
    /// alone, which is two to three times faster.
    fn depends_on_position(&self) -> bool;

    /// Energy of one element (J).
    fn element_energy(&self, _element: &ElementState<'_>) -> f64 {
        0.0
    }

    /// Adds the derivatives of [`Self::element_energy`].
    fn add_element_derivatives(&self, _element: &ElementState<'_>, _sum: &mut Derivatives) {}

    /// Energy of one node (J).
    fn node_energy(&self, _node: &NodeState) -> f64 {
        0.0
    }

    /// Adds the derivatives of [`Self::node_energy`]; those by the control stay as they are.
    fn add_node_derivatives(&self, _node: &NodeState, _sum: &mut Derivatives) {}

    /// The same energy on the rod with each jointed element as three elements: its first half, the joint, which has no length,
    /// and its second half, so that node 3 i of that rod is node i of this one. The derivatives of an equilibrium by natural
    /// strain need it; `None` where the energy has no such form.
    fn on_pieces(&self) -> Option<Box<dyn Potential + '_>> {
        None
    }
}

/// A node of a rod: the boundary between two elements, the root or the tip.
#[derive(Clone, Copy, Debug)]
pub struct NodeState {
    /// Index, 0 at the root.
    pub index: usize,
    /// Arc length from the root (m).
    pub s: f64,
    /// Length of rod that the node stands for (m): half of each element it touches.
    pub weight: f64,
    /// Position (m).
    pub position: DVec3,
    /// Material frame, columns d1, d2, t.
    pub frame: DMat3,
}

/// An element of a rod, seen from its start.
#[derive(Clone, Copy, Debug)]
pub struct ElementState<'a> {
    /// Index, 0 at the root.
    pub index: usize,
    /// Arc length at the end of the element (m).
    pub end: f64,
    /// Length h (m).
    pub length: f64,
    /// Position of the start (m).
    pub position: DVec3,
    /// Material frame of the start, columns d1, d2, t.
    pub frame: DMat3,
    /// Control (rad), see [`Shape::controls`].
    pub control: DVec3,
    /// Control at which the element is at rest (rad).
    pub rest: DVec3,
    /// Stiffness against the control (N m): E I1/h, E I2/h, μ J/h.
    pub stiffness: DVec3,
    pub(crate) motion: Motion<'a>,
}

impl ElementState<'_> {
    /// `ω·[α (r_end − r_start) + β ∫ (r − r_start) ds]` for a vector ω of the world: the work of a
    /// force or of a uniform load, in closed form. \[paper\] (2.4)
    #[must_use]
    #[inline]
    pub fn work(&self, omega: DVec3, alpha: f64, beta: f64) -> f64 {
        // The reach is in the start frame: ω turns into it rather than three vectors out of it.
        (self.frame.transpose() * omega).dot(self.motion.plain_reach(alpha, beta))
    }

    /// Adds the derivatives of [`Self::work`].
    #[inline]
    pub fn add_work_derivatives(&self, omega: DVec3, alpha: f64, beta: f64, sum: &mut Derivatives) {
        // 1. The vector in the material frame at the start, and what it works on.
        let omega = self.frame.transpose() * omega;
        let reach = self.motion.reach(alpha, beta);
        let q = reach.value();
        let (gradient, hessian) = reach.contracted(omega);
        // 2. By η: ω·exp[η]q = ω·(q + η×q + ½ η×(η×q) + …), hence q × ω and ½ (ω qᵀ + q ωᵀ) − (ω·q) I. (E5)
        sum.rotation += q.cross(omega);
        sum.rotation_rotation += symmetric_outer(omega, q) * 0.5 - scaled_identity(omega.dot(q));
        // 3. By x, and by both: ω·(η × ∂q/∂c x) = −η·[ω]× ∂q/∂c x.
        sum.control += gradient;
        sum.control_control += hessian;
        sum.rotation_control -= cross_matrix(omega) * reach.jacobian();
    }
}

/// Gradient and Hessian of an energy by frame (η), position (ξ) and control (x).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// Gradient by η (J).
    pub rotation: DVec3,
    /// Gradient by ξ (J/m).
    pub position: DVec3,
    /// Gradient by x (J).
    pub control: DVec3,
    /// Hessian block by η and η (J); symmetric.
    pub rotation_rotation: DMat3,
    /// Hessian block by η (rows) and ξ (columns) (J/m).
    pub rotation_position: DMat3,
    /// Hessian block by ξ and ξ (J/m²); symmetric.
    pub position_position: DMat3,
    /// Hessian block by η (rows) and x (columns) (J).
    pub rotation_control: DMat3,
    /// Hessian block by ξ (rows) and x (columns) (J/m).
    pub position_control: DMat3,
    /// Hessian block by x and x (J); symmetric.
    pub control_control: DMat3,
}

impl Derivatives {
    /// All derivatives zero, the start of a sum.
    pub const ZERO: Self = Self {
        rotation: DVec3::ZERO,
        position: DVec3::ZERO,
        control: DVec3::ZERO,
        rotation_rotation: DMat3::ZERO,
        rotation_position: DMat3::ZERO,
        position_position: DMat3::ZERO,
        rotation_control: DMat3::ZERO,
        position_control: DMat3::ZERO,
        control_control: DMat3::ZERO,
    };
}

impl Chain<'_> {
    #[inline]
    pub(crate) fn element_state(&self, shape: &Shape, i: usize) -> ElementState<'_> {
        self.element_at(i, shape.positions[i], shape.frames[i], shape.controls[i])
    }

    #[inline]
    pub(crate) fn element_at(
        &self,
        index: usize,
        position: DVec3,
        frame: DMat3,
        control: DVec3,
    ) -> ElementState<'_> {
        let geometry = self.geometry(index);
        ElementState {
            index,
            end: self.arc()[index + 1],
            length: geometry.length(),
            position,
            frame,
            control,
            rest: geometry.rest(),
            stiffness: geometry.stiffness(),
            motion: geometry.motion(control),
        }
    }

    #[inline]
    pub(crate) fn node_at(&self, index: usize, position: DVec3, frame: DMat3) -> NodeState {
        let arc = self.arc();
        // The trapezoidal rule: half of each neighbouring element; half a weight at the tip.
        let before = if index > 0 { arc[index] - arc[index - 1] } else { 0.0 };
        let after = arc.get(index + 1).map_or(0.0, |a| a - arc[index]);
        NodeState { index, s: arc[index], weight: 0.5 * (before + after), position, frame }
    }

    /// Energy of a shape in one potential (J).
    #[must_use]
    pub fn energy(&self, shape: &Shape, potential: &dyn Potential) -> f64 {
        let elements: f64 =
            (0..self.len()).map(|i| potential.element_energy(&self.element_state(shape, i))).sum();
        // The root node is clamped: its energy is a constant, and is left out.
        let nodes: f64 = (1..=self.len())
            .map(|i| potential.node_energy(&self.node_at(i, shape.positions[i], shape.frames[i])))
            .sum();
        elements + nodes
    }
}
