//! Newton's method with damping and a line search, in linear time: differential dynamic programming.
//!
//! One backward sweep (`riccati`) gives the quadratic model of the energy and a feedback law per element; one forward
//! rollout (`rollout`) applies it to the nonlinear chain. Where the Hessian is not positive definite, damping
//! (Levenberg–Marquardt) makes it so; a backtracking line search with Armijo's condition makes every accepted step lower
//! the energy. Jacobson & Mayne, *Differential Dynamic Programming* (1970); docs/theory.md, "Damping and line search",
//! "Saddles".

use glam::DVec3;

use super::block::lowest_eigenpair;
use super::linearise::Linearisation;
use super::minimiser::{CLEAR_EIGENVALUE, Minimiser, Minimum, Stability, StoppingCriteria};
use super::problem::{Problem, ROUNDED_GRADIENT};
use super::riccati::{FailedPivot, FeedbackLaw};
use super::rollout::{rollout, rollout_steps};
use crate::chain::Shape;

/// Newton's method: differential dynamic programming with Levenberg–Marquardt damping and a line search.
#[derive(Clone, Copy, Debug)]
pub struct Newton {
    /// Damping after a first failed pivot, as a fraction of the elastic stiffness. Chosen by trial: starting high saves
    /// sweeps.
    pub first_damping: f64,
    /// Whether to leave a saddle point along negative curvature; without it the saddle point is the answer.
    pub escape_saddles: bool,
    /// Farthest (m) that a node moves in an iteration; infinite by default. Where a rod falls from one minimum to another, short
    /// steps follow the way downhill, so that the end is decided by the energy and not by the length of a step.
    pub longest_step: f64,
}

impl Default for Newton {
    fn default() -> Self {
        Self { first_damping: 0.3, escape_saddles: true, longest_step: f64::INFINITY }
    }
}

/// A relative gradient below which damping grows from rounding by this factor. Chosen: seven trials reach `first_damping`.
const NEAR_REST: f64 = 1e-4;
const GROWTH_NEAR_REST: f64 = 16.0;

/// Steps whose decrease is below rounding and that do not halve the gradient, after which the descent ends.
const MOST_STALLED: usize = 3;

/// Most saddle points left in one descent. Chosen by trial; not measured further.
const MOST_ESCAPES: usize = 40;

/// Damping, as a fraction of the elastic stiffness, above which a step is shorter than rounding.
const LARGEST_DAMPING: f64 = 1e12;

/// Factor by which damping grows after a failed pivot or line search, and by which it shrinks after a full step;
/// below `LEAST_DAMPING` it is switched off. Chosen by trial.
const DAMPING_GROWTH: f64 = 4.0;
const DAMPING_SHRINKAGE: f64 = 0.2;
const LEAST_DAMPING: f64 = 0.05;

/// Least damping after a step that was halved twice or more. Chosen: the next step starts a little shorter than Newton's.
const DAMPING_AFTER_SHORT_STEP: f64 = 0.01;

/// Most trials of a step, each half as long as the one before, without damping and with it. Chosen: damping shortens a
/// step better than halving does (it keeps the soft directions), so a damped step is halved only once.
const UNDAMPED_TRIALS: usize = 4;
const DAMPED_TRIALS: usize = 2;

/// Armijo's constant: the part of the expected decrease that a step has to reach. [Nocedal & Wright] §3.1.
const ARMIJO: f64 = 1e-4;

/// Relative rounding error of an energy: that of f64, 1.1e-16, times about a hundred for the sum over elements.
const ENERGY_ROUNDING: f64 = 1e-14;

/// Largest decrease, over the rounding error of an energy, of a step that the gradient may decide. Chosen: Armijo's condition asks
/// for 1e-4 of the decrease, which is below rounding for these.
const MOST_HIDDEN: f64 = 1e4;

/// Lengths that are tried of a step that the gradient decides, each half of the one before; and the part of the gradient that it
/// may leave. Chosen: a kink anywhere in the step is met to a few per cent.
const GRADIENT_TRIALS: i32 = 6;
const CLEARLY_SMALLER: f64 = 0.95;

impl Minimiser for Newton {
    fn minimise(&self, problem: &Problem<'_>, start: Shape, stopping: StoppingCriteria) -> Minimum {
        if problem.with_position {
            self.descend::<true>(problem, start, stopping)
        } else {
            self.descend::<false>(problem, start, stopping)
        }
    }
}

