//! Guides that have far to go come near to rest by themselves, while all others hold still, before Newton's method for all goes on.
//!
//! One hair that slides off a shoulder makes every step of the head as short as its own. Such strong, local nonlinearities are
//! eliminated first: nonlinear elimination, Lanzkron, Rose & Wilkes 1996. It lowers the energy of the head as every step does, and
//! what is found in the end is where the gradient of the head vanishes.

use frisure_rod::minimise::SecondVariation;
use glam::DVec3;

use super::hessian::{
    Controls, DAMPING_GROWTH, FIRST_DAMPING, JointHessian, LARGEST_DAMPING, Preconditioner,
};
use super::line_search::{FARTHEST, FARTHEST_TURNED, TRIALS, accepts};
use super::state::{GuideArrival, HeadState};
use crate::parallel;

/// Relative gradient above which a guide is far from rest, and above which it is if a step by itself would be longer than
/// [`FARTHEST`]. Chosen: a head converges in some five steps from there.
const FAR_FROM_REST: f64 = 1e-2;
const NEAR_REST: f64 = 3e-3;

/// Guides are few if at most one in this many is far from rest: if more are, all move together. Chosen by trial.
const FEW: usize = 3;

/// How far (m) a guide may go before neighbours are searched again. Chosen: with 20 mm lists of 2000 guides are ten times as long.
const ROOM: f64 = 2e-3;

/// Most searches of neighbours, and most steps of a guide between two. Guards: what is left is left to the next elimination.
const MOST_SEARCHES: usize = 12;
const MOST_STEPS: usize = 60;

/// First stiffness of the tether that keeps a step short, in those at which its weight moves a guide by 4 mm, and the factor to the next. Chosen:
/// then a step is between half as long as it may be and that long.
const FIRST_TETHER: f64 = 1e-2;
const TIGHTENING: f64 = 2.0;
const MOST_TETHERS: usize = 40;

/// The guides that are far from rest, if they are few.
pub(super) fn far_from_rest(
    state: &HeadState<'_>,
    hessian: &JointHessian,
    preconditioner: &Preconditioner<'_>,
    gradient: &Controls,
) -> Vec<usize> {
    // Newton's step of each guide while the others hold still, but for its sign: M⁻¹ g.
    let steps = preconditioner.solve(gradient);
    let is_far = parallel::map(steps.len(), |i| {
        let relative = state.relative_of(i, &gradient[i]);
        let goes_far = || {
            let moved = hessian.guides[i].displacements(&steps[i]);
            moved.iter().any(|moved| moved.length() > FARTHEST)
        };
        relative > FAR_FROM_REST || (relative > NEAR_REST && goes_far())
    });
    let far: Vec<usize> = (0..is_far.len()).filter(|&i| is_far[i]).collect();
    if far.len() * FEW <= is_far.len() { far } else { Vec::new() }
}

/// Lets guides come near to rest by themselves: one step after the other, guides that cannot come near each other at the same time.
pub(super) fn eliminate(state: &mut HeadState<'_>, guides: &[usize], count: usize) {
    let mut lengths = vec![0.0; count];
    for &guide in guides {
        lengths[guide] = ROOM;
    }
    let mut left = guides.to_vec();
    for _ in 0..MOST_SEARCHES {
        // 1. Neighbours within the room of those that are left: until it is used up, who may feel whom is known.
        state.make_room(&lengths);
        let groups = state.groups_apart(&left);
        let mut active = vec![false; count];
        left.iter().for_each(|&guide| active[guide] = true);
        let mut moved = vec![false; count];
        // 2. Steps of each (block Gauss–Seidel) until all are near rest or have no room left.
        for _ in 0..MOST_STEPS {
            for group in &groups {
                let group: Vec<usize> = group.iter().copied().filter(|&i| active[i]).collect();
                // None of a group changes what another feels: at the same time is as good as one after the other.
                let moves = parallel::map_slice(&group, |&guide| Move::of(state, guide));
                for (guide, found) in group.into_iter().zip(moves) {
                    active[guide] = found.is_some();
                    moved[guide] |= active[guide];
                    if let Some(found) = found {
                        state.arrive(guide, found.to);
                        state.moved_alone(guide, found.length);
                    }
                }
            }
            if !active.contains(&true) {
                break;
            }
        }
        // 3. What has not moved is near rest or stays: a new search would not help it.
        left.retain(|&guide| moved[guide]);
        if left.is_empty() {
            break;
        }
    }
    state.measure();
}

/// A step of Newton's method of one guide.
struct Step {
    /// Change of its controls (rad).
    way: Vec<DVec3>,
    /// How far (m) it moves a node.
    length: f64,
    /// Derivative of the energy along it (J).
    slope: f64,
}

