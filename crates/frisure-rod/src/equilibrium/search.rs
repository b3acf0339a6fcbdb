//! The search for an equilibrium: gravity's branch with few elements, then refinement, docs/theory.md, "Which
//! equilibrium".

use std::cell::OnceCell;

use glam::DVec3;

use super::fork::{lower_side, on_ridge, other_side};
use super::free_turn::{turned_towards, turns_freely};
use super::options::{Branch, Options};
use super::richardson::{
    Correction, corrections, every, extrapolate, extrapolate_energy, largest_gap,
};
use super::solution::{AccuracyStatus, Certificate, Equilibrium};
use super::stability::{LEAN_RESOLVED, LeastEigenvalue};
use super::warm_start::warm_start;
use crate::chain::{Chain, Shape};
use crate::minimise::{Energy, Minimiser, Minimum, Newton, Problem, Stability, StoppingCriteria};
use crate::potential::Potential;
use crate::random::SplitMix64;
use crate::resolution::{ElementKind, MAX_ELEMENTS, Resolution, follows_curl};
use crate::rod::Rod;
use crate::strain::NaturalStrain;
use crate::unresolved::unresolved;

/// The equilibrium of a rod in its own weight and in other potentials.
///
/// A given number of elements is used as it is. An accuracy is met by doubling the elements, and
/// extrapolating the centre line (Richardson), until the last two extrapolations agree.
/// [`Stability::NotConverged`] is an answer, not an error.
#[must_use]
pub fn equilibrium(rod: &Rod, external: &[&dyn Potential], options: &Options) -> Equilibrium {
    Search { rod, external, options, kind: options.element.chosen_for(rod) }.run(None)
}

/// As [`equilibrium`], but starting from the shape of another rod at rest instead of from the
/// natural shape: the nearest equilibrium downhill from it, in few iterations.
///
/// ```
/// use frisure_rod::{
///     Material, NaturalStrain, Options, Rod, RodSpec, Load, Root, Section, TorsionConstant, equilibrium,
///     equilibrium_from,
/// };
/// use glam::DVec3;
///
/// let hair = RodSpec {
///     length: 0.15,
///     section: Section::circular(35e-6)?,
///     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
///     torsion: TorsionConstant::SaintVenant,
///     natural: NaturalStrain::STRAIGHT,
///     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
///     load: Load::down(9.81),
/// };
/// let options = Options::default();
/// let long = equilibrium(&Rod::new(hair.clone())?, &[], &options);
/// // Cut to two thirds, it rests less far down, in the plane in which it hung.
/// let cut = Rod::new(RodSpec { length: 0.10, ..hair })?;
/// let short = equilibrium_from(&cut, &[], &options, &long);
/// assert!(short.tip().z > long.tip().z && short.tip().y.abs() < 1e-9);
/// # Ok::<(), frisure_rod::InvalidQuantity>(())
/// ```
#[must_use]
pub fn equilibrium_from(
    rod: &Rod,
    external: &[&dyn Potential],
    options: &Options,
    previous: &Equilibrium,
) -> Equilibrium {
    Search { rod, external, options, kind: options.element.chosen_for(rod) }.run(Some(previous))
}

struct Search<'a> {
    rod: &'a Rod,
    external: &'a [&'a dyn Potential],
    options: &'a Options,
    kind: ElementKind,
}

/// A shape at one division of the rod.
struct Level {
    elements: usize,
    minimum: Minimum,
    energy: Energy,
    /// Smallest eigenvalue, once it was needed.
    least: OnceCell<f64>,
}

/// The end of gravity's branch.
struct Followed {
    level: Level,
    /// Whether the rod was far from a loss of stability at every step, and none was halved.
    clear: bool,
}

/// What divisions say of the stability of the exact rod.
struct Verdict {
    stability: Stability,
    /// Smallest eigenvalue, where it was computed.
    least: Option<LeastEigenvalue>,
    /// Whether a finer division could say more.
    refinable: bool,
    /// Whether the shape is far enough from a loss of stability for its error to be told from divisions.
    resolved: bool,
}

impl Verdict {
    /// How many times as far a small disturbance moves the rod as without load, at most: along its softest direction, 1/λ times.
    fn softness(&self) -> f64 {
        // Where λ is zero within its error the shape turns at no cost, and there is no line to be near to but for that turn.
        let least = self.least.filter(LeastEigenvalue::is_resolved);
        least.map_or(1.0, |least| 1.0 / least.value.clamp(f64::MIN_POSITIVE, 1.0))
    }
}

