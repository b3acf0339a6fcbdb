//! What certifies a minimum: the norm of the gradient and the smallest eigenvalue of the Hessian.

use glam::DVec3;

use super::linearise::Linearisation;
use super::problem::Problem;
use crate::chain::Shape;
use crate::potential::Potential;

impl Problem<'_> {
    /// Derivatives of the energy by each element's control (N m).
    #[must_use]
    pub fn gradient(&self, shape: &Shape) -> Vec<DVec3> {
        if self.with_position {
            Linearisation::<true>::new(self, shape).gradient
        } else {
            Linearisation::<false>::new(self, shape).gradient
        }
    }

    /// Derivatives by each element's control (N m) of the energy that a shape has of one more potential.
    #[must_use]
    pub fn gradient_of(&self, potential: &dyn Potential, shape: &Shape) -> Vec<DVec3> {
        // A sweep knows sums only: with the potential, less without.
        let elastic = Problem::with_load(self.chain, &[], 0.0).gradient(shape);
        let felt = [potential];
        let both = Problem::with_load(self.chain, &felt, 0.0).gradient(shape);
        both.into_iter().zip(elastic).map(|(both, elastic)| both - elastic).collect()
    }

    /// Largest derivative of the energy by any element's control, relative to
    /// [`crate::Rod::moment_scale`].
    #[must_use]
    pub fn gradient_norm(&self, shape: &Shape) -> f64 {
        self.gradient(shape).iter().map(|g| g.length()).fold(0.0, f64::max)
            / self.chain.rod().moment_scale()
    }

    /// Smallest λ in `H x = λ M x`, H the second variation of the energy by the controls and M
    /// that of the elastic energy: 1 without loads, 0 where stability is lost. The shape must be
    /// an equilibrium; elsewhere the second variation depends on coordinates and means little.
    #[must_use]
    pub fn min_eigenvalue(&self, shape: &Shape) -> f64 {
        if self.with_position {
            smallest_eigenvalue(&Linearisation::<true>::new(self, shape))
        } else {
            smallest_eigenvalue(&Linearisation::<false>::new(self, shape))
        }
    }
}

/// Bisection on the inertia (Sylvester): `H + σ M` has only positive pivots exactly when σ > −λ_min.
fn smallest_eigenvalue<const POSITION: bool>(at: &Linearisation<'_, POSITION>) -> f64 {
    // Docs/theory.md, "Certificates". The damping of a sweep is relative to K/h, the Hessian M of the elastic energy.
    let stable_at = |sigma: f64| at.sweep(sigma).is_ok();
    // 1. Bracket −λ_min by doubling; the bound 1e12 is chosen, far beyond any load that f64 resolves.
    let (mut low, mut high) = (-1.0, 0.0);
    if stable_at(0.0) {
        while stable_at(low) {
            (low, high) = (2.0 * low, low);
            if low < -1e12 {
                return -low;
            }
        }
    } else {
        (low, high) = (0.0, 1.0);
        while !stable_at(high) {
            (low, high) = (high, 2.0 * high);
            if high > 1e12 {
                return -high;
            }
        }
    }
    // 2. Halve the bracket to ten digits of λ, or, where λ is near zero, to 2⁻⁴⁴ of the first width.
    for _ in 0..44 {
        let middle = 0.5 * (low + high);
        if stable_at(middle) {
            high = middle;
        } else {
            low = middle;
        }
        if high - low < 1e-10 * low.abs().max(high.abs()) {
            break;
        }
    }
    -0.5 * (low + high)
}
