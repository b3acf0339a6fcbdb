//! The shape in which a rod comes to rest, with a certificate.

use glam::{DMat3, DQuat, DVec3};

use crate::chain::{Chain, Shape};
use crate::minimise::{
    Energy, Minimiser, Minimum, Newton, Problem, Stability, StoppingCriteria, second_variation,
};
use crate::potential::Potential;
use crate::rotation::deviation;
use crate::{ElementKind, MAX_ELEMENTS, Resolution, Rod};

/// Which equilibrium is meant, where there are several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Branch {
    /// The one reached from the natural shape as gravity is turned on slowly. Where that branch
    /// loses stability the rod falls off it, as a hair would.
    #[default]
    Gravity,
    /// The lowest of that one and of those found from random shapes.
    Lowest {
        /// Number of random starts.
        starts: u32,
        /// Seed of the random starts.
        seed: u64,
    },
}

/// How an equilibrium is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Number of elements, or accuracy.
    pub resolution: Resolution,
    /// Most elements to meet an accuracy with, at least 1 and at most [`MAX_ELEMENTS`].
    pub max_elements: usize,
    /// Curve of the elements.
    pub element: ElementKind,
    /// Which equilibrium.
    pub branch: Branch,
    /// Relative gradient at which a shape is an equilibrium, see [`Problem::gradient_norm`].
    pub tolerance: f64,
    /// Most iterations at each division of the rod; a quarter of it at each step of gravity.
    pub max_iterations: usize,
    /// Whether to estimate the error for a given number of elements, by doubling them.
    pub estimate_error: bool,
    /// Whether to compute the smallest eigenvalue of the second variation. Stability is known
    /// without it.
    pub eigenvalue: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            resolution: Resolution::Accuracy(1e-4),
            max_elements: MAX_ELEMENTS,
            element: ElementKind::Auto,
            branch: Branch::Gravity,
            tolerance: 1e-10,
            max_iterations: 500,
            estimate_error: true,
            eigenvalue: true,
        }
    }
}

/// What vouches for an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Relative gradient, see [`Problem::gradient_norm`].
    pub gradient_norm: f64,
    /// Smallest λ in `H x = λ M x`, H the second variation of the energy and M that of the elastic
    /// energy: 1 without loads, 0 where stability is lost. `None` if it was not asked for.
    pub min_eigenvalue: Option<f64>,
    /// Minimum, saddle or neither.
    pub stability: Stability,
    /// Iterations of the minimiser in all.
    pub iterations: usize,
}

/// A rod at rest.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// The rod.
    pub rod: Rod,
    /// Curve of the elements, never [`ElementKind::Auto`].
    pub element: ElementKind,
    /// Number of elements of the finest division.
    pub elements: usize,
    /// Shape of the finest division.
    pub shape: Shape,
    /// Energies, extrapolated where the shape is.
    pub energy: Energy,
    /// What vouches for it.
    pub certificate: Certificate,
    /// Estimate of the largest distance (m) of the centre line from the exact equilibrium.
    pub error_estimate: Option<f64>,
    /// What extrapolation adds to every second node.
    correction: Option<Vec<Correction>>,
}

impl Equilibrium {
    /// What a minimiser found, as it is: not extrapolated, its error not estimated.
    #[must_use]
    pub fn from_minimum(problem: &Problem<'_>, minimum: Minimum) -> Self {
        let chain = problem.chain();
        let energy = problem.energy(&minimum.shape);
        let Minimum { shape, gradient_norm, iterations, stability } = minimum;
        Self {
            rod: chain.rod().clone(),
            element: chain.kind(),
            elements: chain.len(),
            shape,
            energy,
            certificate: Certificate { gradient_norm, min_eigenvalue: None, stability, iterations },
            error_estimate: None,
            correction: None,
        }
    }

