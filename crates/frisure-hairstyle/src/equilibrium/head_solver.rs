//! All guides at once: wisps make way for each other until the energy of the whole head is least.
//!
//! The energy of the head is that of its guides on the body and of every pair of wisps that overlap
//! (docs/theory.md, "Hair against hair: layers and wisps"). It is lowered in two phases, neither of which can raise it:
//!
//! 1. *Sweeps* (block coordinate descent): one guide after the other goes downhill while the others hold still; guides
//!    that cannot touch move at the same time. A few sweeps settle which wisp lies on which.
//! 2. *Convergence*, until the derivative of the energy by every control of every guide is below the tolerance. Each step
//!    1. updates the neighbours of guides that have used up half of their reach;
//!    2. computes each guide's Newton step while the others hold still;
//!    3. finds the active guides, those not at rest; it ends if there are none;
//!    4. while they are few, sweeps over the active guides alone;
//!    5. otherwise moves all guides along a conjugate direction with the Newton steps as preconditioner (Polak & Ribière
//!       1969), by a line search.

use frisure_rod::Equilibrium;
use frisure_rod::minimise::NewtonStep;
use frisure_rod::potential::Yielding;
use glam::DVec3;

use super::friction_solver::Hold;
use super::letting_go::loads;
use super::wisp::{Settled, Wisp, friction_gaps, press, rest_among, wisps_with_pairs};
use crate::contact::{ContactPairs, Pull};
use crate::guides::Guide;
use crate::hairstyle::Rest;
use crate::head::Head;
use crate::parallel;
use crate::spec::HairstyleSpec;
use frisure_progress::{Cancelled, Progress, StageCounter};

/// Most sweeps of phase 1. Chosen by trial; not measured further.
const MOST_SWEEPS: usize = 30;
/// Phase 1 ends when half of the guides move less than this (m). Chosen by trial; not measured further.
const CALM: f64 = 2e-4;

/// Share of phase 1 in the progress shown; no result depends on it.
const SORTED: f64 = 0.3;

/// Most steps of phase 2: a guard, seldom reached.
pub(super) const MOST_STEPS: usize = 1000;
/// How far a guide may move in a step of phase 2, as a share of a sweep: far moves are done. Chosen by trial; not measured
/// further.
const LARGEST_STEP: f64 = 0.4;

/// How far a guide may move in one sweep, as a fraction of the mean radius of wisps: not so far that
/// it could jump over another. Chosen by trial; not measured further.
const LARGEST_MOVE: f64 = 1.5;
/// Largest move in one sweep (m), also among thick wisps. Chosen by trial; not measured further.
const MOST_REACH: f64 = 4e-3;

/// Active guides are few if at most one guide in this many is active (docs/theory.md, "Hair against hair").
const FEW: usize = 4;

/// Least distance (m) beyond their thickness within which neighbours are searched. Chosen: a fraction of a wisp's radius.
const LEAST_REACH: f64 = 6e-4;

/// Reach (m) of a guide after a search, in moves like its last: with four of them a search of neighbours serves about two
/// steps. At most twice the farthest move. Chosen by trial; not measured further.
const MOVES_PER_SEARCH: f64 = 4.0;

/// Share of what is left of its reach that a guide may move in a line search, so that rounding does not use it up. Chosen.
const ROOM: f64 = 0.9;

/// Energies computed in one line search at most. Chosen by trial; not measured further.
const TRIALS: usize = 4;

/// The part of the expected decrease that a step of all guides has to reach. Chosen: larger than Armijo's usual 1e-4, since
/// a sweep over the active guides is the alternative to a poor step.
const SUFFICIENT: f64 = 0.1;

/// Least and largest fraction of a direction that the next line search starts with. Chosen.
const FRACTIONS: (f64, f64) = (0.1, 2.0);

/// Least and largest factor on a fraction after a failed trial. [Nocedal & Wright] §3.5: interpolation with safeguards.
const BACKTRACKING: (f64, f64) = (0.1, 0.5);

/// Most times that phase 2 is done again because friction has changed. A guard.
const MOST_ROUNDS: usize = 40;

