//! Hair after hair through the lanes: one that has come to rest makes room for the next.

use fearless_simd::{Level, Simd, SimdFrom, dispatch};
use glam::DVec3;

use super::RodSolution;
use super::hanging::Hanging;
use super::joints::Joints;
use super::lanes::{Lanes, Wide};
use super::sweep::Backward;
use super::touching::{ContactField, Frames, Touching};
use super::turn::LARGEST_SQUARE;
use crate::minimise::Stability;
use crate::{Node, Rod};

/// Damping after a first failed pivot or a step that went up, as a fraction of the stiffness; as in
/// [`crate::minimise::Newton`].
const FIRST_DAMPING: f64 = 0.3;

/// Least factor by which damping grows, and what it shrinks to after a step that was taken; below [`LEAST_DAMPING`] it
/// is none.
const GROWTH: f64 = 4.0;
const SHRINKING: f64 = 0.2;
const LEAST_DAMPING: f64 = 0.01;

/// How much more than what failed lately damping stays, what of that is left after each step that was taken, and below
/// which it is forgotten.
const ABOVE_BAD: f64 = 1.5;
const FADING: f64 = 0.25;
const FORGOTTEN: f64 = 0.05;

/// Largest factor by which damping grows at once.
const MOST_GROWTH: f64 = 16.0;

/// Damping from which on a hair is given up.
const LARGEST_DAMPING: f64 = 1e9;

/// Part of the expected decrease that a step has to reach.
const ENOUGH: f64 = 1e-4;

/// When a hair is at rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    pub(super) elements: usize,
    /// Relative gradient.
    pub(super) tolerance: f64,
    pub(super) max_iterations: usize,
}

/// How one hair ended.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct End {
    /// Whether at a minimum.
    pub(super) settled: bool,
    /// Relative gradient.
    pub(super) gradient: f64,
    pub(super) iterations: usize,
    /// Energy (J).
    pub(super) energy: f64,
}

impl End {
    pub(super) fn as_told(&self) -> RodSolution {
        RodSolution {
            stability: if self.settled { Stability::Stable } else { Stability::NotConverged },
            gradient_norm: self.gradient,
            iterations: self.iterations,
            energy: self.energy,
        }
    }
}

/// What hairs can touch, and what they start with; the first of them is hair `first` there.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub(super) contacts: &'a dyn ContactField,
    pub(super) first: usize,
    /// The frames that hairs start with; else their joints are turned as given.
    pub(super) frames: Option<Frames<'a>>,
}

/// Brings hairs to rest in double precision, from the controls that are given; these become theirs at rest.
pub(super) fn double(rods: &[Rod], rest: Rest, controls: &mut [DVec3], ends: &mut [End]) {
    dispatch!(Level::new(), simd => hanging(f64s(simd), rods, rest, controls, ends));
}

/// The same in single precision.
pub(super) fn single(rods: &[Rod], rest: Rest, controls: &mut [DVec3], ends: &mut [End]) {
    dispatch!(Level::new(), simd => hanging(f32s(simd), rods, rest, controls, ends));
}

/// The same in double precision, of hairs that can touch something.
pub(super) fn among(
    rods: &[Rod],
    rest: Rest,
    around: Around<'_>,
    controls: &mut [DVec3],
    (nodes, ends): (&mut [Node], &mut [End]),
) {
    dispatch!(
        Level::new(),
        simd => touching(f64s(simd), rods, rest, around, controls, (nodes, ends))
    );
}

#[inline(always)]
fn hanging<F: Lanes>(zero: F, rods: &[Rod], rest: Rest, controls: &mut [DVec3], ends: &mut [End]) {
    let mut sweeps = Hanging::new(zero, rest.elements, alike(rods));
    run(zero, &mut sweeps, (rods, rest), controls, ends);
}

#[inline(always)]
fn touching<F: Lanes>(
    zero: F,
    rods: &[Rod],
    rest: Rest,
    around: Around<'_>,
    controls: &mut [DVec3],
    (nodes, ends): (&mut [Node], &mut [End]),
) {
    let mut sweeps = Touching::new(zero, rest.elements, alike(rods), around, nodes);
    run(zero, &mut sweeps, (rods, rest), controls, ends);
}

/// Whether the joints of each hair turn alike.
fn alike(rods: &[Rod]) -> bool {
    rods.iter().all(|rod| matches!(rod.natural(), crate::NaturalStrain::Uniform(_)))
}

/// Hairs in lanes, of one kind.
pub(super) trait Sweeps<F: Lanes> {
    /// Puts a hair into a lane, its joints turned as given; its energy (J) but for the constant, if the lane is at
    /// that shape already.
    fn load(&mut self, lane: usize, hair: usize, joints: &Joints, start: &[DVec3]) -> Option<f64>;
    /// Makes the given shape the next trial of a lane.
    fn begin(&mut self, lane: usize);
    /// As [`super::sweep::Bundle::backward`].
    fn backward(&mut self, accepted: F::Truth, damping: F) -> Backward<F>;
    /// As [`super::sweep::Bundle::forward`].
    fn forward(&mut self) -> F;
    /// Takes a hair out of a lane: the turns of its joints (rad).
    fn save(&mut self, lane: usize, hair: usize, controls: &mut [DVec3]);
}

#[inline(always)]
fn f64s<S: Simd>(simd: S) -> Wide<S, S::f64s> {
    Wide::new(simd, S::f64s::simd_from(simd, 0.0))
}

#[inline(always)]
fn f32s<S: Simd>(simd: S) -> Wide<S, S::f32s> {
    Wide::new(simd, S::f32s::simd_from(simd, 0.0))
}

