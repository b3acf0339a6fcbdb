//! How guides rest.

use frisure_rod::Equilibrium;

/// Guides at rest.
#[derive(Clone, Debug)]
pub(crate) struct Rest {
    pub(crate) guides: Vec<Equilibrium>,
    /// Energy of wisps that overlap (J), each pair counted once.
    pub(crate) overlap_energy: f64,
    /// Sweeps over the guides.
    pub(crate) sweeps: usize,
}

impl Rest {
    /// Guides that do not touch each other.
    pub(crate) fn apart(guides: Vec<Equilibrium>) -> Self {
        Self { guides, overlap_energy: 0.0, sweeps: 0 }
    }
}
