//! The energy to second order at one shape: gradient and Hessian blocks of each element, and the whole gradient.

use glam::{DMat3, DVec3};

use super::problem::Problem;
use crate::chain::Shape;
use crate::potential::{Derivatives, ElementState};

/// One element at the present shape, without what follows it.
pub(super) struct Stage<'a> {
    pub(super) element: ElementState<'a>,
    /// Q: rotation from the start frame to the end frame.
    pub(super) rotation: DMat3,
    /// J: a change x of the control turns the end frame by `J x`.
    pub(super) turning: DMat3,
    /// p: advance (m) in the start frame, and its derivative by the control. Zero without positions.
    pub(super) advance: DVec3,
    pub(super) advance_jacobian: DMat3,
    /// Gradient and Hessian blocks of the element's own energy.
    pub(super) own: Derivatives,
}

/// All elements at the present shape. `POSITION`: whether an external potential depends on positions; without, the
/// state of the control problem is the frame alone.
pub(super) struct Linearisation<'a, const POSITION: bool> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) stages: Vec<Stage<'a>>,
    /// Derivatives at each node but the root; empty without external potentials.
    pub(super) nodes: Vec<Derivatives>,
    /// Derivative of the energy by each element's control (N m).
    pub(super) gradient: Vec<DVec3>,
}

impl<'a, const POSITION: bool> Linearisation<'a, POSITION> {
    pub(super) fn new(problem: &'a Problem<'a>, shape: &Shape) -> Self {
        let chain = problem.chain;
        let mut stages = Vec::with_capacity(chain.len());
        for i in 0..chain.len() {
            let element = chain.element_state(shape, i);
            let motion = element.motion;
            // Without positions nothing reads p and ∂p/∂c: the sweep is two to three times faster.
            let (advance, advance_jacobian) = if POSITION {
                let reach = motion.reach(1.0, 0.0);
                (reach.value(), reach.jacobian())
            } else {
                (DVec3::ZERO, DMat3::ZERO)
            };
            stages.push(Stage {
                rotation: motion.rotation(),
                turning: motion.turning(),
                advance,
                advance_jacobian,
                own: Derivatives::ZERO,
                element,
            });
            let stage = &mut stages[i];
            problem.add_element_derivatives(&stage.element, &mut stage.own);
        }
        // Elastic energy and weight are energies of elements: only external potentials have terms at nodes.
        let nodes = if problem.external.is_empty() {
            Vec::new()
        } else {
            (1..=chain.len())
                .map(|i| problem.node_derivatives(i, shape.positions[i], shape.frames[i]))
                .collect()
        };
        let mut built = Self { problem, stages, nodes, gradient: Vec::new() };
        built.gradient = built.adjoint_sweep();
        built
    }

    /// The exact gradient by one backward sweep of moments and forces, docs/theory.md (M4).
    fn adjoint_sweep(&self) -> Vec<DVec3> {
        let n = self.stages.len();
        let mut gradient = vec![DVec3::ZERO; n];
        // λ (N m, material frame) and f (N, world): derivatives of the energy of everything beyond the present node by
        // its frame and its position.
        // The tip is free: both vanish beyond it.
        let (mut moment, mut force) = (DVec3::ZERO, DVec3::ZERO);
        for i in (0..n).rev() {
            // Node i + 1, at the end of element i; the root, which is clamped, has no entry.
            if let Some(node) = self.nodes.get(i) {
                moment += node.rotation;
                force += node.position;
            }
            let stage = &self.stages[i];
            // dE/dc = ∂E_i/∂c + Jᵀλ, and λ before the element = ∂E_i/∂η + Q λ.
            gradient[i] = stage.own.control + stage.turning.transpose() * moment;
            moment = stage.own.rotation + stage.rotation * moment;
            if POSITION {
                // The force acts at the end of the element, with the lever p.
                let pull = stage.element.frame.transpose() * force;
                gradient[i] += stage.advance_jacobian.transpose() * pull;
                moment += stage.advance.cross(pull);
                force += stage.own.position;
            }
        }
        gradient
    }

    /// Largest derivative by any element's control (N m).
    pub(super) fn largest_gradient(&self) -> f64 {
        self.gradient.iter().map(|g| g.length()).fold(0.0, f64::max)
    }
}
