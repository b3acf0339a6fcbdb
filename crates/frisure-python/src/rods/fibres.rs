//! Rods from arrays of their properties, which are read where they are.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure::rod::{
    InvalidQuantity, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, StrainProfile,
    TorsionConstant,
};
use frisure_engine::Error;
use glam::DVec3;
use numpy::ndarray::{ArrayView1, ArrayView2, ArrayView3, Axis};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use rayon::iter::{IntoParallelIterator, ParallelExtend, ParallelIterator};

use super::clamp::Clamps;
use super::limits::{self, Limits};
use crate::errors::raise;
use crate::{room, work};

/// Rods that are made between two looks at signals: with a natural strain at a hundred knots this takes 20 ms.
const BLOCK: usize = 8192;

/// Properties of rods: each has one row for all rods, or one for each. SI units.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Fibres<'py> {
    diameter: PyReadonlyArray1<'py, f64>,
    axis_ratio: PyReadonlyArray1<'py, f64>,
    youngs_modulus: PyReadonlyArray1<'py, f64>,
    shear_modulus: PyReadonlyArray1<'py, f64>,
    density: PyReadonlyArray1<'py, f64>,
    gravity: PyReadonlyArray1<'py, f64>,
}

/// How rods are clamped and what shape they have by nature, as [`Fibres`].
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Clamped<'py> {
    length: PyReadonlyArray1<'py, f64>,
    root: PyReadonlyArray2<'py, f64>,
    tangent: PyReadonlyArray2<'py, f64>,
    d1: PyReadonlyArray2<'py, f64>,
    curl_radius: PyReadonlyArray1<'py, f64>,
    curl_pitch: PyReadonlyArray1<'py, f64>,
    /// Instead of a curl: the strain at knots that divide the length evenly; one knot is the same all along.
    natural_strain: Option<PyReadonlyArray3<'py, f64>>,
}

/// The memory of [`Fibres`].
pub(crate) struct FibreViews<'a> {
    diameter: Numbers<'a>,
    axis_ratio: Numbers<'a>,
    youngs_modulus: Numbers<'a>,
    shear_modulus: Numbers<'a>,
    density: Numbers<'a>,
    gravity: Numbers<'a>,
}

/// The memory of [`Clamped`].
pub(crate) struct ClampViews<'a> {
    length: Numbers<'a>,
    root: Vectors<'a>,
    tangent: Vectors<'a>,
    d1: Vectors<'a>,
    curl_radius: Numbers<'a>,
    curl_pitch: Numbers<'a>,
    natural_strain: Option<Profiles<'a>>,
}

impl Fibres<'_> {
    pub(crate) fn views(&self) -> FibreViews<'_> {
        FibreViews {
            diameter: Numbers("diameter", self.diameter.as_array()),
            axis_ratio: Numbers("axis_ratio", self.axis_ratio.as_array()),
            youngs_modulus: Numbers("youngs_modulus", self.youngs_modulus.as_array()),
            shear_modulus: Numbers("shear_modulus", self.shear_modulus.as_array()),
            density: Numbers("density", self.density.as_array()),
            gravity: Numbers("gravity", self.gravity.as_array()),
        }
    }
}

impl Clamped<'_> {
    pub(crate) fn views(&self) -> ClampViews<'_> {
        let profiles = self.natural_strain.as_ref();
        ClampViews {
            length: Numbers("length", self.length.as_array()),
            root: Vectors("root", self.root.as_array()),
            tangent: Vectors("tangent", self.tangent.as_array()),
            d1: Vectors("d1", self.d1.as_array()),
            curl_radius: Numbers("curl_radius", self.curl_radius.as_array()),
            curl_pitch: Numbers("curl_pitch", self.curl_pitch.as_array()),
            natural_strain: profiles.map(|p| Profiles(p.as_array())),
        }
    }
}

/// A number of each rod, and the name of the argument that has it.
struct Numbers<'a>(&'static str, ArrayView1<'a, f64>);

/// A vector of each rod.
struct Vectors<'a>(&'static str, ArrayView2<'a, f64>);

/// Natural strains (rad/m) of each rod at its knots.
struct Profiles<'a>(ArrayView3<'a, f64>);

/// Why a rod of arrays cannot be made.
pub(crate) struct WrongRod {
    /// The argument with its index, such as `length[3]`.
    argument: String,
    problem: String,
}

/// The row of a rod in an array that has one for all rods, or one for each.
fn row(rod: usize, rows: usize) -> usize {
    if rows == 1 { 0 } else { rod }
}