/// How [`settle`] works.
pub(super) struct SweepOptions {
    /// Whether phase 1 comes first.
    pub(super) sweep_first: bool,
    /// Most steps of phase 2.
    pub(super) most: usize,
    /// Whether friction holds wisps near where they start.
    pub(super) hold: Hold,
    /// How the hairs inside each wisp stick.
    pub(super) locks: Vec<Option<Yielding>>,
}

/// Lets wisps make way for each other from where the guides are in `start`. Friction, if there is any, lets them stick where
/// they touch; limits and anchors follow the wisps after each sweep of phase 1, and after each round of phase 2 until both
/// agree (docs/theory.md, "Friction"). `gone` is what lets go of each guide, in steps.
///
/// # Errors
/// [`Cancelled`], if the work is cancelled.
pub(super) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    start: &[Equilibrium],
    gone: &[Option<Pull>],
    SweepOptions { sweep_first, most, hold, locks }: SweepOptions,
    progress: &dyn Progress,
) -> Result<Rest, Cancelled> {
    let stage = StageCounter::new(progress, "wisps making way", 1);
    let mut solver = HeadSolver::new(spec, head, guides, start, hold);
    for (wisp, lock) in solver.wisps.iter_mut().zip(locks) {
        wisp.set_lock(lock);
    }
    if !sweep_first && solver.rubs {
        solver.update_neighbours();
        solver.press();
    }
    let mut sweeps = 0;
    for share in loads(gone) {
        for (wisp, gone) in solver.wisps.iter_mut().zip(gone) {
            wisp.let_go(gone.as_ref().map(|gone| gone.scaled(share)));
        }
        sweeps += if sweep_first { solver.sweep_until_calm(&stage)? } else { 0 };
        sweeps += solver.settle_with_friction(&stage, most)?;
        solver.wisps.iter_mut().for_each(Wisp::follow_lock);
    }
    Ok(solver.finish(sweeps))
}

/// All guides of a head on their way to rest.
struct HeadSolver<'a> {
    /// Relative gradient of each guide at which the head is at rest.
    tolerance: f64,
    /// Whether friction holds wisps.
    rubs: bool,
    wisps: Vec<Wisp<'a>>,
    pairs: ContactPairs,
    /// The order in which guides move.
    order: Vec<usize>,
    /// Guides of which no two may touch, in that order.
    groups: Vec<Vec<usize>>,
    /// How far a guide may move in a sweep (m).
    largest: f64,
    /// How far a guide may move at once (m).
    farthest: f64,
    /// How far each guide may move (m) before its neighbours are searched again …
    reach: Vec<f64>,
    /// How far each guide has moved (m) since its neighbours were searched.
    drift: Vec<f64>,
    /// How far each guide moved (m) in the last sweep.
    last: Vec<f64>,
}

impl<'a> HeadSolver<'a> {
    fn new(
        spec: &HairstyleSpec,
        head: &'a Head,
        guides: &'a [Guide],
        alone: &'a [Equilibrium],
        hold: Hold,
    ) -> Self {
        let (wisps, pairs) = wisps_with_pairs(spec, head, guides, alone, hold);
        let mut order: Vec<usize> = (0..guides.len()).collect();
        // Hair rooted lower lies lower: it is the first to be pushed out of the way.
        let up = -spec.pose.down();
        let height = |i: usize| guides[i].root.position.dot(up);
        order.sort_by(|&a, &b| height(a).total_cmp(&height(b)).then(a.cmp(&b)));
        let count = wisps.len();
        // The scale of the head: wisps are about as thick in the middle as contact takes them to be.
        let middle = |g: &Guide| g.thickness.packed(0.5 * g.rod.length());
        let radius = guides.iter().map(middle).sum::<f64>() / count as f64;
        let largest = (LARGEST_MOVE * radius).clamp(LEAST_REACH, MOST_REACH);
        Self {
            tolerance: spec.equilibrium.tolerance,
            rubs: hold == Hold::ByFriction && guides.iter().any(|guide| !guide.friction.is_zero()),
            wisps,
            pairs,
            order,
            groups: Vec::new(),
            largest,
            farthest: largest,
            reach: vec![largest; count],
            drift: vec![f64::INFINITY; count],
            last: vec![largest; count],
        }
    }
}

