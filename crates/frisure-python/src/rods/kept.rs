//! Rods at rest that are kept for their derivatives.

use frisure::rod::Rod;
use frisure::rod::batch::BatchSolution;

use super::clamp::Clamps;

/// Rods and their equilibria.
pub(super) struct Kept {
    pub(super) rods: Vec<Rod>,
    pub(super) elements: usize,
    /// Rods of each solution but the last.
    pub(super) chunk: usize,
    pub(super) found: Vec<BatchSolution>,
    pub(super) clamps: Clamps,
}

/// Mass per length of a rod (kg/m).
pub(super) fn mass_per_length(rod: &Rod) -> f64 {
    rod.spec().material.density() * rod.spec().section.area()
}
