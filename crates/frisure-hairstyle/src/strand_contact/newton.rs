//! Newton's method on the energy of all hairs: a step, and how far it goes.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;

use super::energy::{Head, State};
use super::interaction::Interaction;
use super::layout::BLOCK;
use super::linear::{LinearModel, LinearRule};
use crate::parallel;

/// Armijo's constant.
const ARMIJO: f64 = 1e-4;

/// Most trials of a line search. Chosen; not measured further.
const TRIALS: usize = 8;

/// Trials from which on a hair that still goes beyond its minimum does not move. Chosen by trial.
const PATIENCE: usize = 2;

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
    /// How far (m, rad) each hair moves.
    far: Vec<(f64, f64)>,
    /// Farthest that a point may move in a step, in contact radii of its hair.
    pub(super) farthest: f64,
}

impl<'a> Newton<'a> {
    pub(super) fn new(head: &'a Head<'a>, stage: &'a StageCounter<'a>, farthest: f64) -> Self {
        Self {
            head,
            stage,
            linear: LinearModel::new(head),
            trial: head.state(vec![DVec3::ZERO; head.layout.joint_count()]),
            step: vec![DVec3::ZERO; head.layout.joint_count()],
            far: vec![(0.0, 0.0); head.layout.strands()],
            farthest,
        }
    }

    /// A step from an evaluated shape to another; `false` if it stays where it is, because no direction leads down.
    ///
    /// # Errors
    /// [`Cancelled`], if the progress says so.
    pub(super) fn step(
        &mut self,
        interaction: &mut dyn Interaction,
        state: &mut State,
        rule: LinearRule,
    ) -> Result<bool, Cancelled> {
        self.stage.check()?;
        let head = self.head;
        self.linear.linearise(interaction, state);
        self.linear.factorise(head, state);
        // Hairs that may not go as far as they would can turn a direction uphill. The first direction of the linear system does that
        // least.
        for rule in [rule, LinearRule { most: 1, least: 1, ..rule }] {
            self.linear.solve(head, interaction, &state.gradient, rule);
            self.linear.step(head, &mut self.step, &mut self.far);
            self.limit();
            if self.search(interaction, state) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Shortens the steps of hairs that go too far, and holds these back the next time.
    fn limit(&mut self) {
        let Self { head, linear, step, far, farthest, .. } = self;
        let (head, farthest) = (*head, *farthest);
        let limit =
            |strand: usize, step: &mut [DVec3], (moved, turned): (f64, f64), drag: &mut f64| {
                let most = farthest * head.system.radii[strand];
                let excess = (moved / most).max(turned / LARGEST_TURN);
                let length = head.system.rods[strand].length();
                let least = head.moments[strand] / (length * length * most);
                if excess > 1.0 {
                    step.iter_mut().for_each(|d| *d *= 1.0 / excess);
                    *drag = (*drag * excess.clamp(2.0, 8.0)).max(0.1 * least * excess.min(10.0));
                } else {
                    *drag *= 0.3;
                    if *drag < 1e-3 * least {
                        *drag = 0.0;
                    }
                }
            };
        let layout = &head.layout;
        let drag = layout.by_strand(&mut linear.drag);
        let mut work: Vec<_> = layout.by_joint(step).into_iter().zip(drag).collect();
        parallel::for_each_mut(&mut work, |index, (step, drag)| {
            let mut joint = 0;
            for (strand, drag) in layout.chunks()[index].clone().zip(drag.iter_mut()) {
                let n = layout.joints(strand).len();
                limit(strand, &mut step[joint..joint + n], far[strand], drag);
                joint += n;
            }
        });
    }

    /// The slopes of each hair along its step.
    fn slopes(&self, gradient: &[DVec3]) -> Vec<f64> {
        let layout = &self.head.layout;
        let slope = |strand: usize| {
            let joints = layout.joints(strand);
            let pairs = gradient[joints.clone()].iter().zip(&self.step[joints]);
            pairs.map(|(g, d)| g.dot(*d)).sum::<f64>()
        };
        parallel::map(layout.strands(), slope)
    }

    /// Goes along the step if the energy falls, shortening the steps of hairs that go beyond their minimum where it does not;
    /// `false` if it never falls.
    fn search(&mut self, interaction: &mut dyn Interaction, state: &mut State) -> bool {
        let head = self.head;
        let noise = ROUNDING * state.energy.abs();
        let mut slopes = self.slopes(&state.gradient);
        for trials in 0..TRIALS {
            let slope: f64 = slopes.iter().sum();
            let trial = &mut self.trial;
            trial.controls.copy_from_slice(&state.controls);
            let blocks = trial.controls.chunks_mut(BLOCK).zip(self.step.chunks(BLOCK));
            parallel::for_each_mut(&mut blocks.collect::<Vec<_>>(), |_, (controls, step)| {
                controls.iter_mut().zip(*step).for_each(|(c, d)| *c += *d);
            });
            trial.clear.copy_from_slice(&state.clear);
            head.evaluate(interaction, trial);
            let there = self.slopes(&self.trial.gradient);
            let sum: f64 = there.iter().sum();
            let falls = slope < 0.0
                && (self.trial.energy <= state.energy + ARMIJO * slope
                    || (self.trial.energy <= state.energy + noise && sum.abs() <= slope.abs()));
            if falls {
                std::mem::swap(state, &mut self.trial);
                return true;
            }
            // Hairs whose slope has turned go to where it is zero between, away from both ends, and those that bend farther than their
            // motion said go as far as they may; all go less far where there is neither.
            let factors = parallel::map(there.len(), |strand| {
                let (t, s) = (there[strand], slopes[strand]);
                let moved = head.moved(strand, &state.points, &self.trial.points);
                let far = self.farthest * head.system.radii[strand];
                let over = moved > 2.0 * far || t > 0.3 * s.abs();
                if over && trials >= PATIENCE {
                    // Others must not wait for it: it stays where it is.
                    0.0
                } else if moved > 2.0 * far {
                    (far / moved).clamp(0.02, 0.5)
                } else if t > 0.3 * s.abs() {
                    if s < 0.0 { (s / (s - t)).clamp(0.1, 0.7) } else { 0.1 }
                } else {
                    1.0
                }
            });
            let turned = factors.iter().filter(|&&factor| factor < 1.0).count();
            for (strand, factor) in factors.into_iter().enumerate() {
                let factor = if turned == 0 { 0.3 } else { factor };
                if factor < 1.0 {
                    for d in &mut self.step[head.layout.joints(strand)] {
                        *d *= factor;
                    }
                    slopes[strand] *= factor;
                }
            }
        }
        false
    }
}