    /// The divided rod whose shape [`Self::shape`] is.
    #[must_use]
    pub fn chain(&self) -> Chain<'_> {
        Chain::uniform(&self.rod, self.element, self.elements)
    }

    /// Position of the tip (m).
    #[must_use]
    pub fn tip(&self) -> DVec3 {
        self.node(self.elements)
    }

    fn node(&self, i: usize) -> DVec3 {
        self.shape.positions[i] + self.correction_at(i as f64).0
    }

    /// What extrapolation adds to the position (m), and the rotation vector (rad, world) by which
    /// it turns the frame.
    fn correction_at(&self, node: f64) -> (DVec3, DVec3) {
        let Some(table) = &self.correction else { return (DVec3::ZERO, DVec3::ZERO) };
        let last = table.len() - 1;
        let x = (0.5 * node).clamp(0.0, last as f64);
        let i = (x as usize).min(last.saturating_sub(1));
        let (from, to) = (&table[i], &table[(i + 1).min(last)]);
        let x = x - i as f64;
        let step = self.rod.length() / last as f64;
        // Hermite: cubic, with the slopes at both ends.
        let (rise, y) = (x * x * (3.0 - 2.0 * x), 1.0 - x);
        let bends = (from.slope * y - to.slope * x) * (x * y * step);
        (from.shift.lerp(to.shift, rise) + bends, from.turn.lerp(to.turn, x))
    }

    /// `points` positions (m) and material frames, evenly spaced in arc length from root to tip;
    /// at least two.
    #[must_use]
    pub fn sample(&self, points: usize) -> Vec<(DVec3, DMat3)> {
        let n = points.max(2);
        let chain = self.chain();
        (0..n).map(|k| self.at(&chain, k as f64 / (n - 1) as f64)).collect()
    }

    /// Position (m) and material frame at a part of the arc length, 0 (root) to 1 (tip), of the
    /// [`Self::chain`].
    #[must_use]
    pub fn at(&self, chain: &Chain<'_>, x: f64) -> (DVec3, DMat3) {
        let (position, frame) = chain.point(&self.shape, x * self.rod.length());
        let (shift, turn) = self.correction_at(x * self.elements as f64);
        (position + shift, DMat3::from_quat(DQuat::from_scaled_axis(turn)) * frame)
    }

    /// The centre line as `points` positions (m), evenly spaced in arc length; at least two.
    #[must_use]
    pub fn centre_line(&self, points: usize) -> Vec<DVec3> {
        self.sample(points).into_iter().map(|(position, _)| position).collect()
    }
}

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
#[must_use]
pub fn equilibrium_from(
    rod: &Rod,
    external: &[&dyn Potential],
    options: &Options,
    previous: &Equilibrium,
) -> Equilibrium {
    Search { rod, external, options, kind: options.element.chosen_for(rod) }.run(Some(previous))
}

/// What Richardson extrapolation adds to a node.
#[derive(Clone, Copy, Debug)]
struct Correction {
    /// To the position (m).
    shift: DVec3,
    /// To the tangent, which is the derivative of the shift by arc length.
    slope: DVec3,
    /// To the frame: a rotation vector (rad) in the world.
    turn: DVec3,
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
}

/// Factor on gravity from one step of the branch to the next. A hanging rod's shape changes with
/// the logarithm of its heaviness.
const GRAVITY_FACTOR: f64 = 2.5;

/// A jump that a step as small as this still makes is the rod's own.
const SMALLEST_FACTOR: f64 = 1.02;

/// Most steps taken again; a rod that jumps more often is far outside of hair.
const HALVINGS: usize = 60;

/// The same with other potentials, where hair slips from one resting place to the next.
const HALVINGS_IN_CONTACT: usize = 6;

/// A step along the branch that turns a tangent further than this (cosine) is taken again, smaller.
const LARGEST_TURN_COSINE: f64 = 0.3;

