//! The elastic energy: bending and twist.

use glam::DMat3;

use super::term::{Derivatives, ElementState, Potential};

/// `Σ ½ (c − c⁰)ᵀ (K/h) (c − c⁰)`: Hooke's law in each element. \[paper\] (2.3)
#[derive(Clone, Copy, Debug, Default)]
pub struct Elastic;

impl Potential for Elastic {
    fn depends_on_position(&self) -> bool {
        false
    }

    #[inline]
    fn element_energy(&self, e: &ElementState<'_>) -> f64 {
        let bent = e.control - e.rest;
        0.5 * bent.dot(e.stiffness * bent)
    }

    #[inline]
    fn add_element_derivatives(&self, e: &ElementState<'_>, sum: &mut Derivatives) {
        // Gradient K/h (c − c⁰), Hessian K/h.
        sum.control += e.stiffness * (e.control - e.rest);
        sum.control_control += DMat3::from_diagonal(e.stiffness);
    }
}