/// Newton's step at a shape: where the quadratic model of the energy has its minimum.
#[derive(Clone, Debug)]
pub struct NewtonStep {
    /// Derivative of the energy by each element's control (N m).
    pub gradient: Vec<DVec3>,
    /// Change of each element's control (rad).
    pub step: Vec<DVec3>,
    /// Whether the second variation is positive, or zero but for rounding, so that the step is
    /// Newton's own. Otherwise it is damped until it goes downhill.
    pub positive_definite: bool,
}

impl Newton {
    /// One step of Newton's method, for callers that minimise the energy of several rods together.
    #[must_use]
    pub fn newton_step(&self, problem: &Problem<'_>, shape: &Shape) -> NewtonStep {
        if problem.with_position {
            self.newton_step_of::<true>(problem, shape)
        } else {
            self.newton_step_of::<false>(problem, shape)
        }
    }

    fn newton_step_of<const POSITION: bool>(
        &self,
        problem: &Problem<'_>,
        shape: &Shape,
    ) -> NewtonStep {
        let at = Linearisation::<POSITION>::new(problem, shape);
        let mut damping = 0.0;
        let laws = loop {
            match at.sweep(damping) {
                Ok(sweep) => break sweep.laws,
                // A shape with numbers so large that nothing is positive has no step.
                Err(_) if damping > LARGEST_DAMPING => {
                    break vec![FeedbackLaw::NONE; at.stages.len()];
                }
                Err(_) => damping = self.stronger(damping),
            }
        };
        let step = rollout_steps::<POSITION>(problem, shape, &laws);
        let positive_definite = damping == 0.0 || at.negative_pivot(f64::INFINITY).is_none();
        NewtonStep { gradient: at.gradient, step, positive_definite }
    }

    /// The shape after one step downhill: what [`Minimiser::minimise`] finds in one iteration, without the gradient and the stability there.
    /// `None` where the gradient is zero, or no step lowers the energy.
    #[must_use]
    pub fn step_downhill(&self, problem: &Problem<'_>, shape: &Shape) -> Option<Shape> {
        if problem.with_position {
            self.step_downhill_of::<true>(problem, shape)
        } else {
            self.step_downhill_of::<false>(problem, shape)
        }
    }

    fn step_downhill_of<const POSITION: bool>(
        &self,
        problem: &Problem<'_>,
        shape: &Shape,
    ) -> Option<Shape> {
        let at = Linearisation::<POSITION>::new(problem, shape);
        if at.largest_gradient() == 0.0 {
            return None;
        }
        let mut damping = 0.0;
        let step = self.step(&at, shape, problem.energy(shape).total(), &mut damping);
        step.map(|step| step.shape)
    }

    /// Whether a node moves farther than it may from one shape to the next.
    fn goes_too_far(&self, shape: &Shape, next: &Shape) -> bool {
        let far = |(p, q): (&DVec3, &DVec3)| p.distance(*q) > self.longest_step;
        self.longest_step.is_finite() && shape.positions.iter().zip(&next.positions).any(far)
    }

    /// Damping after one that was too weak.
    fn stronger(&self, damping: f64) -> f64 {
        self.first_damping.max(DAMPING_GROWTH * damping)
    }