impl Search<'_> {
    fn run(&self, previous: Option<&Equilibrium>) -> Equilibrium {
        let coarse = self.kind.resolving_elements(self.rod);
        match self.options.resolution {
            Resolution::Elements(n) => {
                let level = self.level(n.clamp(1, MAX_ELEMENTS), coarse, previous);
                self.with_elements(level)
            }
            Resolution::Accuracy(accuracy) => {
                let first = coarse.min(self.most_elements());
                self.refine(self.level(first, first, previous), accuracy)
            }
        }
    }

    fn chain(&self, elements: usize) -> Chain<'_> {
        Chain::uniform(self.rod, self.kind, elements)
    }

    fn stopping(&self, tolerance: f64) -> StoppingCriteria {
        StoppingCriteria { tolerance, max_iterations: self.options.max_iterations }
    }

    fn most_elements(&self) -> usize {
        self.options.max_elements.clamp(1, MAX_ELEMENTS)
    }

    /// The equilibrium with `n` elements. The branch is followed with few, then refined; a shape
    /// that is nearly right already is settled at once.
    fn level(&self, n: usize, coarse: usize, previous: Option<&Equilibrium>) -> Level {
        let first = if previous.is_some() { n } else { n.min(coarse) };
        let chain = self.chain(first);
        let tolerance = self.tolerance(first, n);
        let mut level = match previous {
            Some(previous) => self.settle(&chain, warm_start(&chain, previous), tolerance),
            None => self.follow_gravity(&chain, tolerance),
        };
        if let Branch::Lowest { starts, seed } = self.options.branch {
            level = self.lowest(&chain, level, starts, seed);
        }
        while level.elements < n {
            let next = (2 * level.elements).min(n);
            level = self.finer(&level, next, self.tolerance(next, n));
        }
        level
    }

    /// Relative gradient at a division on the way to `last` elements: a start needs no more.
    fn tolerance(&self, elements: usize, last: usize) -> f64 {
        let tolerance = self.options.tolerance;
        if elements < last { tolerance.max(1e-4) } else { tolerance }
    }

    fn settle(&self, chain: &Chain<'_>, start: Shape, tolerance: f64) -> Level {
        let problem = Problem::new(chain, self.external);
        let minimum = Newton::default().minimise(&problem, start, self.stopping(tolerance));
        let energy = problem.energy(&minimum.shape);
        Level { elements: chain.len(), minimum, energy }
    }

    /// Carries a level to more elements by its internal moments, and settles it there.
    fn finer(&self, level: &Level, elements: usize, tolerance: f64) -> Level {
        let (from, to) = (self.chain(level.elements), self.chain(elements));
        let moments = from.moments(&level.minimum.shape);
        let h = self.rod.length() / level.elements as f64;
        let start = to.shape_with_moments(|s| {
            // Moments belong to the middles of elements; the free end has none.
            let x = s / h - 0.5;
            let i = x.floor();
            let at = |i: f64| match i {
                i if i < 0.0 => moments[0] * 2.0 - moments[1.min(moments.len() - 1)],
                i => moments.get(i as usize).copied().unwrap_or(-moments[moments.len() - 1]),
            };
            at(i).lerp(at(i + 1.0), x - i)
        });
        // Moments amplify small turns of the frame where one stiffness is many times the other;
        // frames are rougher, but never far off.
        let energy = Problem::new(&to, self.external).energy(&start).total();
        let start = if energy <= level.energy.total() + 0.1 * level.energy.elastic {
            start
        } else {
            let frame = |&s: &f64| from.point(&level.minimum.shape, s).1;
            to.shape_through(&to.arc().iter().map(frame).collect::<Vec<_>>())
        };
        let mut next = self.settle(&to, start, tolerance);
        next.minimum.iterations += level.minimum.iterations;
        next
    }

    /// Turns gravity on slowly from the natural shape. A step that jumps is halved, so that the
    /// branch is left only where it ends.
    fn follow_gravity(&self, chain: &Chain<'_>, last: f64) -> Level {
        let settle = |load: f64, start: Shape| {
            let problem = Problem::with_load(chain, self.external, load);
            // What is only on the way need not be exact.
            let stopping = match load {
                l if l < 1.0 => StoppingCriteria {
                    tolerance: last.max(1e-3),
                    max_iterations: self.options.max_iterations.div_ceil(4),
                },
                _ => self.stopping(last),
            };
            Newton::default().minimise(&problem, start, stopping)
        };
        let most_halvings = if self.external.is_empty() { HALVINGS } else { HALVINGS_IN_CONTACT };
        let mut iterations = 0;
        let mut shape = chain.natural_shape();
        if !self.external.is_empty() {
            let first = settle(0.0, shape);
            (shape, iterations) = (first.shape, first.iterations);
        }
        // Steps of equal ratio, the last of which is the whole weight.
        let first = (GRAVITY_FACTOR / self.rod.heaviness().max(1e-300)).min(1.0);
        let steps = (-first.ln() / GRAVITY_FACTOR.ln()).round().max(1.0);
        let factor = first.powf(-1.0 / steps);
        let mut load = 0.0;
        // The least load known to be a jump away.
        let mut jump = f64::INFINITY;
        let mut halvings = 0;
        loop {
            let step = match load {
                l if l <= 0.0 => first,
                // But for rounding.
                l if l * factor * factor.sqrt() >= 1.0 && jump > 1.0 => 1.0,
                l if l * factor < jump => l * factor,
                l if jump / l > SMALLEST_FACTOR => (l * jump).sqrt(),
                _ => jump,
            };
            let next = step.min(1.0);
            let mut minimum = settle(next, shape.clone());
            iterations += minimum.iterations;
            let halve = load > 0.0 && next < jump && halvings < most_halvings;
            if halve && self.jumped(&shape, &minimum.shape) {
                (jump, halvings) = (next, halvings + 1);
                continue;
            }
            if next >= 1.0 {
                minimum.iterations = iterations;
                let energy = Problem::new(chain, self.external).energy(&minimum.shape);
                return Level { elements: chain.len(), minimum, energy };
            }
            if next >= jump {
                jump = f64::INFINITY;
            }
            (shape, load) = (minimum.shape, next);
        }
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
        let mut random = SplitMix(seed);
        for _ in 0..starts {
            let natural = chain.natural_shape().controls;
            let amplitude = 4.0 / (chain.len() as f64).sqrt();
            let controls = natural.into_iter().map(|c| c + random.vector() * amplitude).collect();
            let mut level = self.settle(chain, chain.shape(controls), self.options.tolerance);
            level.minimum.iterations += best.minimum.iterations;
            if level.minimum.stability == Stability::Stable
                && level.energy.total() < best.energy.total() - 1e-9 * best.energy.total().abs()
            {
                best = level;
            } else {
                best.minimum.iterations = level.minimum.iterations;
            }
        }
        best
    }

    fn with_elements(&self, level: Level) -> Equilibrium {
        let estimate = self.options.estimate_error.then(|| {
            let finer = self.finer(&level, 2 * level.elements, self.options.tolerance);
            // Second order: the finer shape has a quarter of the error.
            let gap = every(&finer.minimum.shape.positions, 2);
            4.0 / 3.0 * largest_gap(&gap, &level.minimum.shape.positions)
        });
        let energy = level.energy;
        self.equilibrium(level, energy, None, estimate)
    }

    /// Doubles the elements until two extrapolations agree.
    fn refine(&self, first: Level, accuracy: f64) -> Equilibrium {
        if 2 * first.elements > self.most_elements() {
            return self.with_elements(first);
        }
        let mut level = first;
        let mut previous: Option<Vec<DVec3>> = None;
        loop {
            let finer = self.finer(&level, 2 * level.elements, self.options.tolerance);
            let table = extrapolate(&level.minimum.shape, &finer.minimum.shape);
            let estimate = previous.as_ref().map(|p| {
                // Fourth order leaves a fifteenth of the gap; a quarter is the cautious reading.
                0.25 * largest_gap(&every(&table, 2), p)
            });
            let met = estimate.is_some_and(|e| e <= accuracy);
            if met {
                let correction = corrections(&level.minimum.shape, &finer.minimum.shape);
                let energy = extrapolate_energy(&level.energy, &finer.energy);
                return self.equilibrium(finer, energy, Some(correction), estimate);
            }
            if 2 * finer.elements > self.most_elements() {
                // What does not converge must not be extrapolated.
                let fine = every(&finer.minimum.shape.positions, 2);
                let gap = largest_gap(&fine, &level.minimum.shape.positions);
                let energy = finer.energy;
                return self.equilibrium(finer, energy, None, Some(gap));
            }
            (level, previous) = (finer, Some(table));
        }
    }

    fn equilibrium(
        &self,
        level: Level,
        energy: Energy,
        correction: Option<Vec<Correction>>,
        error_estimate: Option<f64>,
    ) -> Equilibrium {
        let Minimum { shape, gradient_norm, iterations, stability } = level.minimum;
        let min_eigenvalue = self.options.eigenvalue.then(|| {
            let chain = self.chain(level.elements);
            let least = second_variation(&Problem::new(&chain, self.external), &shape);
            // A direction that costs nothing, as round the vertical for a round straight hair, is
            // zero only to rounding.
            if stability == Stability::Stable { least.max(0.0) } else { least }
        });
        Equilibrium {
            rod: self.rod.clone(),
            element: self.kind,
            elements: level.elements,
            shape,
            energy,
            certificate: Certificate { gradient_norm, min_eigenvalue, stability, iterations },
            error_estimate,
            correction,
        }
    }
}

