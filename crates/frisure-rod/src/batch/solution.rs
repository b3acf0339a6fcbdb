//! The results of a batch.

use glam::DVec3;

use crate::chain::{Chain, Shape};
use crate::minimise::Stability;
use crate::resolution::ElementKind;
use crate::rod::Rod;

/// One rod of a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodSolution {
    /// Whether the shape is a minimum.
    pub stability: Stability,
    /// Relative gradient, in double precision.
    pub gradient_norm: f64,
    /// Iterations of all kinds.
    pub iterations: usize,
    /// Elastic energy and that of the weight (J), as [`crate::Energy::total`], and contact energy.
    pub energy: f64,
}

/// Rods at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchSolution {
    /// Elements of each rod.
    pub elements: usize,
    /// Turns of the joints (rad), those of a rod one after the other.
    pub controls: Vec<DVec3>,
    /// One for each rod.
    pub rods: Vec<RodSolution>,
}

impl BatchSolution {
    /// The shape of the rod of an index; `rod` is the one that was solved.
    #[must_use]
    pub fn shape(&self, rod: &Rod, index: usize) -> Shape {
        let n = self.elements;
        let chain = Chain::uniform(rod, ElementKind::Jointed, n);
        chain.shape(self.controls[index * n..(index + 1) * n].to_vec())
    }
}
