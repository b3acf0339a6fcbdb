//! Newton's method for all guides together: conjugate gradients solve for a step, a line search accepts it.
//!
//! Truncated Newton, \[Nocedal & Wright\] §7.1: conjugate gradients end where the step is accurate enough, or where the energy
//! curves downwards along a direction.

use frisure_progress::{Cancelled, StageCounter};

use super::hessian::{
    Controls, Coupling, Curvature, JointHessian, Preconditioner, add, add_scaled, dot, negative,
    zero,
};
use super::state::HeadState;

/// Most iterations of conjugate gradients in a step: a guard.
const MOST_CG: usize = 200;

/// Residual at which a step is accurate enough, as a fraction of the gradient, both in the norm of the preconditioner. Chosen
/// by trial: with 1e-2 a third more steps are not positive definite.
const FORCING: f64 = 1e-3;

/// Armijo's constant, \[Nocedal & Wright\] §3.1.
const ARMIJO: f64 = 1e-4;

/// Most trials of a step, each half as long as the one before. A guard.
const TRIALS: usize = 12;

/// Farthest (m) that a point of any guide moves in a step: less than the radius of most wisps, so that none jumps over
/// another. Chosen; with 8 mm and 15 mm no fewer steps are needed.
const FARTHEST: f64 = 4e-3;

/// Relative gradient above which hair of a density is far from rest. Chosen by trial.
const FAR: f64 = 0.05;

/// Relative rounding error of the energy of the head: that of f64 times about a thousand for the sum over guides.
const ENERGY_ROUNDING: f64 = 1e-13;

/// How a descent ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Descent {
    /// Steps taken.
    pub(super) steps: usize,
    /// Whether the gradient is below the tolerance.
    pub(super) at_rest: bool,
}

/// Lowers the energy of the head until the relative gradient of every guide is at most `tolerance`, in at most `most` steps.
///
/// # Errors
/// [`Cancelled`], if the work is cancelled.
pub(super) fn minimise(
    state: &mut HeadState<'_>,
    tolerance: f64,
    most: usize,
    stage: &StageCounter<'_>,
) -> Result<Descent, Cancelled> {
    let mut energy = state.energy();
    let mut steps = 0;
    loop {
        stage.check()?;
        let hessian = state.hessian();
        let gradient = hessian.gradient();
        let relative = state.relative(&gradient);
        let (at_rest, far) = (relative <= tolerance, relative > FAR);
        if at_rest || steps >= most {
            return Ok(Descent { steps, at_rest });
        }
        let Some(preconditioner) = Preconditioner::new(&hessian) else {
            return Ok(Descent { steps, at_rest: false });
        };
        let step = best_step(&hessian, &preconditioner, &gradient, far);
        match search(state, &gradient, step, energy) {
            Some(lowered) => energy = lowered,
            None => return Ok(Descent { steps, at_rest: false }),
        }
        steps += 1;
    }
}

/// The step of truncated Newton (rad), for hair of a density from convex second derivatives while it is `far` from rest or where
/// the energy curves downwards: they are those of Gauss and Newton, and no step is cut short.
fn best_step(
    hessian: &JointHessian,
    preconditioner: &Preconditioner<'_>,
    gradient: &Controls,
    far: bool,
) -> Controls {
    let step = |curvature| step(hessian, preconditioner, gradient, curvature);
    let density = matches!(hessian.coupling, Coupling::Density(_));
    if density && far {
        return step(Curvature::Convex).way;
    }
    match step(Curvature::Full) {
        Solution { downwards: true, .. } if density => step(Curvature::Convex).way,
        solution => solution.way,
    }
}

/// What conjugate gradients found.
struct Solution {
    /// A direction of descent (rad).
    way: Controls,
    /// Whether they met a direction along which the energy curves downwards, and stopped.
    downwards: bool,
}

/// Conjugate gradients for H x = −g.
fn step(
    hessian: &JointHessian,
    preconditioner: &Preconditioner<'_>,
    gradient: &Controls,
    curvature: Curvature,
) -> Solution {
    let mut residual = negative(gradient);
    let mut z = preconditioner.solve(&residual);
    let mut way = z.clone();
    let mut step = zero(gradient);
    let first = dot(&residual, &z);
    let mut norm = first;
    for k in 0..MOST_CG {
        let product = hessian.apply_with(&way, curvature);
        let bend = dot(&way, &product);
        if bend <= 0.0 {
            // The energy curves downwards this way: what is solved so far is a direction of descent, and so is the first way.
            return Solution { way: if k == 0 { way } else { step }, downwards: true };
        }
        let length = norm / bend;
        add(&mut step, length, &way);
        add(&mut residual, -length, &product);
        z = preconditioner.solve(&residual);
        let next = dot(&residual, &z);
        if next <= FORCING * FORCING * first {
            break;
        }
        add_scaled(&mut way, next / norm, &z);
        norm = next;
    }
    Solution { way: step, downwards: false }
}

/// Goes along a step, halved until the energy is lower; gives the energy (J) there. The guides stay if no trial is lower.
fn search(
    state: &mut HeadState<'_>,
    gradient: &Controls,
    mut step: Controls,
    energy: f64,
) -> Option<f64> {
    // 1. The whole step as much shorter as its farthest point asks for: it stays a direction of descent.
    let mut lengths = state.lengths(&step);
    let farthest = lengths.iter().copied().fold(0.0, f64::max);
    if farthest > FARTHEST {
        let factor = FARTHEST / farthest;
        step.iter_mut().flatten().for_each(|x| *x *= factor);
        lengths.iter_mut().for_each(|length| *length *= factor);
    }
    let slope = dot(gradient, &step);
    state.make_room(&lengths);
    // 2. Halved until Armijo's condition holds; where the decrease drowns in rounding the gradient decides.
    let from = state.shapes();
    let noise = ENERGY_ROUNDING * energy.abs();
    let mut fraction = 1.0;
    for _ in 0..TRIALS {
        state.go(&from, &step, fraction);
        let lowered = state.energy();
        let decrease = -slope * fraction;
        if lowered <= energy - ARMIJO * decrease || (decrease < noise && lowered <= energy + noise)
        {
            state.moved(&lengths, fraction);
            return Some(lowered);
        }
        fraction *= 0.5;
    }
    state.go(&from, &step, 0.0);
    None
}
