//! The batch solver: which sweeps, which precision, which instruction set.

use fearless_simd::{Level, Simd, SimdFrom, dispatch};
use glam::DVec3;

use super::contact::ContactField;
use super::contact_lanes::{ContactLanes, ContactSetup};
use super::lanes::{Lanes, SimdLanes};
use super::newton::{Job, LaneResult, StoppingRule, run};
use super::solution::{BatchSolution, RodSolution};
use super::start::InitialShape;
use super::weight_lanes::WeightLanes;
use crate::centre_line::Node;
use crate::equilibrium::{Options, equilibrium};
use crate::minimise::Stability;
use crate::resolution::{ElementKind, Resolution};
use crate::rod::Rod;
use crate::strain::NaturalStrain;

/// Precision of the iterations; the last ones are in double precision always.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `f64` from the start.
    #[default]
    Double,
    /// `f32`, twice as many rods at once, until rounding stops the descent, then `f64`.
    Single,
}

/// A solver of many rods at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Batch {
    /// Elements of each rod, at least 1.
    pub elements: usize,
    /// Gradient at rest, relative to [`Rod::moment_scale`].
    pub tolerance: f64,
    /// Most iterations of a rod before it goes to [`crate::equilibrium()`].
    pub max_iterations: usize,
    /// Precision of the iterations.
    pub precision: Precision,
}

impl Default for Batch {
    fn default() -> Self {
        // Chosen: 15 joints resolve four turns of a curl (3.5 a turn, docs/theory.md); 1e-8 is far below their own error.
        Self { elements: 15, tolerance: 1e-8, max_iterations: 200, precision: Precision::default() }
    }
}

/// Relative gradient at which single precision stops. Chosen by trial; not measured further.
const SINGLE_TOLERANCE: f64 = 1e-4;

/// Most iterations in single precision; rods that take longer are limited by rounding. Chosen by trial.
const SINGLE_ITERATIONS: usize = 60;

impl Batch {
    /// The equilibria of rods in their own weight from their natural shapes, computed on this thread.
    ///
    /// # Panics
    /// If there are no elements.
    #[must_use]
    pub fn solve(&self, rods: &[Rod]) -> BatchSolution {
        self.solve_from(rods, vec![DVec3::ZERO; rods.len() * self.elements])
    }

    /// As [`Self::solve`], from other shapes: the turn of each joint (rad), those of a rod one after the other. Zero is
    /// the natural shape.
    ///
    /// # Panics
    /// If there are no elements, or not as many turns as joints.
    #[must_use]
    pub fn solve_from(&self, rods: &[Rod], controls: Vec<DVec3>) -> BatchSolution {
        let n = self.elements;
        let mut found = self.solve_near(rods, controls);
        // What did not converge, by the scalar solver.
        for (rod, solution) in found.rods.iter_mut().enumerate() {
            if solution.stability == Stability::NotConverged {
                let before = solution.iterations;
                *solution = self.fall_back(&rods[rod], &mut found.controls[rod * n..(rod + 1) * n]);
                solution.iterations += before;
            }
        }
        found
    }

    /// As [`Self::solve_from`], but a rod that does not converge is returned as it is.
    ///
    /// # Panics
    /// As [`Self::solve_from`].
    #[must_use]
    pub fn solve_near(&self, rods: &[Rod], mut controls: Vec<DVec3>) -> BatchSolution {
        let n = self.elements;
        self.check(rods, &controls);
        let mut results = vec![LaneResult::default(); rods.len()];
        let mut before = vec![0; rods.len()];
        let uniform = uniform(rods);
        // 1. In single precision as far as rounding lets it descend.
        if self.precision == Precision::Single {
            let tolerance = self.tolerance.max(SINGLE_TOLERANCE);
            let rule = StoppingRule { tolerance, max_iterations: SINGLE_ITERATIONS };
            let job =
                Job { rods, elements: n, rule, controls: &mut controls, results: &mut results };
            dispatch!(Level::new(), simd => in_weight(f32s(simd), uniform, job));
            before = results.iter().map(|result| result.iterations).collect();
        }
        // 2. In double precision, from there or from the start.
        let job = self.job(rods, &mut controls, &mut results);
        dispatch!(Level::new(), simd => in_weight(f64s(simd), uniform, job));
        let solutions = results.iter().zip(&before).map(|(result, before)| {
            let found = result.solution();
            RodSolution { iterations: found.iterations + before, ..found }
        });
        BatchSolution { elements: n, controls, rods: solutions.collect() }
    }

