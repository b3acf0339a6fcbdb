//! The exact gradient, by one backward sweep of forces and moments.

use glam::{DMat3, DVec3};

use super::Problem;
use crate::chain::Shape;
use crate::potential::{Derivatives, Potential};

/// Derivative of the energy by each element's control (N m).
pub(crate) fn gradient(problem: &Problem<'_>, shape: &Shape) -> Vec<DVec3> {
    let chain = problem.chain;
    let n = chain.len();
    let mut gradient = vec![DVec3::ZERO; n];
    // The energy's derivative by the frame and the position of the node after the element: the
    // moment (in the material frame) and the force (in the world) of all that follows.
    let (mut moment, mut force) = node_load(problem, shape, n);
    for i in (0..n).rev() {
        let element = chain.element_state(shape, i);
        let mut own = Derivatives::ZERO;
        problem.add_element_derivatives(&element, &mut own);
        let motion = element.motion;
        let rotation = motion.rotation();
        gradient[i] = own.control + motion.turning().transpose() * moment;
        moment = own.rotation + rotation * moment;
        if problem.with_position {
            let pull = element.frame.transpose() * force;
            let reach = motion.reach(1.0, 0.0);
            gradient[i] += reach.jacobian().transpose() * pull;
            moment += reach.value().cross(pull);
            force += own.position;
        }
        if i > 0 {
            let (m, f) = node_load(problem, shape, i);
            moment += m;
            force += f;
        }
    }
    gradient
}

fn node_load(problem: &Problem<'_>, shape: &Shape, i: usize) -> (DVec3, DVec3) {
    if problem.external.is_empty() {
        return (DVec3::ZERO, DVec3::ZERO);
    }
    let own = problem.node_derivatives(i, shape.positions[i], shape.frames[i]);
    (own.rotation, own.position)
}

impl Problem<'_> {
    #[inline]
    pub(crate) fn add_element_derivatives(
        &self,
        element: &crate::potential::ElementState<'_>,
        sum: &mut Derivatives,
    ) {
        crate::potential::Elastic.add_element_derivatives(element, sum);
        self.gravity.add_element_derivatives(element, sum);
        for p in self.external {
            p.add_element_derivatives(element, sum);
        }
    }

    #[inline]
    pub(crate) fn node_derivatives(&self, i: usize, position: DVec3, frame: DMat3) -> Derivatives {
        let mut sum = Derivatives::ZERO;
        let node = self.chain.node_at(i, position, frame);
        for p in self.external {
            p.add_node_derivatives(&node, &mut sum);
        }
        sum
    }

    /// Energy of one element and of the node at its end (J).
    #[inline]
    pub(crate) fn step_energy(
        &self,
        element: &crate::potential::ElementState<'_>,
        end: (DVec3, DMat3),
    ) -> f64 {
        let mut energy = crate::potential::Elastic.element_energy(element)
            + self.gravity.element_energy(element);
        if !self.external.is_empty() {
            let node = self.chain.node_at(element.index + 1, end.0, end.1);
            for p in self.external {
                energy += p.element_energy(element) + p.node_energy(&node);
            }
        }
        energy
    }
}