impl Numbers<'_> {
    fn at(&self, rod: usize) -> f64 {
        self.1[row(rod, self.1.len())]
    }

    /// The number of a rod, if it is in its range.
    fn within(&self, rod: usize, limits: &Limits) -> Result<f64, WrongRod> {
        let index = row(rod, self.1.len());
        limits.check(self.1[index]).map_err(|problem| told(self.0, index, problem))
    }

    /// The error about this argument of a rod.
    fn wrong(&self, rod: usize) -> impl FnOnce(InvalidQuantity) -> WrongRod {
        wrong(self.0, row(rod, self.1.len()))
    }
}

impl Vectors<'_> {
    fn at(&self, rod: usize) -> DVec3 {
        let vector = self.1.index_axis(Axis(0), row(rod, self.1.nrows()));
        DVec3::new(vector[0], vector[1], vector[2])
    }

    /// The vector of a rod, if its components are in their range.
    fn within(&self, rod: usize, limits: &Limits) -> Result<DVec3, WrongRod> {
        let vector = self.at(rod);
        for component in vector.to_array() {
            let index = row(rod, self.1.nrows());
            limits.check(component).map_err(|problem| told(self.0, index, problem))?;
        }
        Ok(vector)
    }

    fn wrong(&self, rod: usize) -> impl FnOnce(InvalidQuantity) -> WrongRod {
        wrong(self.0, row(rod, self.1.nrows()))
    }
}

impl Profiles<'_> {
    fn at(&self, rod: usize, length: f64) -> Result<NaturalStrain, WrongRod> {
        let index = row(rod, self.0.len_of(Axis(0)));
        let knots = self.0.index_axis(Axis(0), index);
        let strain = |knot: usize| DVec3::from_array([0, 1, 2].map(|k| knots[[knot, k]]));
        for component in knots {
            let checked = limits::STRAIN.check(*component);
            checked.map_err(|problem| told("natural_strain", index, problem))?;
        }
        if knots.nrows() == 1 {
            return Ok(NaturalStrain::Uniform(strain(0)));
        }
        let step = length / (knots.nrows().max(2) - 1) as f64;
        let knots = (0..knots.nrows()).map(|knot| (step * knot as f64, strain(knot))).collect();
        let profile = StrainProfile::new(knots).map_err(wrong("natural_strain", index))?;
        Ok(NaturalStrain::Varying(profile))
    }
}

fn wrong(argument: &str, index: usize) -> impl FnOnce(InvalidQuantity) -> WrongRod {
    move |problem| told(argument, index, problem.to_string())
}

/// The error about an argument, with what is wrong in words.
fn told(argument: &str, index: usize, problem: String) -> WrongRod {
    WrongRod { argument: format!("{argument}[{index}]"), problem }
}

impl From<WrongRod> for Error {
    fn from(wrong: WrongRod) -> Self {
        let WrongRod { argument, problem } = wrong;
        Self::invalid(format!("`{argument}` is wrong: {problem}"), "")
    }
}

impl FibreViews<'_> {
    /// The section and the material of a rod, and gravity along −z.
    pub(crate) fn at(&self, rod: usize) -> Result<(Section, Material, Load), WrongRod> {
        let diameter = self.diameter.within(rod, &limits::DIAMETER)?;
        let axis_ratio = self.axis_ratio.within(rod, &limits::AXIS_RATIO)?;
        let section =
            Section::from_diameter(diameter, axis_ratio).map_err(self.diameter.wrong(rod))?;
        let e = self.youngs_modulus.within(rod, &limits::YOUNGS_MODULUS)?;
        let g = self.shear_modulus.within(rod, &limits::SHEAR_MODULUS)?;
        let density = self.density.within(rod, &limits::DENSITY)?;
        let material = Material::new(e, g, density).map_err(self.youngs_modulus.wrong(rod))?;
        let gravity = self.gravity.within(rod, &limits::GRAVITY)?;
        Ok((section, material, Load::down(gravity)))
    }
}

impl<'a> ClampViews<'a> {
    /// Goes over the rods from 0 to `count`, one block after the other, on all threads. Other threads of Python run meanwhile.
    ///
    /// # Errors
    /// About the first rod that cannot be made, and what a signal such as Ctrl-C raises.
    fn each_block(
        py: Python<'_>,
        count: usize,
        mut make: impl FnMut(Range<usize>) -> Result<(), WrongRod> + Send,
    ) -> PyResult<()> {
        work::begin(py)?;
        for first in (0..count).step_by(BLOCK) {
            py.check_signals()?;
            let made = py.detach(|| make(first..count.min(first + BLOCK)));
            made.map_err(|e| raise(py, &e.into()))?;
        }
        Ok(())
    }

