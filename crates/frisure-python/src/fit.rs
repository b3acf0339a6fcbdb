//! Fits of measured fibres; `python/frisure/fits.py` has the shapes and units.

use frisure::fit::{Estimate, Fibre, Fit, FitStatus, Known, KnownError, Options, Pose, fit};
use frisure_engine::Error;
use glam::DVec3;
use numpy::ndarray::{ArrayView1, ArrayView2};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::raise;
use crate::work;

/// Lines: points (N, 3) of all, where each begins (H + 1), the arc length of each point (N) or none, gravity (H, 3), state (H), and the fibre of each (H): 0, 1, ….
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Lines<'py> {
    points: PyReadonlyArray2<'py, f64>,
    offsets: PyReadonlyArray1<'py, i64>,
    arc_length: Option<PyReadonlyArray1<'py, f64>>,
    gravity: PyReadonlyArray2<'py, f64>,
    state: PyReadonlyArray1<'py, i64>,
    fibre: PyReadonlyArray1<'py, i64>,
    /// Of each fibre, or NaN.
    length: PyReadonlyArray1<'py, f64>,
}

/// What is known: rows of a value and a deviation, one for all fibres or one for each; none where nothing is known.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct KnownArrays<'py> {
    stiffness_over_weight: Option<PyReadonlyArray2<'py, f64>>,
    torsion_ratio: Option<PyReadonlyArray2<'py, f64>>,
    curvature: Option<PyReadonlyArray2<'py, f64>>,
    torsion: Option<PyReadonlyArray2<'py, f64>>,
    axis_ratio: Option<PyReadonlyArray2<'py, f64>>,
}

/// Lines that are read between two looks at signals.
const BLOCK: usize = 1024;

/// An error about an argument.
fn wrong(argument: &str, index: usize, problem: &dyn std::fmt::Display) -> Error {
    Error::invalid(format!("`{argument}[{index}]` is wrong: {problem}"), "")
}

fn fibres(py: Python<'_>, lines: &Lines<'_>) -> PyResult<Vec<Fibre>> {
    let points = lines.points.as_array();
    let offsets = lines.offsets.as_array();
    let arcs = lines.arc_length.as_ref().map(PyReadonlyArray1::as_array);
    let (gravity, states) = (lines.gravity.as_array(), lines.state.as_array());
    let lengths = lines.length.as_array();
    let mut poses: Vec<Vec<(usize, Pose)>> = vec![Vec::new(); lengths.len()];
    for line in 0..states.len() {
        if line % BLOCK == 0 {
            py.check_signals()?;
        }
        let range = index(offsets, line)..index(offsets, line + 1);
        let vectors = range.clone().map(|i| row(points, i)).collect();
        let arc = arcs.map(|arcs| range.map(|i| arcs[i]).collect());
        let state = index(states, line);
        let pose = Pose::new(vectors, arc, row(gravity, line), state);
        let pose = pose.map_err(|problem| raise(py, &wrong("strands", line, &problem)))?;
        poses[index(lines.fibre.as_array(), line)].push((line, pose));
    }
    let fibre = |(fibre, poses): (usize, Vec<(usize, Pose)>)| {
        let length = Some(lengths[fibre]).filter(|length| !length.is_nan());
        let first = poses.first().map_or(0, |(line, _)| *line);
        Fibre::new(poses.into_iter().map(|(_, pose)| pose).collect(), length)
            .map_err(|problem| raise(py, &wrong("strands", first, &problem)))
    };
    poses.into_iter().enumerate().map(fibre).collect()
}

/// A number that the caller has checked to be an index.
fn index(numbers: ArrayView1<'_, i64>, at: usize) -> usize {
    usize::try_from(numbers[at]).unwrap_or(0)
}

fn row(vectors: ArrayView2<'_, f64>, at: usize) -> DVec3 {
    DVec3::new(vectors[[at, 0]], vectors[[at, 1]], vectors[[at, 2]])
}