/// Factor on gravity from one step of the branch to the next: a hanging rod's shape changes with the logarithm of its
/// heaviness. On 6 000 random hairs, steps of 1.02 end at the same equilibria (docs/theory.md, "Which equilibrium").
const GRAVITY_FACTOR: f64 = 2.5;

/// Factor on gravity below which a jump is taken: the branch itself ends there (a fold). Chosen by trial.
const SMALLEST_FACTOR: f64 = 1.02;

/// Factor on gravity below which a step over a fork is taken, to the lower side. Chosen by trial: of 80 curls in a nearly vertical
/// plane, at 14 weights each, as many end on the side of fine ramps with 1.2 as with less.
const FORK_FACTOR: f64 = 1.2;

/// Most steps that are halved. Chosen by trial: only rods far outside of hair need more.
const HALVINGS: usize = 60;

/// The same with external potentials, where hair snaps from one minimum to the next. Chosen by trial.
const HALVINGS_IN_CONTACT: usize = 6;

/// How many times as many elements the branch is followed with again where a step came near a loss of stability: few
/// elements lose it at another weight, or not at all. Tuned on 6 000 random hairs, of which 6 end on another branch with 1,
/// 2 with 2, none with 4.
const DIVIDED_NEAR_A_LOSS: usize = 4;

/// Relative gradient of a shape that only starts the next division, and of one at a part of the weight, relative to the
/// moments at that part. Chosen: errors of the division are larger.
const ON_THE_WAY: f64 = 1e-4;
const PART_OF_THE_WEIGHT: f64 = 1e-3;

/// The same where a branch forks: of a root that is turned by a tenth of a degree out of the plane of a curl. Chosen.
const NEAR_A_FORK: f64 = 1e-8;

/// Distance of a line from where its division is at rest, over the length of the rod and the relative gradient that is left. Measured as the
/// gap between 300 random hairs and the same turned with their gravity, whose roundings are others: at most 7.7, where the smallest eigenvalue is
/// 0.26. Without a gradient the gap is 1e-14.
const UNSETTLED: f64 = 10.0;

/// Relative gradient to reach where the smallest eigenvalue is not clearly positive: rounding ends the descent before.
const NEAR_A_THRESHOLD: f64 = 1e-14;

/// Share of the elastic energy by which a start carried over by moments may exceed the shape that it is from; above it
/// frames are carried instead. Chosen by trial.
const MOST_GAIN: f64 = 0.1;

/// Largest random turn (rad) about each axis of an element, times the root of the number of elements: those of a rod add up
/// to 2.3 rad (root mean square). Chosen.
const RANDOM_TURN: f64 = 4.0;

/// Relative difference below which two energies are one and the same minimum. Chosen: above rounding, below any barrier.
const SAME_ENERGY: f64 = 1e-9;

/// Distance of two lines over the length, above which they are different equilibria. Chosen: above what a loose tolerance
/// leaves; the same as in the count of minima of `validation/evidence`.
const SAME_LINE: f64 = 1e-2;

/// Distance of two lines without load over the length, above which the finer one is followed along gravity's branch: a hair near upright falls to the
/// side of its imperfections, and no finer division goes back. Chosen.
const IMPERFECTION: f64 = 1e-3;

/// The same where the branch came near a loss of stability: a root that is turned by a ten-thousandth, or a crimp that tilts the hair by as much,
/// decides the side. Chosen: less than a root is ever known by.
const DECISIVE: f64 = 1e-6;

/// Ratio of a gap between divisions to that between the ones before, at least and at most, which is a quarter in the limit. Chosen: with a quarter
/// 6 of 130 random hairs were off by up to 5 % more than estimated.
const CAUTIOUS: f64 = 1.0 / 3.0;
const SLOWEST: f64 = 0.9;

/// Error that is estimated of an extrapolated line, over the gap between the last two divisions, up to which these converge. In the limit the gap
/// is of second order and the error of fourth. Chosen.
const CONVERGING: f64 = 0.1;

/// Elements from which on gaps decrease so. Chosen: of 1640 random hairs 29 with 13 elements or less were above an estimate by two divisions.
const ASYMPTOTIC: usize = 16;

/// How many times as far as without load a small disturbance moves a rod, above which one gap between extrapolations says little. Chosen.
const SOFT: f64 = 10.0;

/// Least cosine of the turn of a tangent in a step along the branch; a step that turns one further (72°) is halved.
/// Chosen by trial.
const LARGEST_TURN_COSINE: f64 = 0.3;

