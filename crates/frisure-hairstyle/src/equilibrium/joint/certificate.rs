//! Whether a head at rest is a minimum: the lowest eigenvalue of the Hessian of all guides together.

use super::hessian::{JointHessian, Preconditioner, add, dot, zero};
use crate::random::{Purpose, Stream};
use glam::DVec3;

/// Iterations of Lanczos's method at most. Chosen: the lowest eigenvalue is found to a hundredth after about 60.
const ITERATIONS: usize = 120;

/// Relative error of the lowest eigenvalue at which the search for it ends.
const ACCURACY: f64 = 1e-2;

/// How often the residual is computed: every so many iterations.
const CHECK: usize = 10;

/// The lowest eigenvalue λ of `H x = λ M x`, with the Hessian H of all guides together and that of each while the others hold
/// still, `M = diag(H_i)`. If M is positive definite, H is so if and only if λ > 0; without contact λ is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LowestEigenvalue {
    pub(super) value: f64,
    /// Norm of the residual: an eigenvalue lies within it. That no other is lower is likely, not proven: the start is random.
    pub(super) error: f64,
}

/// Lanczos's method in the scalar product of M, from a random start; \[Saad\] §6.6 and §13.2.
pub(super) fn lowest_eigenvalue(
    hessian: &JointHessian,
    preconditioner: &Preconditioner<'_>,
    seed: u64,
) -> LowestEigenvalue {
    let mut random = Stream::new(seed, Purpose::Lanczos, 0);
    let like = hessian.gradient();
    // 1. v in the space of moments with vᵀ M⁻¹ v = 1, and M⁻¹ v.
    let mut v = zero(&like);
    for x in v.iter_mut().flatten() {
        *x = DVec3::from_array([(); 3].map(|()| random.gaussian()));
    }
    let mut z = preconditioner.solve(&v);
    let mut norm = dot(&v, &z).sqrt();
    let mut before = zero(&like);
    let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
    let mut found = LowestEigenvalue { value: f64::INFINITY, error: f64::INFINITY };
    for k in 1..=ITERATIONS {
        for x in [&mut v, &mut z] {
            x.iter_mut().flatten().for_each(|x| *x /= norm);
        }
        // 2. The three-term recursion: H M⁻¹ v − α v − β v of before.
        let mut next = hessian.apply(&z).moments;
        let alpha = dot(&next, &z);
        add(&mut next, -alpha, &v);
        if let Some(beta) = beside.last() {
            add(&mut next, -beta, &before);
        }
        diagonal.push(alpha);
        before = std::mem::replace(&mut v, next);
        z = preconditioner.solve(&v);
        norm = dot(&v, &z).max(0.0).sqrt();
        // 3. The lowest eigenvalue of the tridiagonal matrix; its residual is β times the last part of its vector.
        let invariant = norm <= f64::EPSILON * alpha.abs();
        if k % CHECK == 0 || k == ITERATIONS || invariant {
            let (value, last) = lowest_of_tridiagonal(&diagonal, &beside);
            found = LowestEigenvalue { value, error: norm * last };
            if invariant || found.error <= ACCURACY * value.abs() {
                break;
            }
        }
        beside.push(norm);
    }
    found
}

/// The lowest eigenvalue of a symmetric tridiagonal matrix, and the magnitude of the last part of its unit eigenvector.
fn lowest_of_tridiagonal(diagonal: &[f64], beside: &[f64]) -> (f64, f64) {
    let n = diagonal.len();
    let b = |i: usize| beside.get(i).copied().unwrap_or(0.0);
    // 1. Gershgorin's bounds, then bisection: all pivots of T − x I are positive if and only if x is below all eigenvalues.
    let row = |i: usize| b(i).abs() + if i > 0 { b(i - 1).abs() } else { 0.0 };
    let rows = 0..n;
    let mut low = rows.clone().map(|i| diagonal[i] - row(i)).fold(f64::INFINITY, f64::min);
    let mut high = rows.map(|i| diagonal[i] + row(i)).fold(f64::NEG_INFINITY, f64::max);
    let below_all = |x: f64| {
        let mut pivot = 1.0;
        (0..n).all(|i| {
            let coupling = if i > 0 { b(i - 1) } else { 0.0 };
            pivot = diagonal[i] - x - coupling * coupling / pivot;
            pivot > 0.0
        })
    };
    // Each halving gains a bit; 100 are more than a number has.
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if below_all(middle) { low = middle } else { high = middle }
    }
    // 2. Inverse iteration just below it, where T − x I is positive definite and needs no pivoting.
    let shift = low - 1e-12 * (high.abs() + low.abs()).max(f64::MIN_POSITIVE);
    let mut vector = vec![1.0; n];
    for _ in 0..3 {
        let mut pivots = vec![0.0; n];
        for i in 0..n {
            let factor = if i > 0 { b(i - 1) / pivots[i - 1] } else { 0.0 };
            pivots[i] = diagonal[i] - shift - if i > 0 { factor * b(i - 1) } else { 0.0 };
            if i > 0 {
                vector[i] -= factor * vector[i - 1];
            }
        }
        for i in (0..n).rev() {
            let beyond = if i + 1 < n { b(i) * vector[i + 1] } else { 0.0 };
            vector[i] = (vector[i] - beyond) / pivots[i];
        }
        let norm = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        vector.iter_mut().for_each(|x| *x /= norm);
    }
    (low, vector[n - 1].abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_eigenvalue_of_a_chain_of_springs_is_that_of_its_closed_form() {
        // 2 on the diagonal, −1 beside it: eigenvalues 2 − 2 cos(jπ/(n + 1)), vectors sin(ijπ/(n + 1)).
        let n = 12;
        let (value, last) = lowest_of_tridiagonal(&vec![2.0; n], &vec![-1.0; n - 1]);
        let angle = std::f64::consts::PI / (n as f64 + 1.0);
        assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 1e-13, "{value}");
        let exact = (n as f64 * angle).sin() * (2.0 / (n as f64 + 1.0)).sqrt();
        assert!((last - exact).abs() < 1e-10, "{last} {exact}");
    }
}
