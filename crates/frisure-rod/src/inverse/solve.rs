//! The rod that hangs in the shape of a line: fit the line, balance the moments, correct what remains.

use std::sync::OnceLock;

use glam::{DMat3, DVec3};

use super::curve::Curve;
use super::support;
use crate::chain::{Chain, Shape};
use crate::equilibrium::{Equilibrium, Options, equilibrium_from};
use crate::error::InvalidQuantity;
use crate::minimise::{
    CLEAR_EIGENVALUE, Minimiser, Minimum, Newton, Problem, Stability, StoppingCriteria,
};
use crate::potential::{Field, FieldPotential, Potential};
use crate::resolution::ElementKind;
use crate::rod::{Rod, RodSpec, Root};
use crate::strain::{NaturalStrain, StrainProfile};

/// A rod that rests in a given shape.
#[derive(Clone, Debug)]
pub struct InverseSolution {
    /// The rod: its natural strain, its root and its length are the shape's.
    pub rod: Rod,
    /// Its equilibrium.
    pub equilibrium: Equilibrium,
    /// The given shape as a shape of this rod, stationary or not.
    pub target: Equilibrium,
    /// Largest distance (m) of a given point from where the rod rests, at the same part of its length.
    pub error: f64,
    /// Least factor on the stiffness of the fibre with which the given shape is stable; 1 if it is stable as it is. Of a shape
    /// that the rod leaves, in the finest division in which it was looked at.
    pub stiffness_needed: f64,
}

/// A rod with the natural strain with which a given shape is in balance, before that is corrected by where the rod rests.
#[derive(Clone, Debug)]
pub struct Balance {
    /// The rod.
    pub rod: Rod,
    /// The given shape as a shape of this rod.
    pub target: Equilibrium,
    /// Least factor on the stiffness of the fibre with which the given shape is stable in this division; 1 if it is as it is.
    pub stiffness_needed: f64,
}

/// Largest turn (rad) of the line within an element. Chosen by trial; not measured further.
const LARGEST_TURN: f64 = 0.12;

/// Longest element (m). Chosen by trial; not measured further.
const LONGEST_ELEMENT: f64 = 2.5e-3;

/// Fewest and most elements of a shape. Chosen by trial; not measured further.
const ELEMENTS: (f64, f64) = (12.0, 400.0);

/// Rounds in which the shape is fitted to the line, each with the strain of the one before. Chosen by trial.
const FIT_ROUNDS: usize = 3;

/// Stiffness of the springs to the line, as a multiple of EI/h⁴. Chosen by trial; not measured further.
const SPRINGS: f64 = 16.0;

/// Relative gradient at which a fit ends, and most steps of Newton's method for it. Chosen.
const FIT_TOLERANCE: f64 = 1e-9;
const FIT_STEPS: usize = 60;

/// Most corrections of the natural strain by the remaining error. Chosen by trial.
const CORRECTIONS: usize = 2;

/// The same while the error is larger than [`VISIBLE`] (m). Chosen by trial, and a tenth of a millimetre chosen.
const MOST_CORRECTIONS: usize = 5;
const VISIBLE: f64 = 1e-4;

/// Part of a correction that is tried after one that made the error larger. Chosen by trial.
const SHORTER: f64 = 0.3;

/// Most elements into which a shape is divided because it does not hold in fewer. Chosen.
const FINEST: usize = 1000;

/// Error (m) that needs no correction: a seventh of the diameter of a hair. Chosen.
const GOOD: f64 = 1e-5;

/// The rod that rests in the shape of a line in its own weight and in other potentials: [`FittedCurve::new`] and
/// [`FittedCurve::solve`].
///
/// # Errors
/// As they.
pub fn solve(
    given: &[DVec3],
    spec: &RodSpec,
    external: &[&dyn Potential],
    options: &Options,
) -> Result<InverseSolution, InvalidQuantity> {
    FittedCurve::new(given, spec)?.solve(external, options)
}

/// A line as the shape of a rod.
#[derive(Debug)]
pub struct FittedCurve {
    line: Curve,
    /// The rod that would have this shape without weight.
    rod: Rod,
    target: Shape,
    /// The same in twice as many elements, once it has been needed.
    finer: OnceLock<Box<Self>>,
}

