//! Newton's method in lanes: damping, the acceptance of steps, and rod after rod through the lanes.
//!
//! Every lane runs its own iteration: a rod that has converged leaves its lane to the next. Steps are those of
//! [`crate::minimise::Newton`], but a step that does not lower the energy enough is not halved: its damping
//! (Levenberg–Marquardt) grows, since the other lanes go on meanwhile. docs/theory.md, "Rods in lanes".

use glam::DVec3;

use super::division::Joints;
use super::elimination::SweepResult;
use super::lanes::Lanes;
use super::rotation::LARGEST_SQUARE;
use super::solution::RodSolution;
use crate::minimise::Stability;
use crate::rod::Rod;

/// Damping after a first failed pivot or a rejected step, as a fraction of the stiffness; as in
/// [`crate::minimise::Newton`]. Chosen by trial.
const FIRST_DAMPING: f64 = 0.3;

/// Least factor by which damping grows, and the factor after an accepted step; below [`LEAST_DAMPING`] it is switched
/// off. Chosen by trial, like the other constants of the damping; not measured further.
const GROWTH: f64 = 4.0;
const SHRINKAGE: f64 = 0.2;
const LEAST_DAMPING: f64 = 0.01;

/// Factor above a recently rejected damping that the damping keeps, the factor by which this memory fades with each
/// accepted step, and the damping below which it is dropped. Chosen by trial, as are the following.
const ABOVE_REJECTED: f64 = 1.5;
const FADING: f64 = 0.25;
const FORGOTTEN: f64 = 0.05;

/// Largest factor by which damping grows at once. Chosen by trial.
const MOST_GROWTH: f64 = 16.0;

/// Damping at which a rod is given up. Chosen: a step is shorter than rounding then.
const LARGEST_DAMPING: f64 = 1e9;

/// Armijo's constant: the part of the expected decrease that a step has to reach. \[Nocedal & Wright\] §3.1.
const ARMIJO: f64 = 1e-4;

/// When a rod is at rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct StoppingRule {
    /// Relative gradient.
    pub(super) tolerance: f64,
    pub(super) max_iterations: usize,
}

/// How the iteration of one rod ended.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LaneResult {
    /// Whether at a minimum.
    pub(super) converged: bool,
    /// Relative gradient.
    pub(super) gradient: f64,
    pub(super) iterations: usize,
    /// Energy (J).
    pub(super) energy: f64,
}

impl LaneResult {
    pub(super) fn solution(&self) -> RodSolution {
        RodSolution {
            stability: if self.converged { Stability::Stable } else { Stability::NotConverged },
            gradient_norm: self.gradient,
            iterations: self.iterations,
            energy: self.energy,
        }
    }
}

/// Rods to solve, and where their results go.
pub(super) struct Job<'a> {
    pub(super) rods: &'a [Rod],
    pub(super) elements: usize,
    pub(super) rule: StoppingRule,
    /// Turns of joints (rad) at the start, those of a rod one after the other; then those at rest.
    pub(super) controls: &'a mut [DVec3],
    pub(super) results: &'a mut [LaneResult],
}

/// Rods in lanes, and the two sweeps over them.
pub(super) trait LaneSweeps<F: Lanes> {
    /// Puts a rod into a lane, its joints turned as given. Its energy (J), without the constant, if the lane has that
    /// shape then; `None` if the shape is the next trial.
    fn load(&mut self, lane: usize, rod: usize, joints: &Joints, start: &[DVec3]) -> Option<f64>;
    /// Makes the given shape the next trial of a lane.
    fn begin(&mut self, lane: usize);
    /// As [`super::weight_sweep::Bundle::backward`].
    fn backward(&mut self, accepted: F::Mask, damping: F) -> SweepResult<F>;
    /// As [`super::weight_sweep::Bundle::forward`].
    fn forward(&mut self) -> F;
    /// Takes a rod out of a lane: the turns of its joints (rad).
    fn save(&mut self, lane: usize, rod: usize, controls: &mut [DVec3]);
}

/// The iteration of one lane.
#[derive(Clone, Copy)]
struct Lane {
    /// `None`: the lane is empty.
    rod: Option<usize>,
    /// Energy without the constant, and the constant (J).
    energy: f64,
    constant: f64,
    damping: f64,
    /// The moment (N m) that gradients are relative to.
    scale: f64,
    iterations: usize,
    /// The least stiffness of a joint (N m).
    stiffness: f64,
    /// Whether a step is being tried.
    trying: bool,
    /// Damping of the last accepted step, and of the last rejected one; the latter fades with each accepted step.
    accepted_damping: f64,
    rejected_damping: f64,
    /// Whether the trial is the given shape.
    fresh: bool,
}

impl Lane {
    const EMPTY: Self = Self {
        rod: None,
        energy: 0.0,
        constant: 0.0,
        damping: 0.0,
        scale: 1.0,
        iterations: 0,
        stiffness: 1.0,
        trying: false,
        accepted_damping: 0.0,
        rejected_damping: 0.0,
        fresh: false,
    };

    /// After a rejected step, or a pivot that is negative by `missing` (N m): at least that much more stiffness, within
    /// the largest growth. Where a larger damping was accepted before, half the way there (by logarithm) is enough.
    fn increase_damping(&mut self, missing: f64) {
        // Damping adds σ K to the pivot: `missing / stiffness` is about what it lacks.
        self.rejected_damping = self.damping;
        let least = FIRST_DAMPING.max(GROWTH * self.damping);
        self.damping = if self.accepted_damping > 2.0 * self.damping {
            (self.accepted_damping * self.damping.max(FORGOTTEN)).sqrt().max(FIRST_DAMPING)
        } else {
            let most = MOST_GROWTH * FIRST_DAMPING.max(self.damping);
            (missing / self.stiffness).min(most).max(least)
        };
    }