impl HeadSolver<'_> {
    /// Phase 1: sweeps until half of the guides are calm. Returns the number of sweeps.
    fn sweep_until_calm(&mut self, stage: &StageCounter<'_>) -> Result<usize, Cancelled> {
        let everyone = vec![true; self.wisps.len()];
        self.farthest = self.largest;
        for sweep in 1..=MOST_SWEEPS {
            self.update_neighbours();
            self.press();
            self.sweep(stage, &everyone)?;
            // Symmetric sweeps (Gauss–Seidel): the same guides are not the first to move every time.
            self.order.reverse();
            stage.at(SORTED * sweep as f64 / MOST_SWEEPS as f64);
            let calm = self.last.iter().filter(|&&m| m < CALM).count();
            if 2 * calm >= self.wisps.len() {
                return Ok(sweep);
            }
        }
        Ok(MOST_SWEEPS)
    }

    /// Phase 2, again until friction agrees with where wisps are, in at most `most` steps; returns the number of steps.
    fn settle_with_friction(
        &mut self,
        stage: &StageCounter<'_>,
        most: usize,
    ) -> Result<usize, Cancelled> {
        let mut steps = 0;
        for round in 0..MOST_ROUNDS {
            let left = most - steps;
            let taken = self.converge(stage, left)?;
            steps += taken;
            // At rest with the friction of where wisps are: the law holds there, (F3). Or not at rest at all.
            if taken == left || (round > 0 && taken == 0) || !self.rubs {
                break;
            }
            self.press();
        }
        Ok(steps)
    }

    /// Lets friction follow where wisps are.
    fn press(&mut self) {
        if !self.rubs {
            return;
        }
        press(&mut self.wisps, Some(&mut self.pairs));
    }

    /// Step 2.1: searches the neighbours of guides that have used up half of their reach.
    fn update_neighbours(&mut self) {
        // Lists hold while no guide has moved by more than its reach since; half of it is left for the next move.
        let used_up: Vec<bool> =
            self.drift.iter().zip(&self.reach).map(|(drift, reach)| *drift > 0.5 * reach).collect();
        if !used_up.contains(&true) {
            return;
        }
        for i in (0..self.wisps.len()).filter(|&i| used_up[i]) {
            let most = (2.0 * self.farthest).max(LEAST_REACH);
            self.reach[i] = (MOVES_PER_SEARCH * self.last[i]).clamp(LEAST_REACH, most);
            self.drift[i] = 0.0;
        }
        self.pairs.update_neighbours(&self.reach, &used_up);
        self.groups = self.pairs.groups(&self.order);
    }

    /// Moves each guide of `who` downhill once, those that cannot touch at the same time.
    fn sweep(&mut self, stage: &StageCounter<'_>, who: &[bool]) -> Result<(), Cancelled> {
        for group in &self.groups {
            stage.check()?;
            let group: Vec<usize> = group.iter().copied().filter(|&i| who[i]).collect();
            // No guide of a group touches another, so that moving them at the same time gives the same as one by one.
            let settled = parallel::map_slice(&group, |&i| {
                self.wisps[i].downhill(&self.pairs.around(i), self.reach[i] - self.drift[i])
            });
            for (i, settled) in group.into_iter().zip(settled) {
                self.wisps[i].take(settled);
                self.last[i] = self.pairs.place(i, self.wisps[i].points());
                self.drift[i] += self.last[i];
            }
        }
        Ok(())
    }

    /// Phase 2: steps until no guide is active, at most `most`. Returns the number of steps.
    fn converge(&mut self, stage: &StageCounter<'_>, most: usize) -> Result<usize, Cancelled> {
        self.farthest = LARGEST_STEP * self.largest;
        self.drift.fill(f64::INFINITY);
        let mut newton: Vec<Option<NewtonStep>> = vec![None; self.wisps.len()];
        let mut previous: Option<Direction> = None;
        let mut first: Option<f64> = None;
        for step in 0..most {
            stage.check()?;
            self.update_neighbours(); // 2.1
            self.newton_steps(&mut newton); // 2.2
            let active = self.active(&newton); // 2.3
            let count = active.iter().filter(|r| **r).count();
            if count == 0 {
                return Ok(step);
            }
            let steepest = self.steepest(&newton);
            let first = *first.get_or_insert(steepest);
            // Progress on a logarithmic scale: from the first gradient to the tolerance.
            let done = (first / steepest).ln() / (first / self.tolerance).ln().max(1e-9);
            stage.at(SORTED + (1.0 - SORTED) * done);
            if count * FEW <= self.wisps.len() {
                // 2.4
                self.sweep(stage, &active)?;
                self.forget(&mut newton, &active);
                previous = None;
            } else {
                // 2.5
                let all = newton.iter_mut().map(|n| n.take().expect("known for all")).collect();
                let mut direction = Direction::new(all, previous.as_ref());
                if self.search(&mut direction) {
                    previous = Some(direction);
                } else {
                    // Some guides have far to go: each by itself does better.
                    self.update_neighbours();
                    self.sweep(stage, &active)?;
                    previous = None;
                }
            }
        }
        Ok(most)
    }

    /// Step 2.2: computes the Newton steps that are not known.
    fn newton_steps(&self, newton: &mut [Option<NewtonStep>]) {
        parallel::for_each_mut(newton, |i, n| {
            let reach = self.reach[i] - self.drift[i];
            n.get_or_insert_with(|| self.wisps[i].newton_step(&self.pairs.around(i), reach));
        });
    }

    /// Largest relative gradient of any guide.
    fn steepest(&self, newton: &[Option<NewtonStep>]) -> f64 {
        let known = self.wisps.iter().zip(newton.iter().flatten());
        known.map(|(w, n)| slope(w, n)).fold(0.0, f64::max)
    }

    /// Step 2.3: which guides are not at rest.
    fn active(&self, newton: &[Option<NewtonStep>]) -> Vec<bool> {
        let still = |(w, n): (&Wisp<'_>, &Option<NewtonStep>)| {
            // A vanishing gradient at a saddle point is not rest.
            n.as_ref().is_some_and(|n| slope(w, n) <= self.tolerance && n.positive_definite)
        };
        self.wisps.iter().zip(newton).map(|wn| !still(wn)).collect()
    }

    /// Forgets the steps of guides that have moved, and of those that may touch them.
    fn forget(&self, newton: &mut [Option<NewtonStep>], moved: &[bool]) {
        for (i, step) in newton.iter_mut().enumerate() {
            if moved[i] || self.pairs.touched_by(i).any(|j| moved[j]) {
                *step = None;
            }
        }
    }

    /// Step 2.5: a line search by parabolas along a direction. Returns whether it found a lower energy.
    fn search(&mut self, direction: &mut Direction) -> bool {
        let energy = direction.energy.unwrap_or_else(|| self.energy());
        // 1. Each guide's part of the direction, cut to its remaining reach: who may touch whom stays valid.
        let mut fraction = direction.fraction;
        let wisps = &self.wisps;
        let mut lengths = parallel::map(wisps.len(), |i| wisps[i].length_of(&direction.way[i]));
        for (i, length) in lengths.iter_mut().enumerate() {
            let room = ROOM * (self.reach[i] - self.drift[i]) / fraction;
            if *length > room {
                direction.shorten(i, room / *length);
                *length = room;
            }
        }
        if direction.slope >= 0.0 {
            return false;
        }
        // 2. Trials of E(α) until the decrease is sufficient.
        let here: Vec<_> = self.wisps.iter().map(|w| w.settled().clone()).collect();
        for _ in 0..TRIALS {
            self.go(&here, &direction.way, fraction);
            let found = self.energy();
            // The parabola E(0) + s α + b α² through both energies with the slope s at the start; least at −s/2b.
            let bend = (found - energy - direction.slope * fraction) / (fraction * fraction);
            let least = -0.5 * direction.slope / bend;
            let least = if bend > 0.0 { least } else { 4.0 * fraction };
            if found <= energy + SUFFICIENT * direction.slope * fraction {
                direction.fraction = least.clamp(FRACTIONS.0, FRACTIONS.1);
                direction.energy = Some(found);
                for (i, length) in lengths.into_iter().enumerate() {
                    self.last[i] = fraction * length;
                    self.drift[i] += self.last[i];
                }
                return true;
            }
            fraction = least.clamp(BACKTRACKING.0 * fraction, BACKTRACKING.1 * fraction);
        }
        // 3. No trial was good enough: back to where the guides were.
        self.go(&here, &direction.way, 0.0);
        false
    }

    /// Goes a fraction of a way from given shapes.
    fn go(&mut self, from: &[Settled], way: &[Vec<DVec3>], fraction: f64) {
        let points =
            parallel::map_mut(&mut self.wisps, |i, wisp| wisp.go(&from[i], &way[i], fraction));
        for (i, points) in points.into_iter().enumerate() {
            self.pairs.place(i, points);
        }
    }

    /// Energy of the head (J).
    fn energy(&self) -> f64 {
        let share = |i: usize| self.wisps[i].share(&self.pairs.shared(i), None);
        // Summed in order, so that it does not depend on threads.
        parallel::map(self.wisps.len(), share).iter().sum()
    }

    fn finish(mut self, sweeps: usize) -> Rest {
        let count = self.wisps.len();
        // The lists without margins: certificates count what touches now, nothing else.
        self.pairs.update_neighbours(&vec![0.0; count], &vec![true; count]);
        let gaps = friction_gaps(&self.wisps, Some(&self.pairs));
        let friction = gaps.iter().map(|gap| gap.ratio).collect();
        Rest { sweeps, friction, ..rest_among(&self.wisps, &self.pairs, self.tolerance) }
    }
}