    /// The equilibria of rods in contact, in double precision always; the first rod has the index `first` in the
    /// contact field. A rod that does not converge is returned as it is.
    ///
    /// Also returns the nodes of the rods, one more per rod than elements, those of a rod one after the other.
    ///
    /// # Panics
    /// As [`Self::solve_from`].
    #[must_use]
    pub fn solve_in_contact(
        &self,
        rods: &[Rod],
        start: InitialShape<'_>,
        contacts: &dyn ContactField,
        first: usize,
    ) -> (BatchSolution, Vec<Node>) {
        let (mut controls, frames) = match start {
            InitialShape::Controls(controls) => (controls, None),
            InitialShape::Frames(frames) => {
                (vec![DVec3::ZERO; rods.len() * self.elements], Some(frames))
            }
        };
        self.check(rods, &controls);
        let mut results = vec![LaneResult::default(); rods.len()];
        let mut nodes = vec![Node::default(); rods.len() * (self.elements + 1)];
        let setup = ContactSetup { contacts, first, frames };
        let job = self.job(rods, &mut controls, &mut results);
        let uniform = uniform(rods);
        dispatch!(
            Level::new(),
            simd => in_contact(f64s(simd), uniform, setup, &mut nodes, job)
        );
        let solutions = results.iter().map(LaneResult::solution).collect();
        (BatchSolution { elements: self.elements, controls, rods: solutions }, nodes)
    }

    fn check(&self, rods: &[Rod], controls: &[DVec3]) {
        assert!(self.elements > 0, "a rod has at least one element");
        assert_eq!(controls.len(), rods.len() * self.elements, "one turn for each joint");
    }

    fn job<'a>(
        &self,
        rods: &'a [Rod],
        controls: &'a mut [DVec3],
        results: &'a mut [LaneResult],
    ) -> Job<'a> {
        let rule = StoppingRule { tolerance: self.tolerance, max_iterations: self.max_iterations };
        Job { rods, elements: self.elements, rule, controls, results }
    }

    /// The equilibrium of a single rod by the scalar solver, along gravity's branch.
    fn fall_back(&self, rod: &Rod, controls: &mut [DVec3]) -> RodSolution {
        let options = Options {
            resolution: Resolution::Elements(self.elements),
            element: ElementKind::Jointed,
            tolerance: self.tolerance,
            estimate_error: false,
            eigenvalue: false,
            ..Options::default()
        };
        let rest = equilibrium(rod, &[], &options);
        controls.copy_from_slice(&rest.shape.controls);
        RodSolution {
            stability: rest.certificate.stability,
            gradient_norm: rest.certificate.gradient_norm,
            iterations: rest.certificate.iterations,
            energy: rest.energy.total(),
        }
    }
}

/// Whether each rod has the same rotation between all of its joints.
pub(super) fn uniform(rods: &[Rod]) -> bool {
    rods.iter().all(|rod| matches!(rod.natural(), NaturalStrain::Uniform(_)))
}

#[inline(always)]
fn in_weight<F: Lanes>(zero: F, uniform: bool, job: Job<'_>) {
    let mut sweeps = WeightLanes::new(zero, job.elements, uniform);
    run(zero, &mut sweeps, job);
}

#[inline(always)]
fn in_contact<F: Lanes>(
    zero: F,
    uniform: bool,
    setup: ContactSetup<'_>,
    nodes: &mut [Node],
    job: Job<'_>,
) {
    let mut sweeps = ContactLanes::new(zero, job.elements, uniform, setup, nodes);
    run(zero, &mut sweeps, job);
}

#[inline(always)]
pub(super) fn f64s<S: Simd>(simd: S) -> SimdLanes<S, S::f64s> {
    SimdLanes::new(simd, S::f64s::simd_from(simd, 0.0))
}

#[inline(always)]
fn f32s<S: Simd>(simd: S) -> SimdLanes<S, S::f32s> {
    SimdLanes::new(simd, S::f32s::simd_from(simd, 0.0))
}