    fn descend<const POSITION: bool>(
        &self,
        problem: &Problem<'_>,
        start: Shape,
        stopping: StoppingCriteria,
    ) -> Minimum {
        // Energies and gradients are compared with EI/L + ρSgL²: the result does not depend on units or on the size of the rod.
        let scale = problem.chain.rod().moment_scale();
        let mut damping = 0.0;
        let mut shape = start;
        let mut energy = problem.energy(&shape).total();
        let mut iterations = 0;
        let mut escapes = 0;
        let mut stalled = 0;
        let mut last_gradient = f64::INFINITY;
        let mut crossed = false;
        loop {
            let at = Linearisation::<POSITION>::new(problem, &shape);
            let gradient_norm = at.largest_gradient() / scale;
            let end = |shape, iterations, stability, crossed| Minimum {
                shape,
                gradient_norm,
                iterations,
                stability,
                clear: false,
                crossed,
            };
            let mut at_rest = gradient_norm <= stopping.tolerance;
            // 1. Not stationary: one Newton step.
            if !at_rest {
                if iterations >= stopping.max_iterations {
                    return end(shape, iterations, Stability::NotConverged, crossed);
                }
                iterations += 1;
                let step = self.step(&at, &shape, energy, &mut damping);
                crossed |= iterations == 1 && step.as_ref().is_none_or(|s| s.indefinite);
                // A step whose decrease drowns in rounding is checked by the gradient: quadratic convergence at least halves it.
                let rounded = step.as_ref().is_none_or(|s| s.below_rounding);
                stalled =
                    if rounded && gradient_norm > 0.5 * last_gradient { stalled + 1 } else { 0 };
                last_gradient = gradient_norm;
                match step {
                    Some(step) if stalled < MOST_STALLED => {
                        (shape, energy) = (step.shape, step.energy);
                    }
                    // The gradient is as small as rounding allows.
                    _ if gradient_norm <= ROUNDED_GRADIENT => at_rest = true,
                    Some(step) => (shape, energy) = (step.shape, step.energy),
                    None => return end(shape, iterations, Stability::NotConverged, crossed),
                }
            }
            // 2. Stationary: a minimum, or a saddle point to leave.
            if at_rest {
                // A vanishing gradient alone is not a minimum: the pivots decide. docs/theory.md, "Saddles", "Certificates"
                // Most rods are far from a loss of stability: then one sweep shows both.
                if at.sweep(-CLEAR_EIGENVALUE).is_ok() {
                    let minimum = end(shape, iterations, Stability::Stable, crossed);
                    return Minimum { clear: true, ..minimum };
                }
                // On the way to a finer division the gradient is far from rounding.
                let last = stopping.tolerance <= ROUNDED_GRADIENT;
                let rounded = if last { gradient_norm } else { f64::INFINITY };
                let Some(failed) = at.negative_pivot(rounded) else {
                    return end(shape, iterations, Stability::Stable, crossed);
                };
                crossed = true;
                escapes += 1;
                let escaped = (self.escape_saddles && escapes <= MOST_ESCAPES)
                    .then(|| escape_saddle(problem, &shape, energy, &failed));
                match escaped.flatten() {
                    Some(escaped) => (shape, energy) = escaped,
                    None => return end(shape, iterations, Stability::Saddle, crossed),
                }
                iterations += 1;
                (stalled, last_gradient) = (0, f64::INFINITY);
            }
        }
    }

    /// One sweep and rollout that lowers the energy (J), at whatever damping that takes.
    fn step<const POSITION: bool>(
        &self,
        at: &Linearisation<'_, POSITION>,
        shape: &Shape,
        energy: f64,
        damping: &mut f64,
    ) -> Option<Step> {
        let near_rest = at.largest_gradient() <= NEAR_REST * at.problem.chain.rod().moment_scale();
        let stronger = |damping: f64| match damping {
            // The least that makes the pivots positive: more of it slows down every soft direction, and beside a saddle
            // that is nearly flat a step would be its negative eigenvalue over the damping.
            d if near_rest && d < self.first_damping => {
                let neutral = at.problem.neutral_eigenvalue(f64::INFINITY);
                neutral.max(GROWTH_NEAR_REST * d).min(self.first_damping)
            }
            d => self.stronger(d),
        };
        let mut indefinite = false;
        while *damping < LARGEST_DAMPING {
            // 1. Damping: until every pivot is positive definite.
            let Ok(sweep) = at.sweep(*damping) else {
                indefinite = true;
                *damping = stronger(*damping);
                continue;
            };
            // Near the minimum the decrease is below rounding; there the gradient decides.
            let noise = ENERGY_ROUNDING * energy.abs();
            // With damping besides, no step of any length shows a decrease: the caller ends or escapes.
            if sweep.decrease < noise && *damping > 1.0 {
                return step_by_gradient(at, shape, energy);
            }
            // 2. Line search: backtracking by halves until Armijo's condition holds.
            let trials = if *damping == 0.0 { UNDAMPED_TRIALS } else { DAMPED_TRIALS };
            let mut fraction = 1.0;
            for trial in 0..trials {
                let (next, lowered) = rollout::<POSITION>(at.problem, shape, &sweep.laws, fraction);
                if self.goes_too_far(shape, &next) {
                    fraction *= 0.5;
                    continue;
                }
                // The model's decrease along the step, a parabola with its vertex at α = 1: Δ(α) = α (2 − α) Δ(1).
                let expected = sweep.decrease * fraction * (2.0 - fraction);
                if lowered <= energy - ARMIJO * expected
                    || (expected < noise && lowered <= energy + noise)
                {
                    // 3. The shorter the accepted step, the more damping for the next.
                    *damping = match trial {
                        0 if *damping < LEAST_DAMPING => 0.0,
                        0 => *damping * DAMPING_SHRINKAGE,
                        1 => *damping,
                        _ => (2.0 * *damping).max(DAMPING_AFTER_SHORT_STEP),
                    };
                    let below_rounding = expected < noise;
                    return Some(Step { shape: next, energy: lowered, below_rounding, indefinite });
                }
                fraction *= 0.5;
            }
            *damping = stronger(*damping);
        }
        step_by_gradient(at, shape, energy)
    }
}