impl Step {
    /// The step of a guide; `None` near rest, and where it has no room.
    fn of(state: &HeadState<'_>, guide: usize) -> Option<Self> {
        let mut variation = state.variation_of(guide);
        let room = state.room_of(guide);
        if state.relative_of(guide, variation.gradient()) <= NEAR_REST || room <= 0.0 {
            return None;
        }
        let mut way = short_step(&mut variation, state.node_firmness(guide))?;
        let mut length = state.length_of(guide, &way);
        let most = FARTHEST_TURNED.min(room);
        if length > most {
            way.iter_mut().for_each(|x| *x *= most / length);
            length = most;
        }
        let slope = variation.gradient().iter().zip(&way).map(|(g, x)| g.dot(*x)).sum();
        Some(Self { way, length, slope })
    }
}

/// A move of one guide that lowers the energy.
struct Move {
    to: GuideArrival,
    /// How far (m) it moves a node.
    length: f64,
}

impl Move {
    /// A step of Newton's method, halved until the energy is lower by Armijo's condition; `None` near rest, and where none is.
    fn of(state: &HeadState<'_>, guide: usize) -> Option<Self> {
        let step = Step::of(state, guide)?;
        let energy = state.energy_of(guide);
        let from = state.departure(guide);
        let mut fraction = 1.0;
        for _ in 0..TRIALS {
            let to = state.arrival(guide, from.as_ref(), &step.way, fraction);
            if accepts(energy, to.energy, -step.slope * fraction) {
                return Some(Self { to, length: fraction * step.length });
            }
            fraction *= 0.5;
        }
        None
    }
}

/// Newton's step (rad), damped where the energy curves downwards and held by tethers so that no point moves farther than [`FARTHEST`],
/// to first order.
fn short_step(variation: &mut SecondVariation, firmness: f64) -> Option<Vec<DVec3>> {
    let right: Vec<DVec3> = variation.gradient().iter().map(|g| -*g).collect();
    let (mut tether, mut damping) = (FIRST_TETHER * firmness, 0.0);
    for _ in 0..MOST_TETHERS {
        // 1. H + c Jᵀ J + σ K/h has to be positive definite: with the tether c, then with the damping σ.
        let Some(factor) = variation.factor(damping) else {
            damping = FIRST_DAMPING.max(damping * DAMPING_GROWTH);
            if damping > LARGEST_DAMPING {
                return None;
            }
            continue;
        };
        // 2. A firmer tether until the step is short enough: a trust region by the points' distances, as Levenberg and Marquardt's.
        let step = factor.solve(&right);
        if variation.displacements(&step).iter().all(|moved| moved.length() <= FARTHEST) {
            return Some(step);
        }
        variation.tether(tether);
        tether *= TIGHTENING;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::super::friction_solver::Hold;
    use super::*;
    use crate::head::Head;
    use crate::{PredictOptions, preset};

    #[test]
    fn guides_far_from_rest_are_found_and_come_near_to_it() {
        let head = Head::mannequin();
        let mut spec = preset("caucasian-curly").unwrap().spec();
        spec.wisps.count = 40;
        spec.equilibrium.resolution = frisure_rod::Resolution::Elements(12);
        let style = crate::predict(&spec, &head, PredictOptions::default(), &()).unwrap();
        let (guides, rest) = (&style.guides, &style.rest.guides);
        let mut state = HeadState::new(&spec, &head, guides, rest, Hold::Free);
        let least = state.energy();
        // Three guides are bent at their roots, by some centimetres at the tip.
        let bent = [3, 17, 30];
        for guide in bent {
            let mut way = vec![DVec3::ZERO; 12];
            way[0] = DVec3::new(0.2, -0.1, 0.1);
            let from = state.departure(guide);
            let to = state.arrival(guide, from.as_ref(), &way, 1.0);
            state.arrive(guide, to);
        }
        state.make_room(&[1.0; 40]);
        state.measure();
        let far = |state: &HeadState<'_>| {
            let hessian = state.hessian();
            let preconditioner = Preconditioner::new(&hessian).unwrap();
            let gradient = hessian.gradient();
            let relative: Vec<f64> =
                bent.iter().map(|&guide| state.relative_of(guide, &gradient[guide])).collect();
            (far_from_rest(state, &hessian, &preconditioner, &gradient), relative)
        };
        let (found, _) = far(&state);
        assert!(bent.iter().all(|guide| found.contains(guide)), "{found:?}");
        let before = state.energy();
        eliminate(&mut state, &found, 40);
        let (left, relative) = far(&state);
        assert!(left.is_empty() && relative.iter().all(|&r| r <= FAR_FROM_REST), "{relative:?}");
        let after = state.energy();
        assert!(
            after < before && after - least < 1e-2 * (before - least),
            "{least} {before} {after}"
        );
    }
}