    /// After an accepted step. A damping that was too weak a step ago is not tried again at once.
    fn decrease_damping(&mut self) {
        self.accepted_damping = self.damping;
        self.rejected_damping *= FADING;
        let above = if self.rejected_damping < FORGOTTEN {
            0.0
        } else {
            ABOVE_REJECTED * self.rejected_damping
        };
        let weaker = (SHRINKAGE * self.damping).max(above);
        self.damping = if weaker < LEAST_DAMPING { 0.0 } else { weaker.min(self.damping) };
    }
}

/// Most lanes of any instruction set. `f32` in vectors of 512 bits.
const MOST_LANES: usize = 16;

/// Solves all rods of a job, as many at a time as there are lanes.
#[inline(always)]
pub(super) fn run<F: Lanes>(zero: F, sweeps: &mut impl LaneSweeps<F>, mut job: Job<'_>) {
    let mut lanes = [Lane::EMPTY; MOST_LANES];
    let lanes = &mut lanes[..F::LANES];
    let mut joints = Joints::default();
    let mut next = 0;
    let mut accepted = zero.mask(0);
    loop {
        // 1. Empty lanes take the next rods.
        refill(lanes, sweeps, &job, &mut joints, &mut next);
        if lanes.iter().all(|lane| lane.rod.is_none()) {
            return;
        }
        // 2. Gradient, pivots and laws at the shapes accepted last.
        let mut damping = zero;
        for (index, lane) in lanes.iter().enumerate() {
            damping.set(index, lane.damping);
        }
        let found = sweeps.backward(accepted, damping);
        // 3. Lanes that are done, that try a step, or that need more damping.
        decide(lanes, sweeps, &found, &mut job);
        // 4. The trial shapes and their energies.
        let energy = sweeps.forward();
        accepted = zero.mask(accept(lanes, &found, &energy));
    }
}

#[inline(always)]
fn refill<F: Lanes>(
    lanes: &mut [Lane],
    sweeps: &mut impl LaneSweeps<F>,
    job: &Job<'_>,
    joints: &mut Joints,
    next: &mut usize,
) {
    let n = job.elements;
    for (index, lane) in lanes.iter_mut().enumerate() {
        if lane.rod.is_none() && *next < job.rods.len() {
            let rod = *next;
            let start = &job.controls[rod * n..(rod + 1) * n];
            joints.divide(&job.rods[rod], n);
            let known = sweeps.load(index, rod, joints, start);
            *lane = Lane {
                rod: Some(rod),
                fresh: known.is_none(),
                energy: known.unwrap_or_default(),
                constant: joints.constant,
                scale: job.rods[rod].moment_scale(),
                stiffness: joints.stiffness.min_element(),
                ..Lane::EMPTY
            };
            *next += 1;
        }
    }
}

#[inline(always)]
fn decide<F: Lanes>(
    lanes: &mut [Lane],
    sweeps: &mut impl LaneSweeps<F>,
    found: &SweepResult<F>,
    job: &mut Job<'_>,
) {
    let n = job.elements;
    for (index, lane) in lanes.iter_mut().enumerate() {
        let Some(rod) = lane.rod else { continue };
        lane.trying = false;
        if lane.fresh {
            sweeps.begin(index);
            continue;
        }
        let gradient = found.gradient.get(index).sqrt() / lane.scale;
        // The scalar solver's certificate: the gradient of the energy itself, and positive pivots without damping.
        let positive = found.pivot.get(index) > 0.0;
        let stationary = gradient <= job.rule.tolerance;
        let converged = stationary && lane.damping == 0.0 && positive;
        // A joint that turns farther than the series reach, or NaN, fails too: hence the negated comparison.
        let failed = !(found.turned.get(index) < LARGEST_SQUARE)
            || lane.damping > LARGEST_DAMPING
            || lane.iterations >= job.rule.max_iterations
            || (stationary && lane.damping == 0.0 && !positive);
        if converged || failed {
            sweeps.save(index, rod, &mut job.controls[rod * n..(rod + 1) * n]);
            let energy = lane.energy + lane.constant;
            let iterations = lane.iterations;
            job.results[rod] = LaneResult { converged, gradient, iterations, energy };
            lane.rod = None;
        } else if stationary {
            // Only the pivots of the undamped sweep tell a minimum from a saddle point.
            lane.damping = 0.0;
        } else if positive {
            lane.trying = true;
        } else {
            lane.increase_damping(-found.pivot.get(index));
        }
    }
}

/// The lanes whose trial is accepted, as bits: given shapes, and steps that satisfy Armijo's condition. (L7)
#[inline(always)]
fn accept<F: Lanes>(lanes: &mut [Lane], found: &SweepResult<F>, energy: &F) -> u64 {
    let mut bits = 0_u64;
    for (index, lane) in lanes.iter_mut().enumerate() {
        lane.iterations += 1;
        if lane.fresh {
            bits |= 1 << index;
            (lane.fresh, lane.energy) = (false, energy.get(index));
        }
        if !lane.trying {
            continue;
        }
        let (tried, expected) = (energy.get(index), found.decrease.get(index));
        // The constant was rounded with the energy when the rod was loaded, and may be far larger.
        let noise = F::ENERGY_ROUNDING * lane.energy.abs().max(lane.constant.abs());
        let lower = tried <= lane.energy - ARMIJO * expected
            || (expected < noise && tried <= lane.energy + noise);
        if lower {
            bits |= 1 << index;
            lane.energy = tried;
            lane.decrease_damping();
        } else {
            lane.increase_damping(0.0);
        }
    }
    bits
}
