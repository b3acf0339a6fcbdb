//! Newton's method on the energy of all hairs: a step, and how far it goes.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;
use rayon::prelude::*;

use super::energy::{Head, State};
use super::interaction::Interaction;
use super::linear::{LinearModel, LinearRule};

/// Armijo's constant.
const ARMIJO: f64 = 1e-4;

/// Most trials of a line search. Chosen; not measured further.
const TRIALS: usize = 8;

/// Largest turn of a joint in a step (rad). Chosen: half of that of a hair by itself.
const LARGEST_TURN: f64 = 0.5;

/// Rounding of the energy of all hairs, relative to it. Sums of 10^6 terms.
const ROUNDING: f64 = 1e-13;

/// The iteration on all hairs.
pub(super) struct Newton<'a> {
    pub(super) head: &'a Head<'a>,
    pub(super) stage: &'a StageCounter<'a>,
    pub(super) linear: LinearModel,
    trial: State,
    step: Vec<DVec3>,
    /// Farthest that a point may move in a step, in contact radii of its hair.
    pub(super) farthest: f64,
}

/// What a step did.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Step {
    /// Whether the energy fell.
    pub(super) lower: bool,
    /// Iterations of the linear system.
    pub(super) linear: usize,
    /// Share of hairs that may not go as far as they would.
    pub(super) shortened: f64,
    /// How far it went, of the whole step.
    pub(super) at: f64,
    pub(super) trials: usize,
}

impl<'a> Newton<'a> {
    pub(super) fn new(head: &'a Head<'a>, stage: &'a StageCounter<'a>, farthest: f64) -> Self {
        Self {
            head,
            stage,
            linear: LinearModel::new(head),
            trial: head.state(vec![DVec3::ZERO; head.layout.joint_count()]),
            step: vec![DVec3::ZERO; head.layout.joint_count()],
            farthest,
        }
    }

    /// A step from an evaluated shape to another.
    ///
    /// # Errors
    /// [`Cancelled`], if the progress says so.
    pub(super) fn step(
        &mut self,
        interaction: &mut dyn Interaction,
        state: &mut State,
        rule: LinearRule,
    ) -> Result<Step, Cancelled> {
        self.stage.check()?;
        let head = self.head;
        self.linear.renew(head, interaction, state);
        let mut done = Step::default();
        // Hairs that may not go as far as they would can turn a direction uphill. The first direction of the linear system does that
        // least.
        for rule in [rule, LinearRule { most: 1, ..rule }] {
            done.linear += self.linear.solve(head, interaction, &state.gradient, rule);
            let radii = &head.system.radii;
            let far = |strand: usize| self.farthest * radii[strand];
            done.shortened = self.linear.step(head, LARGEST_TURN, far, &mut self.step);
            let slope = head.dot(&state.gradient, &self.step);
            if slope < 0.0 && self.search(interaction, state, slope, &mut done) {
                done.lower = true;
                break;
            }
        }
        Ok(done)
    }

    /// Goes along the step until the energy falls; `false` if it does not.
    fn search(
        &mut self,
        interaction: &mut dyn Interaction,
        state: &mut State,
        slope: f64,
        done: &mut Step,
    ) -> bool {
        let Self { head, trial, step, .. } = self;
        let noise = ROUNDING * state.energy.abs();
        let mut at = 1.0;
        for _ in 0..TRIALS {
            trial.controls.clear();
            let moved = state.controls.par_iter().zip(&*step).map(|(c, d)| *c + *d * at);
            trial.controls.par_extend(moved);
            trial.clear.copy_from_slice(&state.clear);
            head.evaluate(interaction, trial);
            done.trials += 1;
            done.at = at;
            let there = head.dot(&trial.gradient, step);
            let falls = trial.energy <= state.energy + ARMIJO * at * slope
                || (trial.energy <= state.energy + noise && there.abs() <= slope.abs());
            if falls {
                std::mem::swap(state, trial);
                return true;
            }
            // The zero of the slope between, away from both ends.
            let share = if there > 0.0 { slope / (slope - there) } else { 0.5 };
            at *= share.clamp(0.1, 0.5);
        }
        false
    }
}