/// A step whose decrease is too near rounding for energies to show it: of several lengths of the undamped step the one that
/// leaves the smallest gradient, if that is clearly smaller than here.
///
/// Where contact begins or ends within a step, the curvature jumps: the model's decrease is not reached, and halving and damping
/// shorten the step until its decrease is below rounding, although the gradient is not. A Newton step that is measured by the
/// gradient goes on there (semismooth Newton; [Nocedal & Wright] §11.2 on the norm of the gradient as a merit function).
fn step_by_gradient<const POSITION: bool>(
    at: &Linearisation<'_, POSITION>,
    shape: &Shape,
    energy: f64,
) -> Option<Step> {
    let noise = ENERGY_ROUNDING * energy.abs();
    let sweep = at.sweep(0.0).ok()?;
    if sweep.decrease > MOST_HIDDEN * noise {
        return None;
    }
    let step = |fraction: f64| {
        let (next, lowered) = rollout::<POSITION>(at.problem, shape, &sweep.laws, fraction);
        let gradient = Linearisation::<POSITION>::new(at.problem, &next).largest_gradient();
        (gradient, Step { shape: next, energy: lowered, below_rounding: true, indefinite: false })
    };
    let (gradient, step) = (0..GRADIENT_TRIALS)
        .map(|halvings| step(0.5_f64.powi(halvings)))
        .filter(|(_, step)| step.energy <= energy + MOST_HIDDEN * noise)
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    (gradient < CLEARLY_SMALLER * at.largest_gradient()).then_some(step)
}

/// An accepted step.
struct Step {
    shape: Shape,
    energy: f64,
    /// Whether the expected decrease of the energy is below its rounding error.
    below_rounding: bool,
    /// Whether the second variation is not positive where the step begins, with the damping tried first.
    indefinite: bool,
}

/// First turn (rad) along negative curvature, and how often it is halved. Chosen by trial.
const ESCAPE_TURN: f64 = 0.8;
const ESCAPE_HALVINGS: usize = 40;

/// A shape below a saddle point and its energy (J), along the failed pivot's direction of negative curvature with all
/// later elements following their laws. The energy is exactly quadratic that way to second order.
fn escape_saddle(
    problem: &Problem<'_>,
    shape: &Shape,
    energy: f64,
    failed: &FailedPivot,
) -> Option<(Shape, f64)> {
    // Later elements follow G_η η + G_ξ ξ without their own k; those before the failed pivot stay as they are. The energy
    // changes by ½ t² times the pivot's negative eigenvalue then, to second order in the turn t.
    let (_, direction) = lowest_eigenpair(&failed.pivot);
    let mut laws = failed.laws.clone();
    for law in &mut laws {
        law.step = DVec3::ZERO;
    }
    let mut turn = ESCAPE_TURN;
    for _ in 0..ESCAPE_HALVINGS {
        // Mirror images have the same energy; a fixed order of signs makes the answer unique.
        for sign in [1.0, -1.0] {
            laws[failed.element].step = direction * (sign * turn);
            let (next, lowered) = if problem.with_position {
                rollout::<true>(problem, shape, &laws, 1.0)
            } else {
                rollout::<false>(problem, shape, &laws, 1.0)
            };
            // Lower beyond the last bit of the energy.
            if lowered < energy - 1e-15 * energy.abs() {
                return Some((next, lowered));
            }
        }
        turn *= 0.5;
    }
    None
}