impl KnownArrays<'_> {
    fn rows(&self) -> usize {
        let arrays = [
            &self.stiffness_over_weight,
            &self.torsion_ratio,
            &self.curvature,
            &self.torsion,
            &self.axis_ratio,
        ];
        let rows = |array: &PyReadonlyArray2<'_, f64>| array.as_array().nrows();
        arrays.into_iter().flatten().map(rows).max().unwrap_or(1)
    }

    fn known(&self) -> Result<Vec<Known>, Error> {
        (0..self.rows()).map(|i| self.of(i)).collect()
    }

    fn of(&self, fibre: usize) -> Result<Known, Error> {
        let estimate = |array: &Option<PyReadonlyArray2<'_, f64>>| {
            let array = array.as_ref()?.as_array();
            let row = if array.nrows() == 1 { 0 } else { fibre };
            Some(Estimate { value: array[[row, 0]], deviation: array[[row, 1]] })
        };
        let known = Known {
            stiffness_over_weight: estimate(&self.stiffness_over_weight),
            torsion_ratio: estimate(&self.torsion_ratio),
            curvature: estimate(&self.curvature),
            torsion: estimate(&self.torsion),
            axis_ratio: estimate(&self.axis_ratio),
        };
        let told = |problem: KnownError| {
            let key = match problem.quantity {
                "stiffness over weight" => "stiffness_over_weight",
                "torsional over bending stiffness" => "torsion_ratio",
                "natural curvature" => "curvature",
                "natural torsion" => "torsion",
                _ => "axis_ratio",
            };
            wrong(&format!("known['{key}']"), fibre, &problem)
        };
        known.check().map_err(told)?;
        Ok(known)
    }
}

/// Curvature, torsion, radius, pitch, GJ/EI and axis ratio, each with its deviation; noise, reduced square; status, iterations.
fn numbers(fit: &Fit) -> [f64; 16] {
    let pair = |estimate: Estimate| [estimate.value, estimate.deviation];
    let pairs = [
        pair(fit.curvature),
        pair(fit.torsion),
        pair(fit.curl_radius),
        pair(fit.curl_pitch),
        pair(fit.torsion_ratio),
        pair(fit.axis_ratio),
        [fit.noise, fit.reduced_square],
        [status(fit), fit.iterations as f64],
    ];
    let mut all = [0.0; 16];
    for (place, number) in all.iter_mut().zip(pairs.into_iter().flatten()) {
        *place = number;
    }
    all
}

fn status(fit: &Fit) -> f64 {
    match fit.status {
        FitStatus::Fitted => 0.0,
        FitStatus::Misfit => 1.0,
        FitStatus::NotConverged => 2.0,
    }
}

/// The numbers of fibres as a dict of lists.
#[pyfunction]
#[pyo3(signature = (lines, known, noise, knots, progress))]
pub(crate) fn fit_fibres<'py>(
    py: Python<'py>,
    lines: Lines<'py>,
    known: KnownArrays<'py>,
    noise: Option<f64>,
    knots: usize,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = Options { noise, knots };
    options.check().map_err(|problem| raise(py, &Error::because(&problem, "")))?;
    let fibres = fibres(py, &lines)?;
    let known = known.known().map_err(|error| raise(py, &error))?;
    let (names, fits) = work::run(py, progress, move |p| {
        let fits = fit(&fibres, &known, &options, p)?;
        Ok((fits.iter().map(Fit::statements).collect::<Vec<_>>(), fits))
    })?;
    let found = PyDict::new(py);
    let states = fits.iter().map(|fit| fit.length.len()).max().unwrap_or(1);
    let by_state = |of: fn(&Fit) -> &[Estimate]| -> Vec<Vec<[f64; 2]>> {
        let padded = |fit: &Fit| -> Vec<[f64; 2]> {
            let given = of(fit).iter().map(|e| [e.value, e.deviation]);
            given.chain(std::iter::repeat([f64::NAN; 2])).take(states).collect()
        };
        fits.iter().map(padded).collect()
    };
    found.set_item("numbers", fits.iter().map(numbers).collect::<Vec<_>>())?;
    found.set_item("stiffness", by_state(|fit| &fit.stiffness_over_weight))?;
    found.set_item("length", by_state(|fit| &fit.length))?;
    found.set_item("torsion_ratio", by_state(|fit| &fit.torsion_ratio_by_state))?;
    found.set_item("covariance", fits.iter().map(|fit| fit.covariance).collect::<Vec<_>>())?;
    let profile = |fit: &Fit| -> Vec<[[f64; 2]; 2]> {
        fit.profile.iter().map(|knot| knot.map(|e| [e.value, e.deviation])).collect()
    };
    found.set_item("profile", fits.iter().map(profile).collect::<Vec<_>>())?;
    let vectors = |line: &Vec<DVec3>| line.iter().map(DVec3::to_array).collect::<Vec<_>>();
    let of_fibre = |fit: &Fit| fit.lines.iter().map(vectors).collect::<Vec<_>>();
    found.set_item("lines", fits.iter().map(of_fibre).collect::<Vec<_>>())?;
    found.set_item("statements", names)?;
    Ok(found)
}
