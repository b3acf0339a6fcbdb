//! Minimisers of a rod's energy, behind one interface.
//!
//! [`Newton`] is the one to use; [`Lbfgs`] is slow and uses no second derivative: it is
//! the reference solver of the tests.

mod adjoint;
mod lbfgs;
mod pivot;
mod riccati;

pub use lbfgs::Lbfgs;
pub use riccati::{Newton, NewtonStep};

pub(crate) use riccati::second_variation;

use crate::chain::{Chain, Shape};
use crate::potential::{Elastic, Gravity, Potential};

/// An energy to minimise: a divided rod in its own weight and in other potentials.
pub struct Problem<'a> {
    pub(crate) chain: &'a Chain<'a>,
    pub(crate) gravity: Gravity,
    pub(crate) external: &'a [&'a dyn Potential],
    pub(crate) with_position: bool,
}

impl<'a> Problem<'a> {
    /// A rod in its whole weight.
    #[must_use]
    pub fn new(chain: &'a Chain<'a>, external: &'a [&'a dyn Potential]) -> Self {
        Self::with_load(chain, external, 1.0)
    }

    /// A rod in a fraction of its weight; other potentials act in full.
    #[must_use]
    pub fn with_load(
        chain: &'a Chain<'a>,
        external: &'a [&'a dyn Potential],
        fraction: f64,
    ) -> Self {
        let rod = chain.rod();
        let gravity = Gravity { weight: rod.weight() * fraction, length: rod.length() };
        let with_position = external.iter().any(|p| p.depends_on_position());
        Self { chain, gravity, external, with_position }
    }

    /// Energies of a shape.
    #[must_use]
    pub fn energy(&self, shape: &Shape) -> Energy {
        let mut sum = Energy::default();
        for i in 0..self.chain.len() {
            let element = self.chain.element_state(shape, i);
            sum.elastic += Elastic.element_energy(&element);
            sum.gravity += self.gravity.element_energy(&element);
            if !self.external.is_empty() {
                // The root node is clamped: its energy is a constant, and is left out.
                let (position, frame) = (shape.positions[i + 1], shape.frames[i + 1]);
                let node = self.chain.node_at(i + 1, position, frame);
                for p in self.external {
                    sum.external += p.element_energy(&element) + p.node_energy(&node);
                }
            }
        }
        sum
    }

    /// Largest derivative of the energy by any element's control, relative to
    /// [`crate::Rod::moment_scale`].
    #[must_use]
    pub fn gradient_norm(&self, shape: &Shape) -> f64 {
        adjoint::gradient(self, shape).iter().map(|g| g.length()).fold(0.0, f64::max)
            / self.chain.rod().moment_scale()
    }

    /// Derivatives of the energy by each element's control (N m).
    #[must_use]
    pub fn gradient(&self, shape: &Shape) -> Vec<glam::DVec3> {
        adjoint::gradient(self, shape)
    }

    /// Smallest λ in `H x = λ M x`, H the second variation of the energy by the controls and M
    /// that of the elastic energy: 1 without loads, 0 where stability is lost. The shape must be
    /// an equilibrium; elsewhere the second variation depends on coordinates and means little.
    #[must_use]
    pub fn min_eigenvalue(&self, shape: &Shape) -> f64 {
        second_variation(self, shape)
    }

    /// The eigenvalue that is zero but for rounding, on the scale of [`Self::min_eigenvalue`]: a
    /// rod clamped upright that fell over may turn about the vertical freely.
    pub(crate) fn neutral(&self) -> f64 {
        let rod = self.chain.rod();
        let stiffness = rod.stiffness().min_element() * self.chain.len() as f64 / rod.length();
        1e-8 * (rod.moment_scale() / stiffness).max(1.0)
    }

    /// The divided rod.
    #[must_use]
    pub fn chain(&self) -> &'a Chain<'a> {
        self.chain
    }
}

/// Energies of a shape (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Bending and twist. \[paper\] (2.3)
    pub elastic: f64,
    /// Weight, zero when all is at the height of the root. \[paper\] (2.4)
    pub gravity: f64,
    /// All other potentials.
    pub external: f64,
}

impl Energy {
    /// The sum. \[paper\] (2.2)
    #[must_use]
    pub fn total(&self) -> f64 {
        self.elastic + self.gravity + self.external
    }
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoppingCriteria {
    /// Relative gradient ([`Problem::gradient_norm`]) to reach.
    pub tolerance: f64,
    /// Most iterations.
    pub max_iterations: usize,
}

/// What a shape is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stability {
    /// The gradient vanishes and the second variation is positive, or zero but for rounding where
    /// the rod may turn freely: a minimum.
    Stable,
    /// The gradient vanishes, but some direction lowers the energy.
    Saddle,
    /// The gradient does not vanish.
    NotConverged,
}

/// Where a minimiser ended.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The shape.
    pub shape: Shape,
    /// Relative gradient there.
    pub gradient_norm: f64,
    /// Iterations taken.
    pub iterations: usize,
    /// What the shape is.
    pub stability: Stability,
}

/// Finds a minimum of an energy from a given shape. Every accepted step lowers the energy.
pub trait Minimiser {
    /// Goes downhill from `start` to a minimum.
    fn minimise(&self, problem: &Problem<'_>, start: Shape, stopping: StoppingCriteria) -> Minimum;
}
