//! Many hairs at once, each its own rod in its own weight, side by side in the lanes of the processor's
//! vectors.
//!
//! The elements are those of [`crate::ElementKind::Jointed`], the energy is exactly theirs, and so is the minimum;
//! only the way there is another: straight from the natural shape, without following gravity. What does
//! not come to rest, or to rest on a saddle, goes to [`crate::equilibrium()`].
//!
//! Which hairs share a vector changes nothing: lanes do not see each other. Vectors are as wide as the processor
//! has them, with fused multiplication and addition where it has that; between processors with and without,
//! the last digits differ.

mod hanging;
mod joints;
mod lanes;
mod pivot;
mod settle;
mod sweep;
mod touch;
mod touching;
mod tube;
mod turn;
mod turns;

use glam::DVec3;

use crate::minimise::Stability;
use crate::{Chain, ElementKind, Node, Options, Resolution, Rod, Shape, equilibrium};
use settle::{Around, End, Rest};
pub use touching::{Contact, ContactField, Frames};
pub use tube::ConfinementTube;

/// Which numbers the way to rest is computed with; the end is double precision always.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 64 bits from the start.
    #[default]
    Double,
    /// 32 bits until nothing gets better, twice as many hairs at once, then 64.
    Single,
}

/// How many hairs are brought to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Batch {
    /// Elements of each hair, at least 1.
    pub elements: usize,
    /// Gradient at rest, relative to [`Rod::moment_scale`].
    pub tolerance: f64,
    /// Most iterations of a hair before it goes to [`crate::equilibrium()`].
    pub max_iterations: usize,
    /// The numbers.
    pub precision: Precision,
}

impl Default for Batch {
    fn default() -> Self {
        Self { elements: 15, tolerance: 1e-8, max_iterations: 200, precision: Precision::default() }
    }
}

/// One hair of a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodSolution {
    /// What the shape is.
    pub stability: Stability,
    /// Relative gradient, in double precision.
    pub gradient_norm: f64,
    /// Iterations, of all kinds.
    pub iterations: usize,
    /// Elastic energy and that of the weight (J), as [`crate::Energy::total`].
    pub energy: f64,
}

/// What hairs start from that can touch something.
pub enum InitialShape<'a> {
    /// The turn of each joint (rad), those of a hair one after the other.
    Controls(Vec<DVec3>),
    /// The material frame that each has at an arc length.
    Frames(Frames<'a>),
}

/// Hairs at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchSolution {
    /// Elements of each hair.
    pub elements: usize,
    /// Turns of the joints (rad), those of a hair one after the other.
    pub controls: Vec<DVec3>,
    /// One for each hair.
    pub rods: Vec<RodSolution>,
}

/// Gradient at which single precision may stop.
const SINGLE_TOLERANCE: f64 = 1e-4;

/// Most iterations in single precision: what takes longer drowns in rounding.
const SINGLE_ITERATIONS: usize = 60;

impl Batch {
    /// Brings hairs to rest in their own weight, on this thread.
    ///
    /// # Panics
    /// If there are no elements.
    #[must_use]
    pub fn solve(&self, rods: &[Rod]) -> BatchSolution {
        self.solve_from(rods, vec![DVec3::ZERO; rods.len() * self.elements])
    }

    /// The same, from other shapes: the turn of each joint (rad), those of a hair one after the other. Zero is the
    /// natural shape.
    ///
    /// # Panics
    /// If there are no elements, or not as many turns as joints.
    #[must_use]
    pub fn solve_from(&self, rods: &[Rod], mut controls: Vec<DVec3>) -> BatchSolution {
        let n = self.elements;
        self.check(rods, &controls);
        let mut ends = vec![End::default(); rods.len()];
        let mut before = vec![0; rods.len()];
        if self.precision == Precision::Single {
            let tolerance = self.tolerance.max(SINGLE_TOLERANCE);
            let rest = Rest { tolerance, max_iterations: SINGLE_ITERATIONS, ..self.rest() };
            settle::single(rods, rest, &mut controls, &mut ends);
            before = ends.iter().map(|end| end.iterations).collect();
        }
        settle::double(rods, self.rest(), &mut controls, &mut ends);
        let solutions = (ends.iter().zip(&before).enumerate())
            .map(|(hair, (end, before))| {
                let mut found = match end.settled {
                    true => end.as_told(),
                    false => self.alone(&rods[hair], &mut controls[hair * n..(hair + 1) * n]),
                };
                let so_far = if end.settled { 0 } else { end.iterations };
                found.iterations += so_far + before;
                found
            })
            .collect();
        BatchSolution { elements: n, controls, rods: solutions }
    }

    /// Brings hairs to rest that can touch something, to which the first of them is hair `first`; in double precision
    /// always. They start from other turns of joints (rad), as in [`Self::solve_from`], or from the shape that has
    /// `frames` at its nodes. What then does not come to rest is told as it is.
    ///
    /// Also tells the nodes of hairs, one more for each than elements, those of a hair one after the other.
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
        let mut ends = vec![End::default(); rods.len()];
        let mut nodes = vec![Node::default(); rods.len() * (self.elements + 1)];
        let around = Around { contacts, first, frames };
        settle::among(rods, self.rest(), around, &mut controls, (&mut nodes, &mut ends));
        let solutions = ends.iter().map(End::as_told).collect();
        (BatchSolution { elements: self.elements, controls, rods: solutions }, nodes)
    }

    fn check(&self, rods: &[Rod], controls: &[DVec3]) {
        assert!(self.elements > 0, "a hair has at least one element");
        assert_eq!(controls.len(), rods.len() * self.elements, "one turn for each joint");
    }

    fn rest(&self) -> Rest {
        let Self { elements, tolerance, max_iterations, .. } = *self;
        Rest { elements, tolerance, max_iterations }
    }

    /// A hair by itself, along gravity's branch.
    fn alone(&self, rod: &Rod, controls: &mut [DVec3]) -> RodSolution {
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

impl BatchSolution {
    /// The shape of a hair; `rod` is the one that it was computed of.
    #[must_use]
    pub fn shape(&self, rod: &Rod, hair: usize) -> Shape {
        let n = self.elements;
        let chain = Chain::uniform(rod, ElementKind::Jointed, n);
        chain.shape(self.controls[hair * n..(hair + 1) * n].to_vec())
    }
}
