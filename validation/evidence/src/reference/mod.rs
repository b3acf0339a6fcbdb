//! The other way to the same truth: Kirchhoff's equations as a boundary-value problem.
//!
//! Nothing here uses frisure's solver. Of ours it has the numbers of a rod as frisure converts them: a helix of a radius and
//! a pitch to strains, a diameter and an axis ratio to semi-axes, directors to a frame. A hanging rod obeys, in its material frame,
//!
//! ```text
//! ζ' = ζ × u        M' = M × u + w(L − s) e₃ × ζ        u = u⁰ + K⁻¹ M
//! ζ(0) = R(0)ᵀ e_z                  M(L) = 0
//! ```
//!
//! with ζ the vertical as the section sees it, M the internal moment, w the weight per length. Lengths are in
//! units of L and moments of EI/L inside. The interval is cut into pieces, each is integrated by
//! Gauss–Legendre collocation of order six (`gauss`), and Newton's method joins them (`shooting`): multiple
//! shooting, without any minimisation of energy. The weight is turned on in steps.
//!
//! Whether a solution is stable is Jacobi's condition: no neighbouring solution that leaves the tip free may
//! meet it on the way to the root. How many do is Morse's index, the number of ways downhill.

mod banded;
mod gauss;
mod linear;
mod morse;
mod shooting;

use std::f64::consts::PI;

use frisure::rod::{NaturalStrain, RodSpec, TorsionConstant};
use glam::{DMat3, DVec3};
use thiserror::Error;

use crate::extremes::largest;

pub use linear::{anjyo, greenhill, prandtl_michell};
use shooting::Nodes;

/// The weight, or the natural strain, could not be turned on wholly.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("the boundary-value problem has no solution beyond {fraction} of the way on this branch")]
pub struct NoSolution {
    /// How much of it could be.
    pub fraction: f64,
}

/// A hanging rod in numbers without units.
#[derive(Clone, Copy, Debug)]
pub struct Hanging {
    /// Weight per length times L³/EI, EI the stiffness about d1.
    pub weight: f64,
    /// Stiffness about d1, d2 and t over EI.
    pub stiffness: DVec3,
    /// Natural strain times L.
    pub natural: DVec3,
    /// Directors d1, d2, t at the root, in columns.
    pub root: DMat3,
    /// The length (m) that is the unit.
    pub length: f64,
}

impl Hanging {
    /// The numbers of a rod with uniform natural strain, from the formulas of sections in the books.
    ///
    /// # Panics
    /// If the natural strain varies.
    #[must_use]
    pub fn new(spec: &RodSpec) -> Self {
        let NaturalStrain::Uniform(natural) = spec.natural else {
            panic!("the reference is for uniform natural strain")
        };
        let (a, b, l) = (spec.section.a(), spec.section.b(), spec.length);
        let (e, g) = (spec.material.youngs_modulus(), spec.material.shear_modulus());
        let j = match spec.torsion {
            TorsionConstant::SaintVenant => PI * (a * b).powi(3) / (a * a + b * b),
            TorsionConstant::Polar => 0.25 * PI * a * b * (a * a + b * b),
        };
        let bend = 0.25 * PI * a * b.powi(3) * e;
        let stiffness = DVec3::new(1.0, (a / b).powi(2), g * j / bend);
        let weight = spec.material.density() * PI * a * b * spec.gravity * l.powi(3) / bend;
        Self { weight, stiffness, natural: natural * l, root: spec.root.frame(), length: l }
    }

    /// The stable equilibrium reached from the natural shape as the weight is turned on.
    ///
    /// # Errors
    /// [`NoSolution`], where that branch ends, loses its stability, or cannot be followed.
    pub fn solve(&self) -> Result<Solution, NoSolution> {
        shooting::follow(self, true).map(|nodes| Solution { rod: *self, nodes })
    }

    /// The same without asking for stability: a rod and a start that a mirror maps to themselves stay so.
    ///
    /// # Errors
    /// [`NoSolution`], where that branch ends or cannot be followed.
    pub fn solve_symmetric(&self) -> Result<Solution, NoSolution> {
        shooting::follow(self, false).map(|nodes| Solution { rod: *self, nodes })
    }

    /// The solution reached from a straight rod that hangs from a root that points straight down, as it is given
    /// its natural strain.
    ///
    /// # Errors
    /// [`NoSolution`], where that branch ends or cannot be followed.
    pub fn solve_curled(&self) -> Result<Solution, NoSolution> {
        shooting::curl(self).map(|nodes| Solution { rod: *self, nodes })
    }

    /// The solution next to a line that somebody else found, given as a function of arc length over length to the
    /// frame there: Newton's method on the equations, which keeps nothing of where it started from.
    ///
    /// # Errors
    /// [`NoSolution`], where Newton's method finds none from there.
    pub fn solve_near(&self, frame: impl Fn(f64) -> DMat3) -> Result<Solution, NoSolution> {
        let start = shooting::of_frames(self, frame);
        shooting::near(self, start).map(|nodes| Solution { rod: *self, nodes })
    }

    /// The same rod with another weight.
    #[must_use]
    pub fn with_weight(self, weight: f64) -> Self {
        Self { weight, ..self }
    }

    /// How many pieces the rod is cut into, and into how many steps each.
    fn division(&self) -> (usize, usize) {
        let turn = self.natural.length();
        // Within a piece the fastest growth, exp(√Γ s), stays below e².
        let heavy = self.weight / self.stiffness.min_element().min(1.0);
        let pieces = (0.5 * heavy.sqrt()).max(0.5 * turn).ceil().clamp(16.0, 400.0);
        let steps = (6.0 * (turn + heavy.sqrt() + 6.0) / pieces).ceil().max(6.0);
        // Points of the line within a piece are ends of steps, so that it is the same solution.
        let (pieces, each) = (pieces as usize, POINTS.div_ceil(pieces as usize));
        (pieces, (steps as usize).next_multiple_of(each))
    }
}

/// Least number of intervals between the points at which lines are compared.
pub const POINTS: usize = 96;

/// A solution of the boundary-value problem.
#[derive(Clone, Debug)]
pub struct Solution {
    rod: Hanging,
    nodes: Nodes,
}

impl Solution {
    /// Position over the length, relative to the root, and frame at evenly spaced arc lengths, the root's first:
    /// at more than [`POINTS`].
    #[must_use]
    pub fn line(&self) -> Vec<(DVec3, DMat3)> {
        let pieces = self.nodes.len() - 1;
        shooting::line(&self.rod, &self.nodes, POINTS.div_ceil(pieces))
    }

    /// Position of the tip relative to the root (m).
    #[must_use]
    pub fn tip(&self) -> DVec3 {
        self.line().last().map_or(DVec3::ZERO, |p| p.0 * self.rod.length)
    }

    /// Largest distance (in lengths) of a line, given as a function of arc length over length to a position
    /// relative to the root in lengths.
    #[must_use]
    pub fn distance(&self, line: impl Fn(f64) -> DVec3) -> f64 {
        let points = self.line();
        let last = (points.len() - 1) as f64;
        let gap = |(i, p): (usize, &(DVec3, DMat3))| p.0.distance(line(i as f64 / last));
        largest(points.iter().enumerate().map(gap))
    }

    /// How many independent small changes lower the energy: 0 for a minimum.
    #[must_use]
    pub fn index(&self) -> usize {
        morse::index(&self.rod, &self.nodes)
    }

    /// Whether the solution is a minimum of the energy.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.index() == 0
    }
}

#[cfg(test)]
mod tests;
