//! How guides rest.

use frisure_rod::Equilibrium;
use frisure_rod::potential::Yielding;

/// Guides at rest.
#[derive(Clone, Debug)]
pub(crate) struct Rest {
    pub(crate) guides: Vec<Equilibrium>,
    /// Energy of wisps that overlap (J), each pair counted once.
    pub(crate) overlap_energy: f64,
    /// Sweeps over the guides, or steps of all together.
    pub(crate) sweeps: usize,
    /// The certificate of all guides together, if they were settled together.
    pub(crate) joint: Option<JointCertificate>,
    /// Largest |f_t| / μ f_n of each guide, friction over what the law allows; 0 where no friction was felt.
    pub(crate) friction: Vec<f64>,
    /// How the hairs inside each wisp stick; empty where none of any wisp do.
    pub(crate) locks: Vec<Option<Yielding>>,
}

/// What was checked of all guides of a head together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointCertificate {
    /// Largest derivative of the energy of the head by any control, relative to the moment scale EI/L + ρSgL² of its guide.
    pub gradient_norm: f64,
    /// Lowest eigenvalue of the second variation of the head, relative to that of each guide while the others hold still: 1
    /// without contact, positive at a minimum. `None` if a guide is at no minimum by itself. docs/theory.md (H4)
    pub lowest_eigenvalue: Option<f64>,
    /// Residual of that eigenvalue: an eigenvalue lies within it.
    pub eigenvalue_error: f64,
    /// Whether the gradient is below the tolerance, and the lowest eigenvalue above zero by more than its residual.
    pub stable: bool,
}

impl Rest {
    /// Takes over what is known of the divisions of the guides: among others a guide has the one that it has alone.
    pub(crate) fn divided_like(&mut self, alone: &[Equilibrium]) {
        for (guide, alone) in self.guides.iter_mut().zip(alone) {
            guide.certificate.accuracy = alone.certificate.accuracy;
        }
    }

    /// Guides that do not touch each other.
    pub(crate) fn apart(guides: Vec<Equilibrium>) -> Self {
        let friction = vec![0.0; guides.len()];
        Self { guides, overlap_energy: 0.0, sweeps: 0, joint: None, friction, locks: Vec::new() }
    }
}