impl FittedCurve {
    /// The rod in the shape of a line of points (m).
    ///
    /// Of `spec` the section, the material, the kind of torsion and gravity count; length, natural strain and
    /// root are those of the line, whose first point is the root. The material frame bends about d1 as far as
    /// an even twist allows: a polyline says nothing of the turn of its sections.
    ///
    /// # Errors
    /// [`InvalidQuantity`], if the line has no length, a coordinate is not finite, or no rod can be made of
    /// `spec`.
    pub fn new(given: &[DVec3], spec: &RodSpec) -> Result<Self, InvalidQuantity> {
        let line = checked(given)?;
        let (rod, target) = fitted(&line, spec)?;
        Ok(Self { line, rod, target, finer: OnceLock::new() })
    }

    /// The rod that would have this shape without weight.
    #[must_use]
    pub fn rod(&self) -> &Rod {
        &self.rod
    }

    /// Positions of its nodes (m), evenly spaced from root to tip.
    #[must_use]
    pub fn nodes(&self) -> &[DVec3] {
        &self.target.positions
    }

    /// The force (N) that something beneath the rod has to bear at each node, so that the rod is in balance with the
    /// least elastic energy: `beneath` is the unit direction in which it can push there, `None` where there is nothing.
    /// `held` is the force per length (N/m) that acts besides its weight at an arc length (m).
    ///
    /// # Panics
    /// If there is not one direction per node.
    #[must_use]
    pub fn least_support(
        &self,
        beneath: &[Option<DVec3>],
        held: impl Fn(f64) -> DVec3,
    ) -> Vec<f64> {
        let elements = self.target.controls.len();
        let h = self.rod.length() / elements as f64;
        let load = |i: usize| (self.rod.load() + held((i as f64 + 0.5) * h)) * h;
        let loads: Vec<DVec3> = (0..elements).map(load).collect();
        support::least_energy_forces(&self.rod, &self.target, &loads, beneath)
    }

    /// The rod that is in balance in this shape, without looking where it rests: what [`Self::solve`] begins with, in a small part of
    /// its time. `external` are the potentials that act on it besides its weight.
    ///
    /// # Errors
    /// [`InvalidQuantity`], if the natural strain that it would need is not finite.
    pub fn balance(&self, external: &[&dyn Potential]) -> Result<Balance, InvalidQuantity> {
        self.balance_with(&self.balanced(external), external)
    }

    /// The rod that rests in this shape. `external` are the potentials that act on it besides its weight, and
    /// `options` how its equilibrium is searched for.
    ///
    /// # Errors
    /// [`InvalidQuantity`], if the natural strain that it would need is not finite.
    pub fn solve(
        &self,
        external: &[&dyn Potential],
        options: &Options,
    ) -> Result<InverseSolution, InvalidQuantity> {
        let best = self.solve_in_this_division(external, options)?;
        let elements = 2 * self.target.controls.len();
        if best.error < VISIBLE || best.stiffness_needed > 1.0 || elements > FINEST {
            return Ok(best);
        }
        // The shape is stable in this division, and yet the rod rests elsewhere in one that is finer: there it may be unstable.
        let finer = self.finer(elements)?.solve(external, options)?;
        if finer.error < best.error {
            return Ok(finer);
        }
        Ok(InverseSolution { stiffness_needed: finer.stiffness_needed, ..best })
    }

    /// The same in a larger number of elements, which does not change from one call to the next.
    fn finer(&self, elements: usize) -> Result<&Self, InvalidQuantity> {
        if self.finer.get().is_none() {
            // The fit takes about as long as an equilibrium, and potentials do not matter to it.
            let (rod, target) = fitted_by(&self.line, self.rod.spec(), elements)?;
            let finer = Self { line: self.line.clone(), rod, target, finer: OnceLock::new() };
            let _ = self.finer.set(Box::new(finer));
        }
        Ok(self.finer.get().expect("it has just been set"))
    }