/// Relative gradient of a guide.
fn slope(wisp: &Wisp<'_>, newton: &NewtonStep) -> f64 {
    newton.gradient.iter().map(|g| g.length()).fold(0.0, f64::max) / wisp.moment_scale()
}

/// A direction for all guides together.
struct Direction {
    newton: Vec<NewtonStep>,
    /// Change of each control of each guide (rad).
    way: Vec<Vec<DVec3>>,
    /// Derivative of the energy along it (J).
    slope: f64,
    /// How much of it is a good step.
    fraction: f64,
    /// Energy of the head (J), if it is known already: where this begins, then where it ended.
    energy: Option<f64>,
}

impl Direction {
    fn new(newton: Vec<NewtonStep>, previous: Option<&Self>) -> Self {
        let mut direction = Self::downhill(newton, previous.map_or(1.0, |p| p.fraction));
        let Some(previous) = previous else { return direction };
        direction.energy = previous.energy;
        // Polak & Ribière's factor β = z·(g − h) / y·h, with Newton's steps −z and −y for the preconditioned gradients of this
        // step (g) and of the last (h). A negative β starts afresh, [Nocedal & Wright] (5.45).
        let (mut above, mut below) = (0.0, 0.0);
        for (new, old) in direction.newton.iter().zip(&previous.newton) {
            for ((g, z), (h, y)) in
                new.gradient.iter().zip(&new.step).zip(old.gradient.iter().zip(&old.step))
            {
                above -= z.dot(*g - *h);
                below -= y.dot(*h);
            }
        }
        let factor = (above / below).max(0.0);
        if factor.is_finite() && factor > 0.0 {
            for (way, old) in direction.way.iter_mut().zip(&previous.way) {
                for (x, y) in way.iter_mut().zip(old) {
                    *x += *y * factor;
                }
            }
            direction.slope = dot(&direction.newton, &direction.way);
            if direction.slope >= 0.0 {
                // Without earlier directions.
                let energy = direction.energy;
                return Self { energy, ..Self::downhill(direction.newton, direction.fraction) };
            }
        }
        direction
    }

    fn downhill(newton: Vec<NewtonStep>, fraction: f64) -> Self {
        let way: Vec<_> = newton.iter().map(|n| n.step.clone()).collect();
        let slope = dot(&newton, &way);
        Self { newton, way, slope, fraction, energy: None }
    }

    /// Makes the step of one guide shorter.
    fn shorten(&mut self, guide: usize, factor: f64) {
        let slope = |d: &Self| slope_along(&d.newton[guide], &d.way[guide]);
        let before = slope(self);
        for x in &mut self.way[guide] {
            *x *= factor;
        }
        self.slope += slope(self) - before;
    }
}

fn dot(newton: &[NewtonStep], way: &[Vec<DVec3>]) -> f64 {
    newton.iter().zip(way).map(|(n, way)| slope_along(n, way)).sum()
}

/// Derivative of the energy along a change of one guide's controls (J).
fn slope_along(newton: &NewtonStep, way: &[DVec3]) -> f64 {
    newton.gradient.iter().zip(way).map(|(g, x)| g.dot(*x)).sum()
}