fn every(points: &[DVec3], step: usize) -> Vec<DVec3> {
    points.iter().step_by(step).copied().collect()
}

fn largest_gap(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// Richardson extrapolation of second order at the nodes of the coarse shape:
/// `(4 r_2N − r_N) / 3`.
fn extrapolate(coarse: &Shape, fine: &Shape) -> Vec<DVec3> {
    let fine = fine.positions.iter().step_by(2);
    coarse.positions.iter().zip(fine).map(|(c, f)| (*f * 4.0 - *c) / 3.0).collect()
}

/// What extrapolation adds to the fine shape at the nodes of the coarse one.
fn corrections(coarse: &Shape, fine: &Shape) -> Vec<Correction> {
    (0..coarse.positions.len())
        .map(|i| {
            let (position, frame) = (fine.positions[2 * i], fine.frames[2 * i]);
            let turn = deviation(&(frame * coarse.frames[i].transpose())) / 3.0;
            Correction {
                shift: (position - coarse.positions[i]) / 3.0,
                slope: DQuat::from_scaled_axis(turn) * frame.z_axis - frame.z_axis,
                turn,
            }
        })
        .collect()
}

fn extrapolate_energy(coarse: &Energy, fine: &Energy) -> Energy {
    let mix = |c: f64, f: f64| (4.0 * f - c) / 3.0;
    Energy {
        elastic: mix(coarse.elastic, fine.elastic),
        gravity: mix(coarse.gravity, fine.gravity),
        external: mix(coarse.external, fine.external),
    }
}

/// The shape of another rod at rest, taken over at equal arc length; what is longer goes on as it
/// would naturally.
fn warm_start(chain: &Chain<'_>, previous: &Equilibrium) -> Shape {
    let old = previous.chain();
    let covered = previous.rod.length() * (1.0 + 1e-12);
    let known = chain.arc().iter().take_while(|&&s| s <= covered).count();
    let mut frames: Vec<DMat3> =
        chain.arc()[..known].iter().map(|&s| old.point(&previous.shape, s).1).collect();
    for i in known..=chain.len() {
        let g = chain.geometry(i - 1);
        let last = frames[i - 1];
        frames.push(last * g.motion(g.rest()).rotation());
    }
    // A root that was turned turns the whole shape with it.
    let turn = chain.rod().root().frame() * previous.rod.root().frame().transpose();
    for frame in &mut frames {
        *frame = turn * *frame;
    }
    chain.shape_through(&frames)
}

/// Steele, Lea & Flood's `SplitMix64`: a start for a minimiser needs no better.
struct SplitMix(u64);

impl SplitMix {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in the cube [−1, 1]³.
    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - DVec3::ONE
    }
}
