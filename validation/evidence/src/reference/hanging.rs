//! The rod of the boundary-value problem, and its equations.

use std::f64::consts::PI;

use frisure::rod::{NaturalStrain, RodSpec, TorsionConstant};
use glam::{DMat3, DVec3};
use thiserror::Error;

use super::gauss::integrate;
use super::natural::Natural;

/// The solver could not increase the weight, or the natural strain, to its full value.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("the boundary-value problem has no solution beyond {fraction} of the way on this branch")]
pub struct NoSolution {
    /// The fraction that it reached.
    pub fraction: f64,
}

/// A hanging rod in numbers without units.
#[derive(Clone, Debug)]
pub struct Hanging {
    /// Weight per length times L³/EI, EI the stiffness about d1.
    pub weight: f64,
    /// Stiffness about d1, d2 and t over EI.
    pub stiffness: DVec3,
    /// Natural strain times L.
    pub natural: Natural,
    /// Directors d1, d2, t at the root, in columns.
    pub root: DMat3,
    /// Unit of length (m).
    pub length: f64,
}

impl Hanging {
    /// The numbers of a rod in gravity alone, along −z; from textbook formulas of sections.
    #[must_use]
    pub fn new(spec: &RodSpec) -> Self {
        let (a, b, l) = (spec.section.a(), spec.section.b(), spec.length);
        let (e, g) = (spec.material.youngs_modulus(), spec.material.shear_modulus());
        let j = match spec.torsion {
            TorsionConstant::SaintVenant => PI * (a * b).powi(3) / (a * a + b * b),
            TorsionConstant::Polar => 0.25 * PI * a * b * (a * a + b * b),
        };
        let bend = 0.25 * PI * a * b.powi(3) * e;
        let stiffness = DVec3::new(1.0, (a / b).powi(2), g * j / bend);
        let weight =
            spec.material.density() * PI * a * b * spec.load.gravity.length() * l.powi(3) / bend;
        let natural = match &spec.natural {
            NaturalStrain::Uniform(strain) => Natural::uniform(*strain * l),
            NaturalStrain::Varying(profile) => {
                Natural::varying(profile.knots().iter().map(|&(s, strain)| (s / l, strain * l)))
            }
        };
        Self { weight, stiffness, natural, root: spec.root.frame(), length: l }
    }

    /// The same rod with another weight.
    #[must_use]
    pub fn with_weight(&self, weight: f64) -> Self {
        Self { weight, ..self.clone() }
    }

    /// The number of pieces of the rod, and of steps in each piece.
    pub(super) fn division(&self) -> (usize, usize) {
        // A section that hardly resists twist turns √(EI/GJ) times as fast as the curl: 0.3 of it, from where that is more.
        let stiffness = self.stiffness;
        let soft = 0.3 * (stiffness.x.max(stiffness.y) / stiffness.z).sqrt();
        let turn = self.natural.largest() * soft.max(1.0);
        // Within a piece the fastest growth, exp(√Γ s), stays below e².
        let heavy = self.weight / self.stiffness.min_element().min(1.0);
        let pieces = (0.5 * heavy.sqrt()).max(0.5 * turn).ceil().clamp(16.0, 1600.0);
        let steps = (6.0 * (turn + heavy.sqrt() + 6.0) / pieces).ceil().max(6.0);
        // Points of the line within a piece are ends of steps, so that they belong to the same solution.
        let (pieces, each) = (pieces as usize, POINTS.div_ceil(pieces as usize));
        (pieces, (steps as usize).next_multiple_of(each))
    }
}

/// Smallest number of intervals between the points at which lines are compared.
pub const POINTS: usize = 96;

/// ζ and M at the ends of all pieces.
pub(super) type Nodes = Vec<[f64; 6]>;

pub(super) fn halves(y: &[f64]) -> (DVec3, DVec3) {
    (DVec3::new(y[0], y[1], y[2]), DVec3::new(y[3], y[4], y[5]))
}

pub(super) fn joined(zeta: DVec3, moment: DVec3) -> [f64; 6] {
    [zeta.x, zeta.y, zeta.z, moment.x, moment.y, moment.z]
}

impl Hanging {
    pub(super) fn strain(&self, s: f64, moment: DVec3) -> DVec3 {
        self.natural.at(s) + moment / self.stiffness
    }

    /// ζ' and M'.
    pub(super) fn slope(&self, s: f64, y: &[f64]) -> [f64; 6] {
        let (zeta, moment) = halves(y);
        let u = self.strain(s, moment);
        let load = DVec3::Z.cross(zeta) * (self.weight * (1.0 - s));
        joined(zeta.cross(u), moment.cross(u) + load)
    }

    /// The linearised equations at a solution, for small changes of it.
    pub(super) fn linearised(&self, s: f64, y: &[f64]) -> impl Fn(&[f64]) -> [f64; 6] + use<> {
        let (zeta, moment) = halves(y);
        let u = self.strain(s, moment);
        let (soft, weight) = (self.stiffness.recip(), self.weight * (1.0 - s));
        move |by| {
            let (d_zeta, d_moment) = halves(by);
            let du = d_moment * soft;
            let load = DVec3::Z.cross(d_zeta) * weight;
            joined(d_zeta.cross(u) + zeta.cross(du), d_moment.cross(u) + moment.cross(du) + load)
        }
    }

    /// The solution of `y' = f(s, y)` that starts from `y` at `from`, in equal steps between the knots of the natural strain,
    /// at which f is not smooth.
    pub(super) fn integrate<const N: usize>(
        &self,
        f: &impl Fn(f64, &[f64; N]) -> [f64; N],
        (from, to): (f64, f64),
        steps: usize,
        y: [f64; N],
    ) -> [f64; N] {
        let cuts = self.natural.cuts(from, to);
        cuts.windows(2).fold(y, |y, part| integrate(f, part[0], part[1], steps, y))
    }

    pub(super) fn root_zeta(&self) -> DVec3 {
        self.root.transpose() * DVec3::Z
    }
}
