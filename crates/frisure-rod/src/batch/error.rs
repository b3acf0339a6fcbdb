//! The error of rods at rest from their division into elements, by comparison with fewer elements.

use glam::DVec3;

use super::solution::BatchSolution;
use super::solver::Batch;
use crate::minimise::Stability;
use crate::resolution::follows_curl;
use crate::rod::Rod;
use crate::unresolved::unresolved;

/// Shares of the gap between a division and one into half as many elements that the estimate may be. The limit for short elements is a third:
/// the error is of second order in their length. Chosen, with [`SAFETY`]: of 4 000 random rods in 8 to 128 elements, at most 1 % were above
/// their estimate, and the median was half to two thirds of it.
const SHARES: (f64, f64) = (0.5, 2.0);

/// The share where a quarter as many elements are no whole number. Chosen: at most 0.8 % of the same rods were above it, and the median was a third of it.
const UNKNOWN_RATIO: f64 = 1.0;

/// What the tail of a geometric series is multiplied by. Chosen: half as much again.
const SAFETY: f64 = 1.5;

/// How far the same rod, rounded otherwise, is from its place (length over relative gradient), as for a single rod: docs/theory.md,
/// "Extrapolation, accuracy and the estimate of error".
const PER_GRADIENT: f64 = 10.0;

impl Batch {
    /// The estimated error (m) of the nodes of each rod that [`Self::solve`] has found, by docs/theory.md, "Extrapolation, accuracy and the
    /// estimate of error".
    ///
    /// The rods are solved with half and, where it divides, a quarter as many elements. The estimate is infinite where there is none: for an odd number of elements, for a shape that is no minimum, and where an element turns by more than half a turn with the
    /// natural curl. It supposes that fewer elements have the same equilibrium; another one that many more elements have is not known to it.
    ///
    /// # Panics
    /// If the rods are not as many as were solved.
    #[must_use]
    pub fn errors(&self, rods: &[Rod], found: &BatchSolution) -> Vec<f64> {
        let n = found.elements;
        if !n.is_multiple_of(2) {
            return vec![f64::INFINITY; rods.len()];
        }
        // 1. How far the nodes of a division are from those of the one before it.
        let half = Batch { elements: n / 2, ..*self }.solve(rods);
        let middle = half.positions(rods);
        let gaps = largest_gaps(&found.positions(rods), &middle, n);
        let gaps_before = n.is_multiple_of(4).then(|| {
            let quarter = Batch { elements: n / 4, ..*self }.solve(rods);
            largest_gaps(&middle, &quarter.positions(rods), n / 2)
        });
        // 2. All gaps to come: each is q times the one before.
        let estimate = |(i, rod): (usize, &Rod)| {
            if found.rods[i].stability != Stability::Stable || !follows_curl(rod, n) {
                return f64::INFINITY;
            }
            let share =
                gaps_before.as_ref().map_or(UNKNOWN_RATIO, |before| share(gaps[i], before[i]));
            // 3. What both divisions leave out of a varying strain, and what the gradient leaves.
            let left_out = unresolved(rod, rod.length() / n as f64);
            share * gaps[i] + left_out + PER_GRADIENT * found.rods[i].gradient_norm * rod.length()
        };
        rods.iter().enumerate().map(estimate).collect()
    }
}

/// The share of the last gap that is left to come: `q + q² + … = q/(1 − q)` of gaps in the ratio q.
fn share(gap: f64, before: f64) -> f64 {
    // Gaps that do not decrease have no sum; neither have two that are nothing.
    if gap < before { (SAFETY * gap / (before - gap)).clamp(SHARES.0, SHARES.1) } else { SHARES.1 }
}

/// The largest distance (m) between the nodes of `elements` elements and half as many, for each rod.
fn largest_gaps(fine: &[DVec3], coarse: &[DVec3], elements: usize) -> Vec<f64> {
    let rods = fine.chunks_exact(elements + 1).zip(coarse.chunks_exact(elements / 2 + 1));
    let gap = |(fine, coarse): (&[DVec3], &[DVec3])| {
        let distances = coarse.iter().zip(fine.iter().step_by(2)).map(|(a, b)| a.distance(*b));
        distances.fold(0.0, f64::max)
    };
    rods.map(gap).collect()
}
