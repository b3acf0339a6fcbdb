//! The energy that is minimised: elastic energy, weight and external potentials of a divided rod.

use glam::{DMat3, DVec3};

use crate::chain::{Chain, Shape};
use crate::potential::{Derivatives, Elastic, ElementState, Gravity, Potential};

/// Magnitude of an eigenvalue that counts as zero, relative to the larger of the elastic stiffness and the moment scale.
/// Chosen: far above the rounding of pivots (1e-13), and a rod that is this near to buckling is at its limit anyway.
const NEUTRAL_EIGENVALUE: f64 = 1e-8;

/// A relative gradient that may be the smallest that rounding allows. Chosen by trial.
pub(super) const ROUNDED_GRADIENT: f64 = 1e-6;

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
        let gravity =
            Gravity { up: rod.up(), weight: rod.weight() * fraction, length: rod.length() };
        // Weight counts as independent of positions: E_g = ρSg ∫ (L − s) t·e_z ds needs frames alone. [paper] (2.4)
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

    /// The divided rod.
    #[must_use]
    pub fn chain(&self) -> &'a Chain<'a> {
        self.chain
    }

    /// The eigenvalue that is zero but for rounding, on the scale of [`Self::min_eigenvalue`], at a shape with this
    /// relative gradient: a rod clamped upright that fell over may turn about the vertical freely.
    pub(crate) fn neutral_eigenvalue(&self, gradient_norm: f64) -> f64 {
        // 1e-8, or 1e-8 (EI/L + ρSgL²)/(K/h) where that is more. docs/theory.md, "Certificates"
        let rod = self.chain.rod();
        let (stiffness, scale) = (rod.stiffness().min_element(), rod.moment_scale());
        let rounding = NEUTRAL_EIGENVALUE
            * (scale * rod.length() / (stiffness * self.chain.len() as f64)).max(1.0);
        // Off equilibrium the second variation along a free turn is −g·c″, with c″ that of the controls by the turn, about
        // as large as a bend of one radian: g (EI/L + ρSgL²)/(K/L).
        if gradient_norm <= ROUNDED_GRADIENT {
            rounding + gradient_norm * scale * rod.length() / stiffness
        } else {
            rounding
        }
    }

    #[inline]
    pub(crate) fn add_element_derivatives(
        &self,
        element: &ElementState<'_>,
        sum: &mut Derivatives,
    ) {
        Elastic.add_element_derivatives(element, sum);
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
        element: &ElementState<'_>,
        position: DVec3,
        frame: DMat3,
    ) -> f64 {
        let mut energy = Elastic.element_energy(element) + self.gravity.element_energy(element);
        if !self.external.is_empty() {
            let node = self.chain.node_at(element.index + 1, position, frame);
            for p in self.external {
                energy += p.element_energy(element) + p.node_energy(&node);
            }
        }
        energy
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
