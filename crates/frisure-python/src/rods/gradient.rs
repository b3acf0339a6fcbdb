//! The derivatives of a loss by the properties of many rods at rest, and how the rods move along changes of them.

use std::sync::Arc;

use frisure::progress::{Cancelled, Progress, StageCounter};
use frisure::rod::Rod;
use frisure::rod::batch::{Batch, BatchGradient, BatchSolution, RodGradient};
use frisure::rod::derivatives::{ParameterGradient, Regularity};
use frisure_engine::Error;
use glam::DVec3;
use numpy::ndarray::{ArrayView3, Axis};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSlice;

use super::kept::{Kept, mass_per_length};
use super::motion::{self, Changes};
use crate::errors::raise;
use crate::{room, work};

/// Vectors that are copied between two looks at signals.
const BLOCK: usize = 1 << 18;

/// Rods at rest, kept for their derivatives.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct RodsAtRest(Arc<Kept>);

/// The derivatives of H rods of N elements as arrays: by the natural strain of each half of an element (H, 2 N, 3); by gravity as a
/// vector, root, rotation of the root, stiffness (H, 3); by moduli and density (H, 3): Young's, shear, density; by section (H, 2):
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

/// How nodes and their frames move (H, P, 3), and whether there are derivatives (H,).
type Motions<'py> =
    (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray3<f64>>, Bound<'py, PyArray1<bool>>);

/// The same numbers in lists.
#[derive(Default)]
struct Lists {
    halves: Vec<f64>,
    vectors: [Vec<f64>; 4],
    material: Vec<f64>,
    section: Vec<f64>,
    numbers: [Vec<f64>; 3],
    flags: [Vec<bool>; 2],
}

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
        let shape = [count, elements + 1];
        let given = 1 + usize::from(by_frames.is_some());
        room::check("rods", count, kept.gradient_size(given) as f64).map_err(|e| raise(py, &e))?;
        let by_points = vectors(py, by_points.as_array(), shape)?;
        let by_frames = by_frames.as_ref().map(|by| vectors(py, by.as_array(), shape));
        let by_frames = by_frames.transpose()?.unwrap_or_default();
        let lists = work::run(py, progress, move |p| {
            Ok(kept.lists(&kept.gradients(&by_points, &by_frames, p)?))
        })?;
        let number = |values| PyArray1::from_vec(py, values);
        let table =
            |values: Vec<f64>, columns| PyArray1::from_vec(py, values).reshape([count, columns]);
        let Lists { halves, vectors: [gravity, root, rotation, stiffness], .. } = lists;
        Ok((
            PyArray1::from_vec(py, halves).reshape([count, 2 * elements, 3])?,
            [table(gravity, 3)?, table(root, 3)?, table(rotation, 3)?, table(stiffness, 3)?],
            table(lists.material, 3)?,
            table(lists.section, 2)?,
            lists.numbers.map(number),
            lists.flags.map(|flags| PyArray1::from_vec(py, flags)),
        ))
    }

    /// How the nodes move along changes of the properties.
    #[pyo3(signature = (changes, progress))]
    fn jvp<'py>(
        &self,
        py: Python<'py>,
        changes: Changes<'py>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Motions<'py>> {
        let kept = Arc::clone(&self.0);
        let shape = [kept.rods.len(), kept.elements + 1, 3];
        // Twice: as they are computed, and in arrays.
        let each = size_of::<Vec<DVec3>>() + 4 * size_of::<DVec3>() * shape[1];
        room::check("rods", shape[0], each as f64).map_err(|e| raise(py, &e))?;
        let changes = changes.owned();
        let moved = work::run(py, progress, move |p| motion::of(&kept, &changes, p))?;
        Ok((
            PyArray1::from_vec(py, moved.points).reshape(shape)?,
            PyArray1::from_vec(py, moved.frames).reshape(shape)?,
            PyArray1::from_vec(py, moved.exists),
        ))
    }
}

impl Kept {
    /// Memory of the derivatives of a rod from so many arrays by its nodes (bytes).
    fn gradient_size(&self, given: usize) -> usize {
        let vector = size_of::<DVec3>();
        // By the halves of elements twice, as they are computed and in an array; the other arrays have 21 numbers of a rod.
        given * vector * (self.elements + 1)
            + 2 * vector * 2 * self.elements
            + size_of::<RodGradient>()
            + 21 * size_of::<f64>()
    }

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

    fn lists(&self, gradients: &[BatchGradient]) -> Lists {
        let mut lists = Lists::default();
        let halves = gradients.iter().flat_map(|gradient| &gradient.natural_strain).flatten();
        lists.halves.extend(halves.flat_map(DVec3::to_array));
        let by_rods = gradients.iter().flat_map(|gradient| &gradient.rods);
        for (rod, by) in self.rods.iter().zip(by_rods) {
            lists.push(rod, by);
        }
        lists
    }
}

impl Lists {
    /// Appends the derivatives by all of a rod but its natural strain.
    fn push(&mut self, rod: &Rod, by: &RodGradient) {
        // Without natural strain, which the properties of material and section do not need.
        let all = ParameterGradient {
            natural_strain: Vec::new(),
            length: Some(by.length),
            stiffness: by.stiffness,
            load: by.load,
            root_position: by.root_position,
            root_rotation: by.root_rotation,
        };
        // Weight per length is ρ S g.
        let mass = mass_per_length(rod);
        let vectors = [by.load * mass, by.root_position, by.root_rotation, by.stiffness];
        for (list, vector) in self.vectors.iter_mut().zip(vectors) {
            list.extend(vector.to_array());
        }
        let [density, youngs_modulus, shear_modulus] = all.material(rod);
        self.material.extend([youngs_modulus, shear_modulus, density]);
        self.section.extend(all.diameter(rod));
        let numbers = [by.length, all.weight(rod) * mass, by.eigenvalue_bound];
        for (list, number) in self.numbers.iter_mut().zip(numbers) {
            list.push(number);
        }
        self.flags[0].push(by.regularity == Ok(Regularity::Regular));
        self.flags[1].push(by.regularity.is_ok());
    }
}

/// The rows of an array of vectors.
fn vectors(
    py: Python<'_>,
    view: ArrayView3<'_, f64>,
    [count, nodes]: [usize; 2],
) -> PyResult<Vec<DVec3>> {
    if view.shape() != [count, nodes, 3] {
        let shape = view.shape();
        let message = format!("the shape is {shape:?}; it must be [{count}, {nodes}, 3]");
        return Err(PyValueError::new_err(message));
    }
    let list = room::list("vectors", count * nodes);
    let mut vectors: Vec<DVec3> = list.map_err(|e| raise(py, &e))?;
    for block in view.axis_chunks_iter(Axis(0), (BLOCK / nodes).max(1)) {
        py.check_signals()?;
        let rows = block.rows().into_iter();
        vectors.extend(rows.map(|row| DVec3::new(row[0], row[1], row[2])));
    }
    Ok(vectors)
}