    fn solve_in_this_division(
        &self,
        external: &[&dyn Potential],
        options: &Options,
    ) -> Result<InverseSolution, InvalidQuantity> {
        let mut strains = self.balanced(external);
        let mut best = self.with_strains(&strains, external, options)?;
        let mut part = 1.0;
        for correction in 0..MOST_CORRECTIONS {
            let enough = correction >= CORRECTIONS && best.error < VISIBLE;
            // An unstable shape is not corrected: its equilibrium is another one, and the difference says nothing.
            if best.error < GOOD || enough || best.stiffness_needed > 1.0 {
                break;
            }
            let next = corrected(&strains, &best.equilibrium, &self.target, part);
            let better = self.with_strains(&next, external, options)?;
            if better.error < best.error {
                (best, strains) = (better, next);
            } else if best.error < VISIBLE {
                break;
            } else {
                // Weight moves a rod that is just stable by more than the change of its strain: less of it is enough.
                part *= SHORTER;
            }
        }
        Ok(best)
    }

    /// The natural strains (rad/m, one per element) with which this shape is in balance.
    fn balanced(&self, external: &[&dyn Potential]) -> Vec<DVec3> {
        let chain = Chain::uniform(&self.rod, ElementKind::Helix, self.target.controls.len());
        balanced(&Problem::new(&chain, external), &self.target)
    }

    /// The rod with these natural strains (rad/m, one per element) and its equilibrium.
    fn with_strains(
        &self,
        strains: &[DVec3],
        external: &[&dyn Potential],
        options: &Options,
    ) -> Result<InverseSolution, InvalidQuantity> {
        let Balance { rod, target, stiffness_needed } = self.balance_with(strains, external)?;
        let equilibrium = equilibrium_from(&rod, external, options, &target);
        let error = largest_distance(&self.line, &equilibrium);
        Ok(InverseSolution { rod, equilibrium, target, error, stiffness_needed })
    }

    /// The rod with these natural strains (rad/m, one per element) in this shape.
    fn balance_with(
        &self,
        strains: &[DVec3],
        external: &[&dyn Potential],
    ) -> Result<Balance, InvalidQuantity> {
        let (elements, length) = (strains.len(), self.line.length());
        let natural = profile(length / elements as f64, strains)?;
        let rod = Rod::new(RodSpec { natural, ..self.rod.spec().clone() })?;
        let chain = Chain::uniform(&rod, ElementKind::Helix, elements);
        let problem = Problem::new(&chain, external);
        let gradient_norm = problem.gradient_norm(&self.target);
        let least = problem.min_eigenvalue(&self.target);
        let stability = if least > 0.0 { Stability::Stable } else { Stability::Saddle };
        let clear = least > CLEAR_EIGENVALUE;
        let minimum = Minimum {
            shape: self.target.clone(),
            gradient_norm,
            iterations: 0,
            stability,
            clear,
            crossed: false,
        };
        let target = Equilibrium::from_minimum(&problem, minimum);
        // Stiffness makes the elastic part of the second variation greater, weight and contact stay: with
        // H x = λ M x, λ becomes 1 − (1 − λ) / factor.
        let stiffness_needed = if least > 0.0 { 1.0 } else { 1.0 - least };
        Ok(Balance { rod, target, stiffness_needed })
    }
}

fn checked(given: &[DVec3]) -> Result<Curve, InvalidQuantity> {
    for x in given.iter().flat_map(DVec3::to_array) {
        crate::error::finite("coordinate of a line", x, "m")?;
    }
    Curve::through(given).ok_or(InvalidQuantity {
        quantity: "length of a line",
        value: 0.0,
        unit: "m",
        allowed: "more than 0: two points apart from each other",
    })
}

/// A rod without weight that rests on the line, and its shape.
fn fitted(line: &Curve, spec: &RodSpec) -> Result<(Rod, Shape), InvalidQuantity> {
    let wanted = (line.turning() / LARGEST_TURN).max(line.length() / LONGEST_ELEMENT).ceil();
    fitted_by(line, spec, wanted.clamp(ELEMENTS.0, ELEMENTS.1) as usize)
}

