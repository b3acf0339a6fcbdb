//! How long a step of Newton's method may be, and when it is good enough.

/// Armijo's constant, \[Nocedal & Wright\] §3.1.
const ARMIJO: f64 = 1e-4;

/// Most trials of a step, each half as long as the one before. A guard.
pub(super) const TRIALS: usize = 12;

/// Farthest (m) that a point of any guide moves in a step, to first order: less than the radius of most wisps, so that none jumps over
/// another. Chosen; with 8 mm a quarter fewer steps are needed at times, and more wisps end in another minimum for a small change.
pub(super) const FARTHEST: f64 = 4e-3;

/// Farthest (m) that it moves in fact, where a step turns it far. Chosen: half as far again.
pub(super) const FARTHEST_TURNED: f64 = 6e-3;

/// Relative rounding error of the energy of the head: that of f64 times about a thousand for the sum over guides.
const ENERGY_ROUNDING: f64 = 1e-13;

/// Whether a step from one energy (J) to another is good enough; to first order it lowers it by `decrease` (J). Armijo's condition; where the
/// decrease drowns in rounding the gradient decides.
pub(super) fn accepts(energy: f64, found: f64, decrease: f64) -> bool {
    let noise = ENERGY_ROUNDING * energy.abs();
    found <= energy - ARMIJO * decrease || (decrease < noise && found <= energy + noise)
}
