//! The derivatives of a loss by the properties of many rods at rest.

use std::sync::Arc;

use frisure::progress::{Cancelled, Progress, StageCounter};
use frisure::rod::Rod;
use frisure::rod::batch::{Batch, BatchGradient, BatchSolution};
use frisure::rod::derivatives::{ParameterGradient, Regularity};
use frisure_engine::Error;
use glam::DVec3;
use numpy::ndarray::ArrayView3;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSlice;

use crate::work;

/// Rods at rest, kept for their derivatives.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct RodsAtRest(Arc<Kept>);

struct Kept {
    rods: Vec<Rod>,
    elements: usize,
    /// Rods of each solution but the last.
    chunk: usize,
    found: Vec<BatchSolution>,
}

/// The derivatives of H rods of N elements as arrays: by the natural strain of each half of an element (H, 2 N, 3); by load,
/// root, rotation of the root, stiffness (H, 3); by moduli and density (H, 3): Young's, shear, density; by section (H, 2):
/// diameter, axis ratio; by length, by gravity, bound of the smallest eigenvalue (H,); whether they are regular (H,), and
/// whether there are any (H,).
type Arrays<'py> = (
    Bound<'py, PyArray3<f64>>,
    [Bound<'py, PyArray2<f64>>; 4],
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    [Bound<'py, PyArray1<f64>>; 3],
    [Bound<'py, PyArray1<bool>>; 2],
);

impl RodsAtRest {
    /// Rods of `elements` elements that were solved `chunk` at a time.
    pub(crate) fn new(
        rods: Vec<Rod>,
        elements: usize,
        chunk: usize,
        found: Vec<BatchSolution>,
    ) -> Self {
        Self(Arc::new(Kept { rods, elements, chunk, found }))
    }
}

#[pymethods]
impl RodsAtRest {
    /// The derivatives of a loss by all properties, from those by the nodes, (H, P, 3).
    #[pyo3(signature = (by_points, by_frames, progress))]
    fn vjp<'py>(
        &self,
        py: Python<'py>,
        by_points: PyReadonlyArray3<'py, f64>,
        by_frames: Option<PyReadonlyArray3<'py, f64>>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Arrays<'py>> {
        let kept = Arc::clone(&self.0);
        let (count, elements) = (kept.rods.len(), kept.elements);
        let by_points = vectors(by_points.as_array(), [count, elements + 1])?;
        let by_frames = by_frames.as_ref().map(|by| vectors(by.as_array(), [count, elements + 1]));
        let by_frames = by_frames.transpose()?.unwrap_or_default();
        let gradients = work::run(py, progress, {
            let kept = Arc::clone(&kept);
            move |p| kept.gradients(&by_points, &by_frames, p)
        })?;
        let rods = || gradients.iter().flat_map(|gradient| &gradient.rods);
        let flat = |vectors: &mut dyn Iterator<Item = DVec3>| -> Vec<f64> {
            vectors.flat_map(|v| v.to_array()).collect()
        };
        let table = |values: Vec<f64>, columns: usize| {
            PyArray1::from_vec(py, values).reshape([count, columns])
        };
        let vector = |values: &mut dyn Iterator<Item = DVec3>| table(flat(values), 3);
        let number = |values: &mut dyn Iterator<Item = f64>| {
            PyArray1::from_vec(py, values.collect::<Vec<_>>())
        };
        let by_rods: Vec<(ParameterGradient, &Rod)> = rods()
            .zip(&kept.rods)
            .map(|(by, rod)| {
                // Without natural strain, which the properties of material and section do not need.
                let by = ParameterGradient {
                    natural_strain: Vec::new(),
                    length: Some(by.length),
                    stiffness: by.stiffness,
                    load: by.load,
                    root_position: by.root_position,
                    root_rotation: by.root_rotation,
                };
                (by, rod)
            })
            .collect();
        let halves = gradients.iter().flat_map(|gradient| &gradient.natural_strain).flatten();
        let material = by_rods.iter().flat_map(|(by, rod)| {
            let [density, youngs_modulus, shear_modulus] = by.material(rod);
            [youngs_modulus, shear_modulus, density]
        });
        let section = by_rods.iter().flat_map(|(by, rod)| by.diameter(rod));
        // Weight per length is ρ S g.
        let gravity = by_rods.iter().map(|(by, rod)| {
            by.weight(rod) * rod.spec().material.density() * rod.spec().section.area()
        });
        Ok((
            PyArray1::from_vec(py, flat(&mut halves.copied())).reshape([count, 2 * elements, 3])?,
            [
                vector(&mut rods().map(|rod| rod.load))?,
                vector(&mut rods().map(|rod| rod.root_position))?,
                vector(&mut rods().map(|rod| rod.root_rotation))?,
                vector(&mut rods().map(|rod| rod.stiffness))?,
            ],
            table(material.collect(), 3)?,
            table(section.collect(), 2)?,
            [
                number(&mut rods().map(|rod| rod.length)),
                number(&mut gravity.into_iter()),
                number(&mut rods().map(|rod| rod.eigenvalue_bound)),
            ],
            [
                PyArray1::from_iter(py, rods().map(|r| r.regularity == Ok(Regularity::Regular))),
                PyArray1::from_iter(py, rods().map(|rod| rod.regularity.is_ok())),
            ],
        ))
    }
}

impl Kept {
    fn gradients(
        &self,
        by_points: &[DVec3],
        by_frames: &[DVec3],
        progress: &dyn Progress,
    ) -> Result<Vec<BatchGradient>, Error> {
        let stage = StageCounter::new(progress, "derivatives", self.found.len());
        let nodes = self.chunk * (self.elements + 1);
        let chunks = self.rods.par_chunks(self.chunk).zip(&self.found).enumerate();
        let gradients = chunks.map(|(i, (rods, found))| {
            stage.check()?;
            let part = |by: &'_ [DVec3]| -> std::ops::Range<usize> {
                (i * nodes).min(by.len())..((i + 1) * nodes).min(by.len())
            };
            let (points, frames) = (&by_points[part(by_points)], &by_frames[part(by_frames)]);
            let gradient = Batch::default().vjp(rods, found, points, frames);
            stage.advance();
            Ok::<_, Cancelled>(gradient)
        });
        Ok(gradients.collect::<Result<Vec<_>, _>>()?)
    }
}

/// The rows of an array of vectors.
fn vectors(view: ArrayView3<'_, f64>, [count, nodes]: [usize; 2]) -> PyResult<Vec<DVec3>> {
    if view.shape() != [count, nodes, 3] {
        let shape = view.shape();
        let message = format!("the shape is {shape:?}; it must be [{count}, {nodes}, 3]");
        return Err(PyValueError::new_err(message));
    }
    let rows = view.rows().into_iter();
    Ok(rows.map(|row| DVec3::new(row[0], row[1], row[2])).collect())
}
