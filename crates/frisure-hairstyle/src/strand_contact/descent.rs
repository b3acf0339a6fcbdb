//! Conjugate gradients on the energy of all hairs, with each hair's own step as the preconditioner.
//!
//! Polak and Ribière's method, restarted where it does not descend ([Nocedal & Wright] §5.2), and a line search on the slope.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;
use rayon::prelude::*;

use super::energy::{Head, State};
use super::pairs::Pairs;

/// Share of the first slope at which a line search ends. [Nocedal & Wright] §5.2 has 0.1 to 0.5 for conjugate gradients.
const SLOPE: f64 = 0.3;

/// Armijo's constant.
const ARMIJO: f64 = 1e-4;

/// Most trials of a line search. Chosen; not measured further.
const TRIALS: usize = 12;

/// Largest turn of a joint in a step (rad). Chosen: half of that of a hair by itself.
const LARGEST_TURN: f64 = 0.5;

/// Rounding of the energy of all hairs, relative to it. Sums of 10^6 terms.
const ROUNDING: f64 = 1e-13;

/// Goes downhill.
pub(super) struct Descent<'a> {
    pub(super) head: &'a Head<'a>,
    pub(super) pairs: &'a Pairs,
    pub(super) stage: &'a StageCounter<'a>,
    /// It ends when this share of the hairs has moved by so many contact radii.
    pub(super) moved: (f64, f64),
}

impl Descent<'_> {
    /// At most so many iterations from an evaluated shape; `trial` is space for another. Returns how many there were.
    ///
    /// It ends before where no hair has a larger gradient than `tolerance`, or none can go on.
    pub(super) fn run(
        &self,
        state: &mut State,
        trial: &mut State,
        most: usize,
        tolerance: f64,
    ) -> Result<usize, Cancelled> {
        let Self { head, pairs, stage, .. } = *self;
        let start = state.points.clone();
        let joints = state.controls.len();
        let (mut step, mut direction) = (vec![DVec3::ZERO; joints], vec![DVec3::ZERO; joints]);
        let mut before: Option<(Vec<DVec3>, f64)> = None;
        for iteration in 0..most {
            stage.check()?;
            if head.gradients(state).iter().all(|&gradient| gradient <= tolerance) {
                return Ok(iteration);
            }
            head.step_while_held(pairs, state, &mut step);
            let slope = head.dot(&state.gradient, &step);
            // β = s·(g − g₋)/(s₋·g₋): with s = −M⁻¹g.
            let beta = match &before {
                Some((gradient, product)) => {
                    ((slope - head.dot(gradient, &step)) / product).max(0.0)
                }
                None => 0.0,
            };
            direction.par_iter_mut().zip(&step).for_each(|(d, s)| *d = *s + *d * beta);
            let mut downhill = head.dot(&state.gradient, &direction);
            if downhill >= 0.0 {
                direction.copy_from_slice(&step);
                downhill = slope;
            }
            if downhill >= 0.0 {
                return Ok(iteration);
            }
            before = Some((state.gradient.clone(), slope));
            if !self.search(state, trial, &direction, downhill) {
                if beta == 0.0 {
                    return Ok(iteration);
                }
                before = None;
            }
            if self.has_moved(&start, &state.points) {
                return Ok(iteration + 1);
            }
        }
        Ok(most)
    }

    /// Whether enough hairs have moved for contacts to be searched anew.
    fn has_moved(&self, from: &[DVec3], to: &[DVec3]) -> bool {
        let (share, radii) = self.moved;
        let Head { layout, system, .. } = self.head;
        let far = |strand: &usize| {
            let mut points = layout.points(*strand);
            let far = (radii * system.radii[*strand]).powi(2);
            points.any(|k| from[k].distance_squared(to[k]) > far)
        };
        let moved = (0..layout.strands()).into_par_iter().filter(far).count();
        moved as f64 > share * layout.strands() as f64
    }

    /// Goes along a direction (rad) to where the slope is small; `false` if the energy does not fall.
    fn search(
        &self,
        state: &mut State,
        trial: &mut State,
        direction: &[DVec3],
        slope: f64,
    ) -> bool {
        let largest = direction.par_iter().map(|d| d.length_squared()).reduce(|| 0.0, f64::max);
        let most = LARGEST_TURN / largest.sqrt().max(1e-300);
        let noise = ROUNDING * state.energy.abs();
        let mut low = (0.0, slope);
        let mut high: Option<(f64, f64)> = None;
        let mut at = most.min(1.0);
        let mut lower = false;
        for _ in 0..TRIALS {
            trial.controls.clear();
            let moved = state.controls.par_iter().zip(direction).map(|(c, d)| *c + *d * at);
            trial.controls.par_extend(moved);
            trial.clear.copy_from_slice(&state.clear);
            self.head.evaluate(self.pairs, trial);
            let there = self.head.dot(&trial.gradient, direction);
            let falls = trial.energy <= state.energy + ARMIJO * at * slope
                || (trial.energy <= state.energy + noise && there.abs() <= slope.abs());
            if falls && (there.abs() <= SLOPE * slope.abs() || at >= most) {
                lower = true;
                break;
            }
            if !falls || there > 0.0 {
                high = Some((at, there));
            } else {
                low = (at, there);
            }
            at = match high {
                // The zero of the slope between, away from both ends.
                Some(high) => {
                    let share = if high.1 > 0.0 { low.1 / (low.1 - high.1) } else { 0.5 };
                    low.0 + (high.0 - low.0) * share.clamp(0.1, 0.9)
                }
                None if low.1 > slope => {
                    (low.0 * slope / (slope - low.1)).clamp(1.5 * at, 4.0 * at)
                }
                None => 4.0 * at,
            }
            .min(most);
        }
        if lower || trial.energy < state.energy {
            std::mem::swap(state, trial);
            return true;
        }
        false
    }
}