/// The same of a number of elements.
fn fitted_by(
    line: &Curve,
    spec: &RodSpec,
    elements: usize,
) -> Result<(Rod, Shape), InvalidQuantity> {
    let length = line.length();
    let frames = line.frames(elements);
    let root = Root::new(line.at(0.0), frames[0].x_axis, frames[0].y_axis, frames[0].z_axis)?;
    let of = |natural| {
        let spec = RodSpec { length, natural, root, ..spec.clone() };
        Rod::new(spec)
    };
    let mut rod = of(NaturalStrain::STRAIGHT)?;
    let mut shape = Chain::uniform(&rod, ElementKind::Helix, elements).shape_through(&frames);
    let h = length / elements as f64;
    for _ in 0..FIT_ROUNDS {
        // With the shape of the round before as the natural one, bending no longer pulls the rod off the line.
        let strains: Vec<DVec3> = shape.controls.iter().map(|c| *c / h).collect();
        rod = of(profile(h, &strains)?)?;
        let chain = Chain::uniform(&rod, ElementKind::Helix, elements);
        // Springs that are stiffer than bending over one element, EI/h⁴ (N/m²): the line wins, the rod smooths it.
        let stiffness = SPRINGS * rod.stiffness().max_element() / h.powi(4);
        let springs = Springs { line, stiffness };
        let pull = FieldPotential::new(&springs, 2);
        let external: [&dyn Potential; 1] = [&pull];
        let problem = Problem::with_load(&chain, &external, 0.0);
        let stopping = StoppingCriteria { tolerance: FIT_TOLERANCE, max_iterations: FIT_STEPS };
        shape = Newton::default().minimise(&problem, shape, stopping).shape;
    }
    Ok((rod, shape))
}

/// Strains (rad/m) given for the middles of elements of length `h` (m).
fn profile(h: f64, strains: &[DVec3]) -> Result<NaturalStrain, InvalidQuantity> {
    let knot = |(i, u): (usize, &DVec3)| (h * (i as f64 + 0.5), *u);
    StrainProfile::new(strains.iter().enumerate().map(knot).collect()).map(NaturalStrain::Varying)
}

/// The mean natural strain (rad/m) of each element with which a shape is in balance.
fn balanced(problem: &Problem<'_>, shape: &Shape) -> Vec<DVec3> {
    let chain = problem.chain();
    let h = chain.rod().length() / chain.len() as f64;
    let natural = |(i, gradient): (usize, DVec3)| {
        let element = chain.geometry(i);
        // The gradient is K (c − c⁰) + g, with g that of weight and external potentials; it vanishes for the natural
        // control c⁰ + K⁻¹ (K (c − c⁰) + g) = c + K⁻¹ g. docs/theory.md, "Inverse statics", step 3.
        (element.rest() + gradient / element.stiffness()) / h
    };
    problem.gradient(shape).into_iter().enumerate().map(natural).collect()
}

/// Natural strains corrected by `part` of the difference between the equilibrium and the target.
fn corrected(strains: &[DVec3], rest: &Equilibrium, target: &Shape, part: f64) -> Vec<DVec3> {
    let elements = strains.len();
    let h = rest.rod.length() / elements as f64;
    let frames: Vec<DMat3> =
        rest.sample(elements + 1).into_iter().map(|(_, frame)| frame).collect();
    let chain = Chain::uniform(&rest.rod, ElementKind::Helix, elements);
    let now = chain.shape_through(&frames);
    let step = target
        .controls
        .iter()
        .zip(&now.controls)
        .map(|(wanted, got)| (*wanted - *got) * (part / h));
    strains.iter().zip(step).map(|(strain, step)| *strain + step).collect()
}

/// Most points of a line, evenly chosen, at which it is compared with a rod.
const COMPARED: usize = 512;

/// Largest distance (m) of a line's points from a rod at rest, each at its arc length.
fn largest_distance(line: &Curve, rest: &Equilibrium) -> f64 {
    let chain = rest.chain();
    let distance = |(s, p): &(f64, DVec3)| rest.at(&chain, s / line.length()).0.distance(*p);
    // From the tip, which moves most.
    let nodes = line.nodes().iter().rev().step_by(line.nodes().len().div_ceil(COMPARED));
    nodes.map(distance).fold(0.0, f64::max)
}

/// Springs from each point of a rod to the point of a line at the same arc length.
struct Springs<'a> {
    line: &'a Curve,
    /// Of the springs, per length (N/m²).
    stiffness: f64,
}

impl Field for Springs<'_> {
    fn energy(&self, s: f64, position: DVec3) -> f64 {
        0.5 * self.stiffness * position.distance_squared(self.line.at(s))
    }

    fn derivatives(&self, s: f64, position: DVec3) -> Option<(DVec3, DMat3)> {
        let pull = (position - self.line.at(s)) * self.stiffness;
        Some((pull, DMat3::from_diagonal(DVec3::splat(self.stiffness))))
    }
}
