//! Newton's method for all guides together: conjugate gradients solve for a step, a line search accepts it.
//!
//! Truncated Newton, \[Nocedal & Wright\] §7.1: conjugate gradients end where the step is accurate enough, or as long as it may be.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;

use super::elimination::{eliminate, far_from_rest};
use super::hessian::{
    Controls, JointHessian, Preconditioner, add, add_scaled, dot, negative, zero,
};
use super::line_search::{FARTHEST, FARTHEST_TURNED, TRIALS, accepts};
use super::state::HeadState;
use crate::parallel;

/// Most iterations of conjugate gradients in a step: a guard.
const MOST_CG: usize = 200;

/// Residual at which a step is accurate enough, as a fraction of the gradient, both in the norm of the preconditioner. Chosen
/// by trial: with 1e-2 a third more steps are not positive definite.
const FORCING: f64 = 1e-3;

/// Most eliminations between two steps of all, and steps that have to be left for one: a slider that is dragged takes two. A guard: one is
/// usual.
const MOST_ROUNDS: usize = 3;

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
    // Eliminations since the last step of all.
    let mut rounds = 0;
    loop {
        stage.check()?;
        let hessian = state.hessian();
        let gradient = hessian.gradient();
        let relative = state.relative(&gradient);
        let at_rest = relative <= tolerance;
        if at_rest || steps >= most {
            return Ok(Descent { steps, at_rest });
        }
        let Some(preconditioner) = Preconditioner::new(&hessian) else {
            return Ok(Descent { steps, at_rest: false });
        };
        // Of wisps in pairs which one lies on which is decided by the way there: all go it together.
        if state.is_density() && rounds < MOST_ROUNDS && steps + MOST_ROUNDS < most {
            let far = far_from_rest(state, &hessian, &preconditioner, &gradient);
            if !far.is_empty() {
                // Two of them at a time would be most of the memory.
                drop(preconditioner);
                drop(hessian);
                eliminate(state, &far, gradient.len());
                energy = state.energy();
                rounds += 1;
                continue;
            }
        }
        let step = best_step(&hessian, &preconditioner, &gradient);
        match search(state, &gradient, step, energy) {
            Some(lowered) => energy = lowered,
            None => return Ok(Descent { steps, at_rest: false }),
        }
        steps += 1;
        rounds = 0;
    }
}

/// The step of truncated Newton (rad): conjugate gradients for H x = −g in a trust region, \[Nocedal & Wright\] algorithm 7.2
/// (Steihaug 1983).
///
/// They first find what is stiff, then what is soft. They end where the farthest point has moved by [`FARTHEST`], and at once where
/// the energy curves downwards along a direction, which they follow as far. Cut short as a whole instead, a step that moves one soft
/// hair by decimetres leaves nearly all of the stiff forces.
fn best_step(
    hessian: &JointHessian,
    preconditioner: &Preconditioner<'_>,
    gradient: &Controls,
) -> Controls {
    let mut residual = negative(gradient);
    let mut z = preconditioner.solve(&residual);
    let mut way = z.clone();
    let mut step = zero(gradient);
    let mut gone: Vec<Vec<DVec3>> = Vec::new();
    let first = dot(&residual, &z);
    let mut norm = first;
    for _ in 0..MOST_CG {
        let product = hessian.apply(&way);
        if gone.is_empty() {
            gone = product.moved.iter().map(|points| vec![DVec3::ZERO; points.len()]).collect();
        }
        let room = room(&gone, &product.moved);
        let bend = dot(&way, &product.moments);
        let length = if bend > 0.0 { norm / bend } else { f64::INFINITY };
        if length >= room {
            add(&mut step, room, &way);
            return step;
        }
        add(&mut step, length, &way);
        add(&mut gone, length, &product.moved);
        add(&mut residual, -length, &product.moments);
        z = preconditioner.solve(&residual);
        let next = dot(&residual, &z);
        if next <= FORCING * FORCING * first {
            break;
        }
        add_scaled(&mut way, next / norm, &z);
        norm = next;
    }
    step
}

/// Largest t for which no point that has `gone` some way (m) is farther than [`FARTHEST`] after t times `moved` (m) more.
fn room(gone: &[Vec<DVec3>], moved: &[Vec<DVec3>]) -> f64 {
    let of = |(u, v): (&DVec3, &DVec3)| {
        // |u + t v|² = FARTHEST², the root ahead: in the form without cancellation.
        let (a, b) = (v.length_squared(), u.dot(*v));
        let c = (FARTHEST * FARTHEST - u.length_squared()).max(0.0);
        if a > 0.0 { c / (b + (b * b + a * c).sqrt()) } else { f64::INFINITY }
    };
    // 0/0 where a point is at its limit and moves straight out: no room.
    let defined = |t: f64| if t.is_nan() { 0.0 } else { t };
    let of_guide =
        |i: usize| gone[i].iter().zip(&moved[i]).map(of).map(defined).fold(f64::INFINITY, f64::min);
    parallel::map(gone.len(), of_guide).into_iter().fold(f64::INFINITY, f64::min)
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
    if farthest > FARTHEST_TURNED {
        let factor = FARTHEST_TURNED / farthest;
        step.iter_mut().flatten().for_each(|x| *x *= factor);
        lengths.iter_mut().for_each(|length| *length *= factor);
    }
    let slope = dot(gradient, &step);
    state.make_room(&lengths);
    // 2. Halved until it is good enough.
    let from = state.shapes();
    let mut fraction = 1.0;
    for _ in 0..TRIALS {
        state.go(&from, &step, fraction);
        let lowered = state.energy();
        if accepts(energy, lowered, -slope * fraction) {
            state.moved(&lengths, fraction);
            return Some(lowered);
        }
        fraction *= 0.5;
    }
    state.go(&from, &step, 0.0);
    None
}