/// A lane and the hair that is in it.
#[derive(Clone, Copy)]
struct Lane {
    /// None: it is empty.
    hair: Option<usize>,
    energy: f64,
    constant: f64,
    damping: f64,
    /// The moment (N m) that gradients are measured against.
    scale: f64,
    iterations: usize,
    /// The least stiffness of a joint (N m).
    stiffness: f64,
    /// Whether a step is being tried.
    trying: bool,
    /// Damping of the last step that was taken …
    good: f64,
    /// … and of the last that was not; what that tells fades with each step that is.
    bad: f64,
    /// Whether the given shape is.
    fresh: bool,
}

const EMPTY: Lane = Lane {
    hair: None,
    energy: 0.0,
    constant: 0.0,
    damping: 0.0,
    scale: 1.0,
    iterations: 0,
    stiffness: 1.0,
    trying: false,
    good: 0.0,
    bad: 0.0,
    fresh: false,
};

impl Lane {
    /// After a step that failed, or a pivot (N m) that is negative by `lacking`: it takes that much stiffness at least,
    /// as far as damping may grow at once. Where stiffer was good before, it is enough to go half the way there.
    fn stiffen(&mut self, lacking: f64) {
        self.bad = self.damping;
        let least = FIRST_DAMPING.max(GROWTH * self.damping);
        self.damping = if self.good > 2.0 * self.damping {
            (self.good * self.damping.max(FORGOTTEN)).sqrt().max(FIRST_DAMPING)
        } else {
            let most = MOST_GROWTH * FIRST_DAMPING.max(self.damping);
            (lacking / self.stiffness).min(most).max(least)
        };
    }

    /// After a step that was taken. What was not stiff enough a step ago is not tried again at once.
    fn soften(&mut self) {
        self.good = self.damping;
        self.bad *= FADING;
        let above = if self.bad < FORGOTTEN { 0.0 } else { ABOVE_BAD * self.bad };
        let softer = (SHRINKING * self.damping).max(above);
        self.damping = if softer < LEAST_DAMPING { 0.0 } else { softer.min(self.damping) };
    }
}

/// Most lanes that any processor has.
const MOST_LANES: usize = 16;

#[inline(always)]
fn run<F: Lanes>(
    zero: F,
    sweeps: &mut impl Sweeps<F>,
    (rods, rest): (&[Rod], Rest),
    controls: &mut [DVec3],
    ends: &mut [End],
) {
    let n = rest.elements;
    let mut lanes = [EMPTY; MOST_LANES];
    let mut joints = Joints::default();
    let mut next = 0;
    let mut accepted = zero.truth(0);
    loop {
        for (index, lane) in lanes[..F::COUNT].iter_mut().enumerate() {
            if lane.hair.is_none() && next < rods.len() {
                let start = &controls[next * n..(next + 1) * n];
                joints.divide(&rods[next], n);
                let known = sweeps.load(index, next, &joints, start);
                let (fresh, energy) = (known.is_none(), known.unwrap_or_default());
                let scale = rods[next].moment_scale();
                let (constant, stiffness) = (joints.constant, joints.stiffness.min_element());
                let hair = Some(next);
                *lane = Lane { hair, fresh, energy, constant, scale, stiffness, ..EMPTY };
                next += 1;
            }
        }
        if lanes[..F::COUNT].iter().all(|lane| lane.hair.is_none()) {
            return;
        }
        let mut damping = zero;
        for (index, lane) in lanes[..F::COUNT].iter().enumerate() {
            damping.set(index, lane.damping);
        }
        let found = sweeps.backward(accepted, damping);
        for (index, lane) in lanes[..F::COUNT].iter_mut().enumerate() {
            let Some(hair) = lane.hair else { continue };
            lane.trying = false;
            if lane.fresh {
                sweeps.begin(index);
                continue;
            }
            let gradient = found.gradient.get(index).sqrt() / lane.scale;
            let positive = found.pivot.get(index) > 0.0;
            let at_rest = gradient <= rest.tolerance;
            let settled = at_rest && lane.damping == 0.0 && positive;
            let lost = !(found.turned.get(index) < LARGEST_SQUARE)
                || lane.damping > LARGEST_DAMPING
                || lane.iterations >= rest.max_iterations
                || (at_rest && lane.damping == 0.0 && !positive);
            if settled || lost {
                sweeps.save(index, hair, &mut controls[hair * n..(hair + 1) * n]);
                let energy = lane.energy + lane.constant;
                ends[hair] = End { settled, gradient, iterations: lane.iterations, energy };
                lane.hair = None;
            } else if at_rest {
                // Only the undamped sweep tells what kind of rest it is.
                lane.damping = 0.0;
            } else if positive {
                lane.trying = true;
            } else {
                lane.stiffen(-found.pivot.get(index));
            }
        }
        let energy = sweeps.forward();
        let mut bits = 0_u64;
        for (index, lane) in lanes[..F::COUNT].iter_mut().enumerate() {
            lane.iterations += 1;
            if lane.fresh {
                bits |= 1 << index;
                (lane.fresh, lane.energy) = (false, energy.get(index));
            }
            if !lane.trying {
                continue;
            }
            let (tried, expected) = (energy.get(index), found.decrease.get(index));
            let noise = F::NOISE * lane.energy.abs().max(lane.constant.abs());
            let lower = tried <= lane.energy - ENOUGH * expected
                || (expected < noise && tried <= lane.energy + noise);
            if lower {
                bits |= 1 << index;
                lane.energy = tried;
                lane.soften();
            } else {
                lane.stiffen(0.0);
            }
        }
        accepted = zero.truth(bits);
    }
}