    /// The tangents and the d1, in memory of their own.
    pub(crate) fn clamps(&self) -> Clamps {
        let rows = |of: &Vectors<'_>| (0..of.1.nrows()).map(|row| of.at(row)).collect();
        Clamps { tangent: rows(&self.tangent), d1: rows(&self.d1) }
    }

    /// The rods, as many as `count`, which need `each` bytes each with all that is computed of them.
    ///
    /// # Errors
    /// As [`Self::check`], and if they have no room in memory.
    pub(crate) fn rods(
        &self,
        py: Python<'_>,
        fibres: &FibreViews<'a>,
        count: usize,
        each: usize,
    ) -> PyResult<Vec<Rod>> {
        let each = each + size_of::<Rod>() + self.knots_size();
        let list = room::check("rods", count, each as f64).and_then(|()| room::list("rods", count));
        let mut rods: Vec<Rod> = list.map_err(|e| raise(py, &e))?;
        Self::each_block(py, count, |block| {
            // Each is made where it stays: a first one stands in for those that cannot be made.
            let any = self.rod(fibres, block.start)?;
            let wrong = AtomicUsize::new(usize::MAX);
            let made = block.into_par_iter().map(|rod| {
                self.rod(fibres, rod).unwrap_or_else(|_| {
                    wrong.fetch_min(rod, Ordering::Relaxed);
                    any.clone()
                })
            });
            rods.par_extend(made);
            // Of several errors that of the first rod is raised, whichever was met first.
            match wrong.into_inner() {
                usize::MAX => Ok(()),
                rod => self.rod(fibres, rod).map(drop),
            }
        })?;
        Ok(rods)
    }

    /// Checks so many rods.
    ///
    /// # Errors
    /// About the first rod that cannot be made, and what a signal such as Ctrl-C raises.
    pub(crate) fn check(
        &self,
        py: Python<'_>,
        fibres: &FibreViews<'a>,
        count: usize,
    ) -> PyResult<()> {
        Self::each_block(py, count, |block| {
            let wrong = block.into_par_iter().map(|rod| self.rod(fibres, rod));
            wrong.find_map_first(Result::err).map_or(Ok(()), Err)
        })
    }

    /// Memory of the knots of a rod (bytes).
    fn knots_size(&self) -> usize {
        let knots = self.natural_strain.as_ref().map_or(1, |profiles| profiles.0.len_of(Axis(1)));
        if knots > 1 { knots * size_of::<(f64, DVec3)>() } else { 0 }
    }

    fn rod(&self, fibres: &FibreViews<'a>, rod: usize) -> Result<Rod, WrongRod> {
        let (section, material, load) = fibres.at(rod)?;
        let (tangent, d1) = (self.tangent.at(rod), self.d1.at(rod));
        let position = self.root.within(rod, &limits::ROOT)?;
        let root = Root::from_tangent(position, tangent, d1).map_err(|problem| {
            let argument = match problem.quantity {
                "coordinate of the root" => &self.root,
                "part of d1 at right angles to the tangent" => &self.d1,
                _ => &self.tangent,
            };
            argument.wrong(rod)(problem)
        })?;
        let length = self.length.within(rod, &limits::LENGTH)?;
        let natural = self.natural(rod, length)?;
        let torsion = TorsionConstant::SaintVenant;
        let spec = RodSpec { length, section, material, torsion, natural, root, load };
        Rod::new(spec).map_err(|problem| {
            let argument = match problem.quantity {
                "length" => &self.length,
                "natural strain" => &self.curl_radius,
                // Stiffness and weight, of a fibre that is too thin or too thick for numbers.
                _ => &fibres.diameter,
            };
            argument.wrong(rod)(problem)
        })
    }

    fn natural(&self, rod: usize, length: f64) -> Result<NaturalStrain, WrongRod> {
        if let Some(profiles) = &self.natural_strain {
            return profiles.at(rod, length);
        }
        let (radius, pitch) = (self.curl_radius.at(rod), self.curl_pitch.at(rod));
        if radius == f64::INFINITY && pitch.is_finite() {
            return Ok(NaturalStrain::STRAIGHT);
        }
        let natural = NaturalStrain::helix(radius, pitch).map_err(|problem| {
            let argument =
                if problem.quantity == "curl pitch" { &self.curl_pitch } else { &self.curl_radius };
            argument.wrong(rod)(problem)
        })?;
        if let NaturalStrain::Uniform(strain) = &natural {
            let most = strain.abs().max_element();
            let index = row(rod, self.curl_radius.1.len());
            limits::STRAIN.check(most).map_err(|problem| {
                let problem = format!("with the pitch of {pitch:?} m, {problem}");
                told("curl_radius", index, problem)
            })?;
        }
        Ok(natural)
    }
}
