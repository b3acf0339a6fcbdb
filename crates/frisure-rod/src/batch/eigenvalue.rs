//! Smallest eigenvalues of rods at rest, in lanes.

use fearless_simd::{Level, dispatch};

use super::adjoint_sweep::AdjointBundle;
use super::division::Joints;
use super::gradient::{Loss, load};
use super::lanes::Lanes;
use super::rotation::LARGEST_SQUARE;
use super::solution::BatchSolution;
use super::solver::{f64s, uniform};
use crate::chain::Chain;
use crate::minimise::{Problem, Stability};
use crate::resolution::ElementKind;
use crate::rod::Rod;

/// Largest size of an eigenvalue that is looked for, most halvings of the bracket, and its relative width at the end; as in the scalar
/// code.
const LARGEST: f64 = 1e12;
const MOST_HALVINGS: usize = 44;
const WIDTH: f64 = 1e-10;

/// Where the smallest eigenvalue of a rod lies: above one number, and not above another; infinite where that is not known yet.
#[derive(Clone, Copy)]
struct Bracket {
    above: f64,
    below: f64,
    halvings: usize,
}

impl Bracket {
    const UNKNOWN: Self = Self { above: f64::NEG_INFINITY, below: f64::INFINITY, halvings: 0 };

    /// The number to compare with next: zero, then away from it by doubling, then the middle.
    fn next(&self) -> f64 {
        match (self.above.is_finite(), self.below.is_finite()) {
            (true, true) => self.middle(),
            (false, false) => 0.0,
            (true, false) => (2.0 * self.above).max(1.0),
            (false, true) => (2.0 * self.below).min(-1.0),
        }
    }

    fn middle(&self) -> f64 {
        0.5 * (self.above + self.below)
    }

    fn narrow(&mut self, at: f64, is_above: bool) {
        self.halvings += usize::from(self.above.is_finite() && self.below.is_finite());
        *(if is_above { &mut self.above } else { &mut self.below }) = at;
    }

    /// The eigenvalue, if it is known well enough.
    fn value(&self) -> Option<f64> {
        let (above, below) = (self.above, self.below);
        if above >= LARGEST {
            return Some(above);
        }
        if below <= -LARGEST {
            return Some(below);
        }
        let known = above.is_finite() && below.is_finite();
        let narrow = below - above < WIDTH * above.abs().max(below.abs());
        (known && (narrow || self.halvings >= MOST_HALVINGS)).then(|| self.middle())
    }
}

impl BatchSolution {
    /// The smallest eigenvalue of each rod at rest, [`crate::Certificate::min_eigenvalue`]: 1 without weight, 0 where stability is lost;
    /// NaN for a rod that is not at rest. By bisection, on this thread: some forty backward sweeps, about as long as to solve the rods
    /// four times.
    ///
    /// # Panics
    /// If the rods are not as many as were solved.
    #[must_use]
    pub fn min_eigenvalues(&self, rods: &[Rod]) -> Vec<f64> {
        assert_eq!(rods.len(), self.rods.len(), "the rods that were solved");
        let mut values = vec![f64::NAN; rods.len()];
        dispatch!(Level::new(), simd => in_lanes(f64s(simd), rods, self, &mut values));
        values
    }
}

#[inline(always)]
fn in_lanes<F: Lanes>(zero: F, rods: &[Rod], found: &BatchSolution, values: &mut [f64]) {
    let n = found.elements;
    let mut bundle = AdjointBundle::new(zero, n, uniform(rods));
    let mut joints = Joints::default();
    let mut brackets = vec![Bracket::UNKNOWN; F::LANES];
    for first in (0..rods.len()).step_by(F::LANES) {
        let lanes = F::LANES.min(rods.len() - first);
        for (lane, rod) in (0..lanes).zip(first..) {
            joints.divide(&rods[rod], n);
            load(&mut bundle, lane, (&rods[rod], rod), &joints, found, Loss::none(n));
        }
        bundle.shape();
        let brackets = &mut brackets[..lanes];
        brackets.fill(Bracket::UNKNOWN);
        while brackets.iter().any(|bracket| bracket.value().is_none()) {
            let mut at = zero;
            for (lane, bracket) in brackets.iter().enumerate() {
                at.set(lane, bracket.next());
            }
            let pivot = bundle.pivot_above(at);
            for (lane, bracket) in brackets.iter_mut().enumerate() {
                if bracket.value().is_none() {
                    // NaN is not above either.
                    bracket.narrow(at.get(lane), pivot.get(lane) > 0.0);
                }
            }
        }
        for (bracket, rod) in brackets.iter().zip(first..) {
            if found.rods[rod].stability == Stability::NotConverged {
                continue;
            }
            let controls = &found.controls[rod * n..(rod + 1) * n];
            values[rod] = if controls.iter().all(|c| c.length_squared() < LARGEST_SQUARE) {
                bracket.value().unwrap_or(f64::NAN)
            } else {
                let chain = Chain::uniform(&rods[rod], ElementKind::Jointed, n);
                Problem::new(&chain, &[]).min_eigenvalue(&found.shape(&rods[rod], rod))
            };
        }
    }
}
