//! The natural strains of rods that hang in given shapes.

use frisure::progress::{Progress, StageCounter};
use frisure::rod::inverse::{InverseSolution, solve};
use frisure::rod::{
    InvalidQuantity, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Stability,
    TorsionConstant,
};
use frisure_engine::Error;
use glam::DVec3;
use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray3};
use pyo3::prelude::*;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::fibres::{FibreViews, Fibres, WrongRod};
use super::limits::{LENGTH, POINT};
use crate::errors::raise;
use crate::{room, work};

/// Largest weight of a line against the stiffness of its fibre, ρSgL³/EI, as of scenes: a hair of a metre has some ten thousand. Beyond it a unit was
/// mistaken, and the search takes minutes.
const MOST_HEAVINESS: f64 = 1e8;

/// Lines that are read between two looks at signals.
const BLOCK: usize = 256;

/// A line, and the fibre that hangs in its shape.
struct Given {
    line: Vec<DVec3>,
    fibre: RodSpec,
}

/// What is found of each line.
struct Found {
    length: f64,
    /// Natural strains (rad/m) at as many knots as the line has points, which divide the length evenly.
    strain: Vec<DVec3>,
    /// Root frame: d1, d2 and the tangent.
    frame: [DVec3; 3],
    stable: bool,
    error: f64,
    stiffness_needed: f64,
}

impl Given {
    fn new(line: Vec<DVec3>, fibres: &FibreViews<'_>, index: usize) -> Result<Self, WrongRod> {
        let (section, material, load) = fibres.at(index)?;
        // Length, natural strain and root are those of the line.
        let root = Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y).expect("a frame");
        let torsion = TorsionConstant::SaintVenant;
        let natural = NaturalStrain::STRAIGHT;
        let fibre = RodSpec { length: 1.0, section, material, torsion, natural, root, load };
        Ok(Self { line, fibre })
    }

    /// What is wrong with the line, in words.
    fn fault(&self) -> Option<String> {
        let coordinates = self.line.iter().flat_map(DVec3::to_array);
        let wrong = coordinates.into_iter().find_map(|x| POINT.check(x).err());
        let length = self.line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        wrong.or_else(|| LENGTH.check(length).err()).or_else(|| {
            let heaviness = Rod::new(RodSpec { length, ..self.fibre.clone() }).ok()?.heaviness();
            (heaviness > MOST_HEAVINESS).then(|| {
                format!(
                    "its length is {length:.3} m, and its weight {heaviness:.0e} times its stiffness (rho S g L^3 / EI); it must be at most \
                     {MOST_HEAVINESS:.0e}: are the points in metres?"
                )
            })
        })
    }

    fn solve(&self, options: &Options) -> Result<Found, InvalidQuantity> {
        let InverseSolution { rod, equilibrium, error, stiffness_needed, .. } =
            solve(&self.line, &self.fibre, &[], options)?;
        let length = rod.length();
        // The strain jumps between the elements of the rod: means over the part nearest to each knot.
        let step = length / (self.line.len() - 1) as f64;
        let between = |k: usize| (step * (k as f64 - 0.5)).clamp(0.0, length);
        let strain =
            (0..self.line.len()).map(|k| rod.natural().mean(between(k), between(k + 1))).collect();
        let frame = rod.root().frame();
        Ok(Found {
            length,
            strain,
            frame: [frame.x_axis, frame.y_axis, frame.z_axis],
            stable: stiffness_needed <= 1.0
                && equilibrium.certificate.stability == Stability::Stable,
            error,
            stiffness_needed,
        })
    }
}

fn solve_all(given: &[Given], accuracy: f64, progress: &dyn Progress) -> Result<Vec<Found>, Error> {
    let resolution = Resolution::Accuracy(accuracy);
    let options = Options { resolution, ..Options::default() };
    let wrong = |i: usize, e: String| Error::invalid(format!("`points[{i}]` is wrong: {e}"), "");
    // Before any is solved, which takes long.
    let mut faults = given.iter().enumerate().filter_map(|(i, given)| Some((i, given.fault()?)));
    if let Some((i, fault)) = faults.next() {
        return Err(wrong(i, fault));
    }
    let stage = StageCounter::new(progress, "rods", given.len());
    let found: Vec<Result<Found, Error>> = (given.par_iter().enumerate())
        .map(|(i, given)| {
            stage.check()?;
            let found = given.solve(&options);
            stage.advance();
            found.map_err(|e| wrong(i, e.to_string()))
        })
        .collect();
    // Of several errors the first is raised, whichever was met first.
    progress.check()?;
    found.into_iter().collect()
}

/// The inverse solutions as arrays: length, natural strain (H, P, 3), frame (H, 3, 3), stable, error, stiffness needed.
type Arrays<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

/// The natural strains of rods that hang in the shapes of lines (H, P, 3).
#[pyfunction]
#[pyo3(signature = (points, fibres, accuracy, progress))]
pub(crate) fn inverse_rods<'py>(
    py: Python<'py>,
    points: PyReadonlyArray3<'py, f64>,
    fibres: Fibres<'py>,
    accuracy: f64,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Arrays<'py>> {
    let points = &points.as_array();
    let (count, nodes, _) = points.dim();
    let views = fibres.views();
    let point = |i, k| DVec3::from_array([0, 1, 2].map(|c| points[[i, k, c]]));
    let line = |i| (0..nodes).map(|k| point(i, k)).collect();
    // The line twice, as points and as a strain, which the solver has at twice as many elements.
    let each = size_of::<Given>() + size_of::<Found>() + 6 * size_of::<DVec3>() * nodes;
    let list = room::check("lines", count, each as f64).and_then(|()| room::list("lines", count));
    let mut given: Vec<Given> = list.map_err(|e| raise(py, &e))?;
    for i in 0..count {
        if i % BLOCK == 0 {
            py.check_signals()?;
        }
        given.push(Given::new(line(i), &views, i).map_err(|e| raise(py, &e.into()))?);
    }
    let found = work::run(py, progress, move |p| solve_all(&given, accuracy, p))?;
    let numbers = |of: fn(&Found) -> f64| PyArray1::from_iter(py, found.iter().map(of));
    let vectors = |of: fn(&Found) -> &[DVec3], rows: usize| {
        let values = found.iter().flat_map(of).flat_map(DVec3::to_array);
        PyArray1::from_iter(py, values).reshape([count, rows, 3])
    };
    Ok((
        numbers(|found| found.length),
        vectors(|found| &found.strain, nodes)?,
        vectors(|found| &found.frame, 3)?,
        PyArray1::from_iter(py, found.iter().map(|found| found.stable)),
        numbers(|found| found.error),
        numbers(|found| found.stiffness_needed),
    ))
}
