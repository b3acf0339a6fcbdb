//! Whether the exact rod is stable, from divisions of it: docs/theory.md, "Certificates".

use crate::minimise::Stability;

/// The smallest eigenvalue of the exact rod, from those of divisions each twice as fine as the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LeastEigenvalue {
    /// λ, extrapolated.
    pub(super) value: f64,
    /// Estimate of its error, that of the extrapolation and rounding together.
    pub(super) error: f64,
    /// The part of the error that no finer division reduces.
    rounding: f64,
    /// How far the coarser of the two divisions is from the value.
    spread: f64,
}

/// Largest spread over the eigenvalue at which shapes of divisions may be extrapolated. Near a loss of stability a shape goes as
/// 1/λ, and 1/(λ + e h²) has a series in h² that is of use for e h² well below λ alone: with a quarter the next term is a
/// hundredth. Chosen.
const RESOLVED: f64 = 0.25;

/// The same of the lean of a rod that turns freely. It goes as √(1 − x), x = e h²/ε at ε beyond the loss of stability, and differs by 3x/8
/// between two divisions: then the division before them, with 4x, has a series in h² too, and two extrapolations do not agree by chance.
pub(super) const LEAN_RESOLVED: f64 = 0.06;

impl LeastEigenvalue {
    /// Extrapolates the eigenvalues of two divisions, or of three.
    pub(super) fn extrapolated(before: Option<f64>, coarse: f64, fine: f64, rounding: f64) -> Self {
        // λ_N = λ + e h² + O(h⁴), as the shape that it belongs to.
        let extrapolate = |coarse: f64, fine: f64| (4.0 * fine - coarse) / 3.0;
        let value = extrapolate(coarse, fine);
        let error = match before {
            // Fourth order leaves a fifteenth of the gap; a quarter is the cautious reading, as for shapes.
            Some(before) => 0.25 * (value - extrapolate(before, coarse)).abs(),
            // All that the coarser one differs: nothing tells how good the extrapolation is.
            None => (value - coarse).abs(),
        };
        Self { value, error: error + rounding, rounding, spread: (value - coarse).abs() }
    }

    /// An eigenvalue that symmetry makes zero.
    pub(super) fn neutral(rounding: f64) -> Self {
        Self { value: 0.0, error: rounding, rounding, spread: 0.0 }
    }

    /// What its sign says of a shape whose gradient vanishes.
    pub(super) fn stability(&self) -> Stability {
        match self.value {
            value if value > self.error => Stability::Stable,
            value if value < -self.error => Stability::Saddle,
            // Also NaN.
            _ => Stability::Undecided,
        }
    }

    /// Whether the divisions are fine enough for a stable shape to be extrapolated from them.
    pub(super) fn is_resolved(&self) -> bool {
        // The error has the rounding in it.
        self.spread + self.error <= RESOLVED * self.value
    }

    /// Whether finer divisions could be fine enough.
    pub(super) fn is_resolvable(&self) -> bool {
        self.spread > 2.0 * self.rounding
    }

    /// Whether a finer division could tell the sign.
    pub(super) fn is_refinable(&self) -> bool {
        // Half of the error or more is rounding: it would at best be halved.
        self.error > 2.0 * self.rounding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eigenvalues of an exact λ with errors of second and fourth order, with 12, 24 and 48 elements.
    fn divisions(exact: f64) -> [f64; 3] {
        [12.0_f64, 24.0, 48.0].map(|n| exact + 0.3 / n.powi(2) + 2.0 / n.powi(4))
    }

    #[test]
    fn three_divisions_tell_a_sign_that_the_finest_has_not() {
        let [a, b, c] = divisions(-1e-4);
        assert!(c > 0.0);
        let least = LeastEigenvalue::extrapolated(Some(a), b, c, 1e-8);
        assert_eq!(least.stability(), Stability::Saddle);
        assert!((least.value + 1e-4).abs() < least.error && least.error < 1e-4);
    }

    #[test]
    fn shapes_are_extrapolated_where_the_eigenvalue_is_known_well() {
        let [a, b, c] = divisions(1e-3);
        let least = LeastEigenvalue::extrapolated(Some(a), b, c, 1e-8);
        // The sign is known, but with 24 elements λ is one and a half times what it is.
        assert_eq!(least.stability(), Stability::Stable);
        assert!(!least.is_resolved() && least.is_resolvable());
        let [a, b, c] = divisions(0.1);
        assert!(LeastEigenvalue::extrapolated(Some(a), b, c, 1e-8).is_resolved());
    }

    #[test]
    fn two_divisions_are_more_cautious() {
        let [_, b, c] = divisions(1e-5);
        let least = LeastEigenvalue::extrapolated(None, b, c, 1e-8);
        assert_eq!(least.stability(), Stability::Undecided);
        assert!(least.is_refinable());
    }

    #[test]
    fn what_is_below_rounding_stays_undecided() {
        let least = LeastEigenvalue::extrapolated(Some(-1.7e-8), -1.7e-8, -1.7e-8, 2e-8);
        assert_eq!(least.stability(), Stability::Undecided);
        assert!(!least.is_refinable());
        let nothing = LeastEigenvalue::extrapolated(None, f64::NAN, 1.0, 1e-8);
        assert_eq!(nothing.stability(), Stability::Undecided);
    }
}