impl Search<'_> {
    fn run(&self, previous: Option<&Equilibrium>) -> Equilibrium {
        let coarse = self.resolving_elements();
        match self.options.resolution {
            Resolution::Elements(n) => {
                let n = n.clamp(1, MAX_ELEMENTS);
                // What has an estimate is on the branch of the rod, whose imperfections these elements may not show.
                let imperfect = self.options.estimate_error && self.left_out(n) > 0.0;
                let most = if imperfect { n.max(self.most_elements() / 4) } else { n };
                let mut level = self.level(n, coarse.min(n), most, previous);
                if level.elements > n {
                    level = self.carried(&level, n, self.options.tolerance);
                }
                self.with_elements(level)
            }
            Resolution::Accuracy(accuracy) => {
                let first = coarse.min(self.most_elements());
                // Two more doublings tell the error.
                let most = self.most_elements() / 4;
                self.refine(self.level(first, first, most, previous), accuracy)
            }
        }
    }

    /// Elements that resolve the rod, and of its natural strain what could decide to which side it falls.
    fn resolving_elements(&self) -> usize {
        let most = self.most_elements() / 4;
        self.doubled(self.kind.resolving_elements(self.rod), most, IMPERFECTION)
    }

    /// Elements, up to `most`, with which the branch is followed again where it came near a loss of stability with `few`.
    fn elements_near_a_loss(&self, few: usize, most: usize) -> usize {
        self.doubled(DIVIDED_NEAR_A_LOSS * few, most, DECISIVE).min(most)
    }

    /// Elements, doubled as long as there are not more than `most` and they leave out more than a share of the length.
    fn doubled(&self, mut elements: usize, most: usize, share: f64) -> usize {
        while 2 * elements <= most && self.left_out(elements) > share * self.rod.length() {
            elements *= 2;
        }
        elements
    }

    /// What extrapolation leaves (m) of the natural strain that varies within the halves of so many elements and of twice as many.
    fn left_out(&self, elements: usize) -> f64 {
        unresolved(self.rod, 0.5 * self.rod.length() / elements as f64)
    }

    fn chain(&self, elements: usize) -> Chain<'_> {
        Chain::uniform(self.rod, self.kind, elements)
    }

    fn newton(&self) -> Newton {
        Newton { longest_step: self.options.longest_step, ..Newton::default() }
    }

    fn stopping(&self, tolerance: f64) -> StoppingCriteria {
        StoppingCriteria { tolerance, max_iterations: self.options.max_iterations }
    }

    fn most_elements(&self) -> usize {
        self.options.max_elements.clamp(1, MAX_ELEMENTS)
    }

    /// The equilibrium with `n` elements or more. The branch is followed with `coarse` elements, or with up to `most` where
    /// that matters, then refined; a shape that is nearly right already is settled at once.
    fn level(&self, n: usize, coarse: usize, most: usize, previous: Option<&Equilibrium>) -> Level {
        // 1. An equilibrium with few elements: from the other shape, or along gravity's branch.
        let mut level = match previous {
            Some(previous) => {
                let chain = self.chain(n);
                self.settle(&chain, warm_start(&chain, previous), self.tolerance(n, n))
            }
            None => self.end_of_branch(coarse, most, n),
        };
        if let Branch::Lowest { starts, seed } = self.options.branch {
            let chain = self.chain(level.elements);
            level = self.lowest(&chain, level, starts, seed);
        }
        // 2. Doubled to as many as are wanted.
        while level.elements < n {
            let next = (2 * level.elements).min(n);
            level = self.carried(&level, next, self.tolerance(next, n));
        }
        level
    }

    /// Relative gradient at a division on the way to `last` elements: a start needs no more.
    fn tolerance(&self, elements: usize, last: usize) -> f64 {
        let tolerance = self.options.tolerance;
        if elements < last { tolerance.max(ON_THE_WAY) } else { tolerance }
    }

    fn settle(&self, chain: &Chain<'_>, start: Shape, tolerance: f64) -> Level {
        let problem = Problem::new(chain, self.external);
        let minimum = self.newton().minimise(&problem, start, self.stopping(tolerance));
        let energy = problem.energy(&minimum.shape);
        Level { elements: chain.len(), minimum, energy, least: OnceCell::new() }
    }

    /// Carries a level to another number of elements by its internal moments, and settles it there.
    fn carried(&self, level: &Level, elements: usize, tolerance: f64) -> Level {
        // 1. By the internal moments, which vary slowly where strains turn with the curl.
        let (from, to) = (self.chain(level.elements), self.chain(elements));
        let moments = from.moments(&level.minimum.shape);
        let h = self.rod.length() / level.elements as f64;
        let start = to.shape_with_moments(|s| {
            // Moments belong to the middles of elements; the free end has none.
            let x = s / h - 0.5;
            let i = x.floor();
            let at = |i: f64| match i {
                // Beyond the first middle the line through the first two; beyond the last the mirror image that makes
                // the moment vanish at the tip.
                i if i < 0.0 => moments[0] * 2.0 - moments[1.min(moments.len() - 1)],
                i => moments.get(i as usize).copied().unwrap_or(-moments[moments.len() - 1]),
            };
            at(i).lerp(at(i + 1.0), x - i)
        });
        // 2. Moments amplify small turns of the frame where one stiffness is many times the other;
        // frames are rougher, but never far off.
        let energy = Problem::new(&to, self.external).energy(&start).total();
        let start = if energy <= level.energy.total() + MOST_GAIN * level.energy.elastic {
            start
        } else {
            let frame = |&s: &f64| from.point(&level.minimum.shape, s).1;
            to.shape_through(&to.arc().iter().map(frame).collect::<Vec<_>>())
        };
        // 3. Near a loss of stability the shape is as far off as the gradient over a small eigenvalue.
        // Contact has kinks, at which rounding would be waited for in vain.
        let near = !level.minimum.clear && self.external.is_empty();
        let tolerance = if near { tolerance.min(NEAR_A_THRESHOLD) } else { tolerance };
        let mut next = self.settle(&to, start, tolerance);
        next.minimum.iterations += level.minimum.iterations;
        // 4. Divisions are compared on the same side of the root.
        if self.may_turn(level) && self.may_turn(&next) {
            next.minimum.shape = turned_towards(&to, &next.minimum.shape, &level.minimum.shape);
        }
        next
    }

    /// The end of gravity's branch with `few` elements, or with more, up to `most`, where the branch comes near a loss of
    /// stability: it may end, or go on, only because the elements are few. `last` are those that are wanted in the end.
    fn end_of_branch(&self, few: usize, most: usize, last: usize) -> Level {
        let follow = |n| self.follow_gravity(&self.chain(n), self.tolerance(n, last));
        let Followed { level, clear } = follow(few);
        // In contact hair snaps from one minimum to the next with any division.
        if clear || few >= most || !self.external.is_empty() {
            return level;
        }
        let more = self.elements_near_a_loss(few, most);
        let again = follow(more).level;
        let same = self.carried(&level, more, self.tolerance(more, last));
        let gap = largest_gap(&again.minimum.shape.positions, &same.minimum.shape.positions);
        let iterations = again.minimum.iterations + same.minimum.iterations;
        // The same equilibrium is refined from few elements, which is cheaper.
        let mut end = if gap <= SAME_LINE * self.rod.length() { level } else { again };
        end.minimum.iterations = iterations;
        end
    }

    /// Relative gradient of a shape at a part of the weight.
    fn part_tolerance(&self, load: f64) -> f64 {
        // Moments of the body are not a part of their own.
        if !self.external.is_empty() {
            return PART_OF_THE_WEIGHT;
        }
        // At a small part the gradient would be within that of the whole weight without any step.
        let heaviness = self.rod.heaviness();
        PART_OF_THE_WEIGHT * (1.0 + load * heaviness) / (1.0 + heaviness)
    }

    /// Turns gravity on slowly from the natural shape. A step that jumps is halved, so that the
    /// branch is left only where it ends.
    fn follow_gravity(&self, chain: &Chain<'_>, last: f64) -> Followed {
        let settle = |load: f64, start: Shape, exact: bool| {
            let stopping = match load {
                l if l < 1.0 => self.stopping_on_the_way(l, last, exact),
                _ => self.stopping(last),
            };
            let problem = Problem::with_load(chain, self.external, load);
            self.newton().minimise(&problem, start, stopping)
        };
        let most_halvings = if self.external.is_empty() { HALVINGS } else { HALVINGS_IN_CONTACT };
        // 1. Without weight; external potentials can act even then.
        let mut iterations = 0;
        let mut shape = chain.natural_shape();
        if !self.external.is_empty() {
            let first = settle(0.0, shape, false);
            (shape, iterations) = (first.shape, first.iterations);
        }
        // 2. Steps of equal ratio, the last of which is the whole weight.
        let mut load = 0.0;
        // The least load known to be a jump away.
        let mut jump = f64::INFINITY;
        let mut halvings = 0;
        let (mut clear, mut forking) = (true, false);
        loop {
            // 3. The next load.
            let least = if forking { FORK_FACTOR } else { SMALLEST_FACTOR };
            let next = next_load(load, self.schedule(), jump, least);
            let halve = load > 0.0 && next < jump && halvings < most_halvings;
            // 4. What is known to be ahead is passed if the start is on a ridge: no way down is needed to tell.
            let fork = load > 0.0 && self.external.is_empty();
            let halve_at_fork = halve && next > FORK_FACTOR * load;
            if forking && halve_at_fork && on_ridge(chain, next, &shape) {
                (jump, halvings) = (next, halvings + 1);
                continue;
            }
            let mut minimum = settle(next, shape.clone(), forking);
            iterations += minimum.iterations;
            // Steps around a fork are near it only because they are small.
            clear &= minimum.clear || forking;
            // 5. A jump, or a way down from a ridge: the same step again, smaller.
            let jumped = self.jumped(&shape, &minimum.shape);
            if (halve || forking) && jumped {
                (jump, halvings, clear, forking) = (next, halvings + 1, false, false);
                continue;
            }
            let sides = |s, exact| settle(next, s, exact);
            if fork
                && !jumped
                && minimum.crossed
                && let Some(other) = other_side(chain, &shape, &minimum, sides)
                && !self.jumped(&shape, &other.shape)
            {
                iterations += other.iterations;
                if halve_at_fork {
                    if !forking {
                        let exact = settle(load, shape, true);
                        (shape, iterations) = (exact.shape, iterations + exact.iterations);
                    }
                    (jump, halvings, forking) = (next, halvings + 1, true);
                    continue;
                }
                // What is left is a fork to two sides that are alike but for little.
                minimum = lower_side(chain, next, minimum, other);
            }
            if next >= 1.0 {
                minimum.iterations = iterations;
                let energy = Problem::new(chain, self.external).energy(&minimum.shape);
                let elements = chain.len();
                let level = Level { elements, minimum, energy, least: OnceCell::new() };
                return Followed { level, clear };
            }
            if next >= jump {
                (jump, forking) = (f64::INFINITY, false);
            }
            (shape, load) = (minimum.shape, next);
        }
    }

    /// What is only on the way need not be exact, but where a small imperfection tells the side.
    fn stopping_on_the_way(&self, load: f64, last: f64, exact: bool) -> StoppingCriteria {
        StoppingCriteria {
            tolerance: if exact { NEAR_A_FORK } else { last.max(self.part_tolerance(load)) },
            max_iterations: self.options.max_iterations.div_ceil(4),
        }
    }

    /// The first part of the weight, and the factor from each step to the next.
    fn schedule(&self) -> (f64, f64) {
        // The first load has Γ = 2.5; 1e-300 stands for no weight, which is one step.
        let first = (GRAVITY_FACTOR / self.rod.heaviness().max(1e-300)).min(1.0);
        let steps = (-first.ln() / GRAVITY_FACTOR.ln()).round().max(1.0);
        // The factor nearest to 2.5 with a whole number of steps: first · factor^steps = 1.
        let factor = first.powf(-1.0 / steps);
        (first, factor)
    }

    /// Whether some tangent turned too far for one step along a branch.
    fn jumped(&self, from: &Shape, to: &Shape) -> bool {
        from.frames
            .iter()
            .zip(&to.frames)
            .any(|(a, b)| a.z_axis.dot(b.z_axis) < LARGEST_TURN_COSINE)
    }

    /// The lowest of a level and of those found from random shapes.
    fn lowest(&self, chain: &Chain<'_>, first: Level, starts: u32, seed: u64) -> Level {
        let mut best = first;
        let mut random = SplitMix64(seed);
        for _ in 0..starts {
            let natural = chain.natural_shape().controls;
            let amplitude = RANDOM_TURN / (chain.len() as f64).sqrt();
            let controls = natural.into_iter().map(|c| c + random.cube() * amplitude).collect();
            let mut level = self.settle(chain, chain.shape(controls), self.options.tolerance);
            level.minimum.iterations += best.minimum.iterations;
            if level.minimum.stability == Stability::Stable
                && level.energy.total()
                    < best.energy.total() - SAME_ENERGY * best.energy.total().abs()
            {
                best = level;
            } else {
                best.minimum.iterations = level.minimum.iterations;
            }
        }
        best
    }

    /// Whether the shape of a level turns about the tangent of its root at no cost.
    fn may_turn(&self, level: &Level) -> bool {
        let chain = self.chain(level.elements);
        // Where it does, no eigenvalue is clearly positive.
        !level.minimum.clear
            && turns_freely(&Problem::new(&chain, self.external), &level.minimum.shape)
    }

    fn with_elements(&self, level: Level) -> Equilibrium {
        let energy = level.energy;
        if !self.options.estimate_error {
            let verdict = self.verdict_of_division(&level);
            return self.equilibrium(level, verdict, energy, None, None);
        }
        let finer = self.carried(&level, 2 * level.elements, self.options.tolerance);
        let estimate = self.error_of_division(&level, &finer);
        let mut verdict = self.verdict(level.minimum.stability, None, &level, &finer);
        // What its elements leave out, which the finer division may leave out, too.
        let left_out = self.left_out(level.elements) * verdict.softness();
        let estimate = estimate + left_out;
        // Divisions that are too coarse for the curl say nothing of it, even where they agree.
        if verdict.stability == Stability::Stable && !follows_curl(self.rod, level.elements) {
            verdict.stability = Stability::Undecided;
        }
        self.equilibrium(level, verdict, energy, None, Some(estimate))
    }

    /// Error (m) of a division, from one with twice as many elements.
    fn error_of_division(&self, level: &Level, finer: &Level) -> f64 {
        // Its nodes are those of the coarser one and their middles.
        let gap = |coarse: &Level, fine: &Level| {
            let (chain, arc) =
                (self.chain(coarse.elements), self.chain(fine.elements).arc().to_vec());
            let line: Vec<DVec3> =
                arc.iter().map(|&s| chain.point(&coarse.minimum.shape, s).0).collect();
            largest_gap(&fine.minimum.shape.positions, &line)
        };
        let first = gap(level, finer);
        // Second order: each gap is a quarter of the one before; a third is the cautious reading, with which all of them are 3/2 of the first.
        if level.minimum.clear && finer.minimum.clear && level.elements >= ASYMPTOTIC {
            return first / (1.0 - CAUTIOUS);
        }
        // With few elements and near a loss of stability they decrease more slowly: as long as they do, by the ratio of the first two.
        let finest = self.carried(finer, 2 * finer.elements, self.options.tolerance);
        let second = gap(finer, &finest);
        let ratio = (second / first.max(f64::MIN_POSITIVE)).clamp(CAUTIOUS, SLOWEST);
        first + second.max(CAUTIOUS * first) / (1.0 - ratio)
    }

    /// Doubles the elements until two extrapolations agree and the stability is known.
    fn refine(&self, first: Level, accuracy: f64) -> Equilibrium {
        let few = first.elements;
        let found = self.refine_from(first, accuracy);
        // Doublings of the first division end below the most elements; those of an eighth of the most end there.
        let eighth = self.most_elements() / 8;
        let missed = found.certificate.accuracy == AccuracyStatus::Missed;
        if !missed || 8 * eighth <= found.elements || eighth < few {
            return found;
        }
        let chain = self.chain(eighth);
        let most = self.settle(&chain, warm_start(&chain, &found), self.options.tolerance);
        let finest = self.refine_from(most, accuracy);
        let error = |of: &Equilibrium| of.error_estimate.unwrap_or(f64::INFINITY);
        if error(&finest) < error(&found) { finest } else { found }
    }

    /// [`Self::refine`] by doublings of one division alone.
    fn refine_from(&self, first: Level, accuracy: f64) -> Equilibrium {
        if 2 * first.elements > self.most_elements() {
            return self.with_elements(first);
        }
        let (mut before, mut level): (Option<Level>, Level) = (None, first);
        let mut previous: Option<Vec<DVec3>> = None;
        let mut last_gap: Option<f64> = None;
        loop {
            let finer = self.carried(&level, 2 * level.elements, self.options.tolerance);
            // Fourth order at all nodes.
            let line = extrapolate(&level.minimum.shape, &finer.minimum.shape);
            let gap = previous.as_ref().map(|p| largest_gap(&every(&line, 2), p));
            let h = self.rod.length() / level.elements as f64;
            let left_out = self.left_out(level.elements);
            let gaps = [std::mem::replace(&mut last_gap, gap), gap];
            let estimate = |softness| self.estimate(gaps, h, left_out * softness, softness);
            let met = estimate(1.0).is_some_and(|e| e <= accuracy);
            let last = 2 * finer.elements > self.most_elements();
            if met || last {
                let verdict =
                    self.verdict(finer.minimum.stability, before.as_ref(), &level, &finer);
                let estimate = estimate(verdict.softness());
                let met = estimate.is_some_and(|e| e <= accuracy);
                let fine = || every(&finer.minimum.shape.positions, 2);
                let raw = || largest_gap(&fine(), &level.minimum.shape.positions);
                // What does not converge must not be extrapolated: two extrapolations that are nearer to each other than the divisions do.
                let converges = || estimate.is_some_and(|e| e <= CONVERGING * (raw() + left_out));
                if met && (last || !verdict.refinable) || last && converges() {
                    let correction = corrections(&level.minimum.shape, &finer.minimum.shape);
                    let energy = extrapolate_energy(&level.energy, &finer.energy);
                    return self.equilibrium(finer, verdict, energy, Some(correction), estimate);
                }
                if last {
                    let estimate = raw() + left_out * verdict.softness();
                    let energy = finer.energy;
                    return self.equilibrium(finer, verdict, energy, None, Some(estimate));
                }
            }
            (before, level, previous) = (Some(level), finer, Some(line));
        }
    }

    /// Error (m) of an extrapolated line, from the gaps between two successive ones, now and before; with elements of the length `h`,
    /// which leave out so much (m).
    fn estimate(
        &self,
        [before, gap]: [Option<f64>; 2],
        h: f64,
        left_out: f64,
        softness: f64,
    ) -> Option<f64> {
        let gap = gap?;
        let with_before =
            |share: f64| before.map_or(f64::INFINITY, |before| gap.max(share * before));
        let of_gaps = match self.rod.natural() {
            // In a single soft direction two extrapolations agree by chance.
            NaturalStrain::Varying(_) if softness > SOFT => with_before(0.5),
            // Second order at best, with a factor that depends on where in an element the jump is.
            // One gap alone says little: of 660 random hairs two were off by 1.7 and 2.4 times what was asked.
            natural if natural.jumps_within(h, self.rod.length()) => with_before(0.25),
            // Third order at best, for the same reason: the strain has kinks.
            NaturalStrain::Varying(_) => 0.5 * gap,
            // Fourth order leaves a fifteenth of the gap; a quarter is the cautious reading.
            NaturalStrain::Uniform(_) => 0.25 * gap,
        };
        Some(left_out + of_gaps)
    }

    /// The stability of the exact rod, from two divisions or three; `division` is that of the one that is returned.
    fn verdict(
        &self,
        division: Stability,
        before: Option<&Level>,
        coarse: &Level,
        fine: &Level,
    ) -> Verdict {
        let converged = [coarse, fine].map(|l| l.minimum.stability != Stability::NotConverged);
        if converged != [true; 2] {
            return Verdict { stability: division, least: None, refinable: false, resolved: false };
        }
        // 1. Far from a loss of stability no eigenvalue is needed.
        let clear = coarse.minimum.clear && fine.minimum.clear;
        if clear && !self.options.eigenvalue {
            return Verdict { stability: division, least: None, refinable: false, resolved: true };
        }
        // 2. The eigenvalue of the exact rod.
        let rounding =
            [coarse, fine].map(|level| self.rounding(level)).into_iter().fold(0.0, f64::max);
        let [of_coarse, of_fine] = [coarse, fine].map(|level| self.least(level));
        let free = self.may_turn(coarse) && self.may_turn(fine);
        if free && of_coarse.abs().max(of_fine.abs()) <= rounding {
            let least = Some(LeastEigenvalue::neutral(rounding));
            let resolved = self.lean_is_resolved(coarse, fine);
            return Verdict { stability: division, least, refinable: !resolved, resolved };
        }
        let before = before.map(|level| self.least(level));
        let least = LeastEigenvalue::extrapolated(before, of_coarse, of_fine, rounding);
        // Two divisions that are far from a loss of stability may not agree on how far.
        let clear = clear && least.value > 0.0;
        let stability = if clear { division } else { least.stability() };
        // 3. A finer division tells more, or falls off a shape that is stable with these elements alone.
        let resolved = clear || least.is_resolved();
        let refinable = match stability {
            Stability::Undecided => least.is_refinable(),
            Stability::Stable if !resolved => least.is_resolvable(),
            told => told != division,
        };
        Verdict { stability, least: Some(least), refinable, resolved }
    }

    /// Whether two divisions lean alike, of a rod that may turn about its root's tangent at no cost. The eigenvalue of that is zero; that of
    /// the lean is near zero just beyond the loss of stability of the upright rod, where the lean grows as the square root.
    fn lean_is_resolved(&self, coarse: &Level, fine: &Level) -> bool {
        let root = &self.rod.spec().root;
        let (origin, axis) = (root.position(), root.frame().z_axis);
        let from_axis = |p: &DVec3| (*p - origin).reject_from_normalized(axis).length();
        let positions = &fine.minimum.shape.positions;
        let lean = positions.iter().map(from_axis).fold(0.0, f64::max);
        let gap = largest_gap(&every(positions, 2), &coarse.minimum.shape.positions);
        gap <= LEAN_RESOLVED * lean
    }

    /// What one division says of itself.
    fn verdict_of_division(&self, level: &Level) -> Verdict {
        let stability = level.minimum.stability;
        let converged = stability != Stability::NotConverged;
        let least = (converged && self.options.eigenvalue).then(|| {
            let (least, rounding) = (self.least(level), self.rounding(level));
            // A direction that costs nothing, as round the vertical for a round straight hair, is
            // zero only to rounding.
            let least = if stability == Stability::Stable { least.max(0.0) } else { least };
            LeastEigenvalue::extrapolated(None, least, least, rounding)
        });
        Verdict { stability, least, refinable: false, resolved: true }
    }

    /// Smallest eigenvalue of a division.
    fn least(&self, level: &Level) -> f64 {
        *level.least.get_or_init(|| {
            let chain = self.chain(level.elements);
            Problem::new(&chain, self.external).min_eigenvalue(&level.minimum.shape)
        })
    }

    /// The eigenvalue of a division that is zero but for rounding.
    fn rounding(&self, level: &Level) -> f64 {
        let chain = self.chain(level.elements);
        Problem::new(&chain, self.external).neutral_eigenvalue(level.minimum.gradient_norm)
    }

    /// Whether an estimate of the error (m) is within the requested accuracy.
    fn accuracy(&self, verdict: &Verdict, estimate: Option<f64>) -> AccuracyStatus {
        let Resolution::Accuracy(accuracy) = self.options.resolution else {
            return AccuracyStatus::NotRequested;
        };
        // A shape that is not known to be stable may be far from the one at rest, however alike two divisions are.
        let known = verdict.stability == Stability::Stable && verdict.resolved;
        let met = known && estimate.is_some_and(|e| e <= accuracy);
        if met { AccuracyStatus::Met } else { AccuracyStatus::Missed }
    }

    fn equilibrium(
        &self,
        level: Level,
        verdict: Verdict,
        energy: Energy,
        correction: Option<Vec<Correction>>,
        error_estimate: Option<f64>,
    ) -> Equilibrium {
        let Minimum { shape, gradient_norm, iterations, .. } = level.minimum;
        // Divisions may agree better than each of them is at rest.
        let unsettled = UNSETTLED * gradient_norm * self.rod.length();
        let error_estimate = error_estimate.map(|estimate| estimate + unsettled);
        let (stability, accuracy) = (verdict.stability, self.accuracy(&verdict, error_estimate));
        // There is no one line to be near to; two divisions that are both upright, of a hair that leans, do not differ.
        let known = stability == Stability::Stable && verdict.resolved;
        let error_estimate = error_estimate.filter(|_| known);
        let least = verdict.least.filter(|_| self.options.eigenvalue);
        Equilibrium {
            rod: self.rod.clone(),
            element: self.kind,
            elements: level.elements,
            shape,
            energy,
            certificate: Certificate {
                gradient_norm,
                min_eigenvalue: least.map(|least| least.value),
                eigenvalue_error: least.map(|least| least.error),
                stability,
                iterations,
                accuracy,
            },
            error_estimate,
            correction,
        }
    }
}

/// The load after one: the next step of a schedule of a first load and a factor, or half the way (by logarithm) to a known jump, as long as that
/// is by more than a factor.
fn next_load(load: f64, (first, factor): (f64, f64), jump: f64, least: f64) -> f64 {
    let step = match load {
        l if l <= 0.0 => first,
        // But for rounding.
        l if l * factor * factor.sqrt() >= 1.0 && jump > 1.0 => 1.0,
        l if l * factor < jump => l * factor,
        l if jump / l > least => (l * jump).sqrt(),
        _ => jump,
    };
    step.min(1.0)
}
