//! L-BFGS, a quasi-Newton descent without second derivatives: the reference solver of the tests.

use std::collections::VecDeque;

use glam::DVec3;

use super::minimiser::{CLEAR_EIGENVALUE, Minimiser, Minimum, Stability, StoppingCriteria};
use super::problem::Problem;
use crate::chain::Shape;

/// Limited-memory BFGS, preconditioned by the elastic stiffness, with Armijo backtracking. \[Nocedal & Wright\] algorithm 7.5
///
/// It stays in the symmetry of its start: at a symmetric saddle it reports a saddle.
#[derive(Clone, Copy, Debug)]
pub struct Lbfgs {
    /// Number of past steps remembered.
    pub memory: usize,
}

impl Default for Lbfgs {
    fn default() -> Self {
        // Chosen: the upper end of the range, 3 to 20, that [Nocedal & Wright] §7.2 recommend.
        Self { memory: 20 }
    }
}

/// Largest turn (rad) of a control in the first trial of a line search. Chosen: smaller than the trust region of Newton's
/// method, since these directions are less exact.
const LARGEST_TURN: f64 = 0.7;

/// Most halvings of a step: 2⁻⁵⁰ of a turn is its rounding error.
const HALVINGS: usize = 50;

/// Armijo's constant: the part of the expected decrease that a step has to reach. [Nocedal & Wright] §3.1.
const ARMIJO: f64 = 1e-4;

struct Pair {
    step: Vec<DVec3>,
    change: Vec<DVec3>,
    inverse: f64,
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

fn add_scaled(a: &mut [DVec3], factor: f64, b: &[DVec3]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += *b * factor;
    }
}

impl Minimiser for Lbfgs {
    fn minimise(&self, problem: &Problem<'_>, start: Shape, stopping: StoppingCriteria) -> Minimum {
        let mut shape = start;
        let mut energy = problem.energy(&shape).total();
        let mut gradient = problem.gradient(&shape);
        let mut pairs: VecDeque<Pair> = VecDeque::new();
        let mut iterations = 0;
        let norm = |g: &[DVec3]| {
            g.iter().map(|g| g.length()).fold(0.0, f64::max) / problem.chain.rod().moment_scale()
        };
        while norm(&gradient) > stopping.tolerance && iterations < stopping.max_iterations {
            iterations += 1;
            let direction = descent(problem, &gradient, &pairs);
            let slope = dot(&direction, &gradient);
            let Some((next, lowered)) = backtrack(problem, &shape, energy, &direction, slope)
            else {
                // No descent along the direction: drop what was learnt and go on along the gradient; if that is what
                // failed, rounding ends the descent.
                if pairs.is_empty() {
                    break;
                }
                pairs.clear();
                continue;
            };
            let new_gradient = problem.gradient(&next);
            let step: Vec<_> =
                next.controls.iter().zip(&shape.controls).map(|(a, b)| *a - *b).collect();
            let change: Vec<_> = new_gradient.iter().zip(&gradient).map(|(a, b)| *a - *b).collect();
            // Only pairs with yᵀs > 0 keep the approximate Hessian positive definite; backtracking alone does not ensure it.
            let curvature = dot(&step, &change);
            if curvature > 0.0 {
                pairs.push_back(Pair { step, change, inverse: 1.0 / curvature });
                if pairs.len() > self.memory {
                    pairs.pop_front();
                }
            }
            (shape, energy, gradient) = (next, lowered, new_gradient);
        }
        let gradient_norm = norm(&gradient);
        // A relative gradient of 1e-6 (chosen) counts as zero where first derivatives alone get no farther.
        let least = problem.min_eigenvalue(&shape);
        let stability = if gradient_norm > stopping.tolerance.max(1e-6) {
            Stability::NotConverged
        } else if least > -problem.neutral_eigenvalue(gradient_norm) {
            Stability::Stable
        } else {
            Stability::Saddle
        };
        let clear = least > CLEAR_EIGENVALUE;
        Minimum { shape, gradient_norm, iterations, stability, clear, crossed: false }
    }
}

fn descent(problem: &Problem<'_>, gradient: &[DVec3], pairs: &VecDeque<Pair>) -> Vec<DVec3> {
    // Two-loop recursion for d = −H g: from the latest pair to the oldest, α_i = ρ_i s_iᵀ d and d ← d − α_i y_i …
    let mut d: Vec<DVec3> = gradient.iter().map(|g| -*g).collect();
    let mut alphas = Vec::with_capacity(pairs.len());
    for p in pairs.iter().rev() {
        let alpha = p.inverse * dot(&p.step, &d);
        add_scaled(&mut d, -alpha, &p.change);
        alphas.push(alpha);
    }
    // … the first Hessian, that of the elastic energy …
    for (i, x) in d.iter_mut().enumerate() {
        *x /= problem.chain.geometry(i).stiffness();
    }
    // … and back, d ← d + (α_i − ρ_i y_iᵀ d) s_i.
    for (p, alpha) in pairs.iter().zip(alphas.iter().rev()) {
        let beta = p.inverse * dot(&p.change, &d);
        add_scaled(&mut d, alpha - beta, &p.step);
    }
    d
}

fn backtrack(
    problem: &Problem<'_>,
    shape: &Shape,
    energy: f64,
    direction: &[DVec3],
    slope: f64,
) -> Option<(Shape, f64)> {
    if slope >= 0.0 {
        return None;
    }
    let largest = direction.iter().map(|d| d.length()).fold(0.0, f64::max);
    let mut fraction = (1.0_f64).min(LARGEST_TURN / largest);
    for _ in 0..HALVINGS {
        let mut controls = shape.controls.clone();
        add_scaled(&mut controls, fraction, direction);
        let next = problem.chain.shape(controls);
        let lowered = problem.energy(&next).total();
        if lowered < energy + ARMIJO * fraction * slope {
            return Some((next, lowered));
        }
        fraction *= 0.5;
    }
    None
}
