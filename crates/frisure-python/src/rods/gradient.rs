//! The derivatives of a loss by the properties of many rods at rest, and how the rods move along changes of them.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure::progress::{Cancelled, Progress, StageCounter};
use frisure::rod::Rod;
use frisure::rod::batch::{Batch, BatchLoss, BatchSolution, RodGradient};
use frisure::rod::derivatives::{ParameterGradient, Regularity};
use frisure_engine::Error;
use glam::DVec3;
use numpy::ndarray::ArrayView3;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::iter::{
    IndexedParallelIterator, IntoParallelIterator, ParallelExtend, ParallelIterator,
};
use rayon::slice::{ParallelSlice, ParallelSliceMut};

use super::clamp::{Clamp, Clamps};
use super::kept::{Kept, mass_per_length};
use super::motion::{self, Changes};
use crate::errors::{argument, raise};
use crate::{room, work};

/// Vectors that are copied between two looks at signals.
const BLOCK: usize = 1 << 20;

/// Numbers of a rod in the table of derivatives: by length, diameter, axis ratio, Young's and shear modulus, density and gravity; the bound of
/// the smallest eigenvalue; by gravity as a vector, root, rotation of the root, a natural strain that is the same all along, tangent and d1.
const COLUMNS: usize = 26;

/// Rods at rest, kept for their derivatives.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct RodsAtRest(Arc<Kept>);

/// The derivatives of H rods of N elements as arrays: by the natural strain of each half of an element (H, 2 N, 3); the table (H, 26) of the
/// others, see [`COLUMNS`]; whether they are regular (H,), and whether there are any (H,).
type Arrays<'py> = (
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
);

/// How nodes and their frames move (H, P, 3), by how much the energy changes, whether the derivatives are regular, and whether there are any (H,).
type Motions<'py> = (
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
);

/// The derivatives of a loss by the nodes, their frames and the energies of all rods; empty for none, and the energies may be one for all.
struct Loss {
    points: Vec<DVec3>,
    frames: Vec<DVec3>,
    energies: Vec<f64>,
}

/// The derivatives as numbers, one rod after the other.
struct Lists {
    halves: Vec<f64>,
    table: Vec<f64>,
    regular: Vec<bool>,
    exists: Vec<bool>,
}

/// Where the derivatives of a chunk of rods go.
struct ChunkOfLists<'a> {
    halves: &'a mut [f64],
    table: &'a mut [f64],
    regular: &'a mut [bool],
    exists: &'a mut [bool],
}

impl RodsAtRest {
    /// Rods of `elements` elements that were solved `chunk` at a time.
    pub(crate) fn new(
        rods: Vec<Rod>,
        elements: usize,
        chunk: usize,
        found: Vec<BatchSolution>,
        clamps: Clamps,
    ) -> Self {
        Self(Arc::new(Kept { rods, elements, chunk, found, clamps }))
    }
}

#[pymethods]
impl RodsAtRest {
    /// The derivatives of a loss by all properties, from those by the nodes and by their frames, (H, P, 3), and by the energies, (H,) or (1,).
    #[pyo3(signature = (by_points, by_frames, by_energy, progress))]
    fn vjp<'py>(
        &self,
        py: Python<'py>,
        by_points: Option<PyReadonlyArray3<'py, f64>>,
        by_frames: Option<PyReadonlyArray3<'py, f64>>,
        by_energy: Option<PyReadonlyArray1<'py, f64>>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Arrays<'py>> {
        let kept = Arc::clone(&self.0);
        let (count, elements) = (kept.rods.len(), kept.elements);
        let shape = [count, elements + 1];
        let given = usize::from(by_points.is_some()) + usize::from(by_frames.is_some());
        room::check("rods", count, kept.gradient_size(given) as f64).map_err(|e| raise(py, &e))?;
        let read = |name, by: &Option<PyReadonlyArray3<'py, f64>>| match by {
            Some(by) => vectors(py, name, by.as_array(), shape),
            None => Ok(Vec::new()),
        };
        let loss = Loss {
            points: read("by_points", &by_points)?,
            frames: read("by_frames", &by_frames)?,
            energies: by_energy.map(|by| by.as_array().to_vec()).unwrap_or_default(),
        };
        let lists = work::run(py, progress, move |p| kept.gradients(&loss, p))?;
        Ok((
            PyArray1::from_vec(py, lists.halves).reshape([count, 2 * elements, 3])?,
            PyArray1::from_vec(py, lists.table).reshape([count, COLUMNS])?,
            PyArray1::from_vec(py, lists.regular),
            PyArray1::from_vec(py, lists.exists),
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
            PyArray1::from_vec(py, moved.energy),
            PyArray1::from_vec(py, moved.regular),
            PyArray1::from_vec(py, moved.exists),
        ))
    }
}

impl Kept {
    /// Memory of the derivatives of a rod from so many arrays by its nodes (bytes).
    fn gradient_size(&self, given: usize) -> usize {
        let vector = size_of::<DVec3>();
        given * vector * (self.elements + 1)
            + vector * 2 * self.elements
            + COLUMNS * size_of::<f64>()
            + 2 * size_of::<bool>()
    }

    fn gradients(&self, loss: &Loss, progress: &dyn Progress) -> Result<Lists, Error> {
        let stage = StageCounter::new(progress, "derivatives", self.found.len());
        let mut lists = Lists::new(self.rods.len(), self.elements);
        let chunks = self.rods.par_chunks(self.chunk).zip(&self.found);
        let chunks = chunks.zip(lists.chunks(self.chunk, self.elements)).enumerate();
        chunks.try_for_each(|(i, ((rods, found), lists))| {
            stage.check()?;
            let first = i * self.chunk;
            self.gradients_of(first..first + rods.len(), found, loss, lists);
            stage.advance();
            Ok::<_, Cancelled>(())
        })?;
        Ok(lists)
    }

    /// The derivatives of some of the rods, which were solved together.
    fn gradients_of(
        &self,
        place: Range<usize>,
        found: &BatchSolution,
        loss: &Loss,
        lists: ChunkOfLists<'_>,
    ) {
        let rods = &self.rods[place.clone()];
        let nodes = self.elements + 1;
        let part = |by: &'_ [DVec3]| match by.is_empty() {
            true => 0..0,
            false => place.start * nodes..place.end * nodes,
        };
        let energies = match loss.energies.as_slice() {
            [same] => vec![*same; rods.len()],
            [] => Vec::new(),
            each => each[place.clone()].to_vec(),
        };
        let of = BatchLoss {
            positions: &loss.points[part(&loss.points)],
            frames: &loss.frames[part(&loss.frames)],
            energies: &energies,
        };
        let gradient = Batch::default().vjp(rods, found, of);
        let halves = gradient.natural_strain.iter().flatten();
        for (place, by) in lists.halves.chunks_exact_mut(3).zip(halves) {
            place.copy_from_slice(&by.to_array());
        }
        let strains = gradient.natural_strain.chunks_exact(self.elements);
        let rows = lists.table.chunks_exact_mut(COLUMNS).zip(strains);
        let flags = lists.regular.iter_mut().zip(lists.exists);
        for (i, (((rod, by), (row, strain)), (regular, exists))) in
            rods.iter().zip(&gradient.rods).zip(rows).zip(flags).enumerate()
        {
            let numbers = numbers(rod, by, strain, &self.clamps.of(place.start + i));
            row.copy_from_slice(&numbers);
            let finite = numbers.iter().all(|number| number.is_finite());
            *regular = finite && by.regularity == Ok(Regularity::Regular);
            *exists = by.regularity.is_ok();
        }
    }
}

impl Lists {
    /// Room for so many rods.
    fn new(rods: usize, elements: usize) -> Self {
        // Zeros that the system gives where they are first written: on the thread that computes them.
        Self {
            halves: vec![0.0; rods * 6 * elements],
            table: vec![0.0; rods * COLUMNS],
            regular: vec![false; rods],
            exists: vec![false; rods],
        }
    }

    /// The numbers by chunks of as many rods.
    fn chunks(
        &mut self,
        chunk: usize,
        elements: usize,
    ) -> impl IndexedParallelIterator<Item = ChunkOfLists<'_>> {
        let halves = self.halves.par_chunks_mut(chunk * 6 * elements);
        let numbers = halves.zip(self.table.par_chunks_mut(chunk * COLUMNS));
        let flags = self.regular.par_chunks_mut(chunk).zip(self.exists.par_chunks_mut(chunk));
        numbers.zip(flags).map(|((halves, table), (regular, exists))| ChunkOfLists {
            halves,
            table,
            regular,
            exists,
        })
    }
}

/// The row of a rod, see [`COLUMNS`].
fn numbers(rod: &Rod, by: &RodGradient, strain: &[[DVec3; 2]], clamp: &Clamp) -> [f64; COLUMNS] {
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
    let [density, youngs_modulus, shear_modulus] = all.material(rod);
    let [diameter, axis_ratio] = all.diameter(rod);
    let uniform = strain.iter().flatten().sum();
    let [tangent, d1] = clamp.by_vectors(by.root_rotation);
    let vectors = [by.load * mass, by.root_position, by.root_rotation, uniform, tangent, d1];
    let mut row = [0.0; COLUMNS];
    row[..8].copy_from_slice(&[
        by.length,
        diameter,
        axis_ratio,
        youngs_modulus,
        shear_modulus,
        density,
        all.weight(rod) * mass,
        by.eigenvalue_bound,
    ]);
    for (place, vector) in row[8..].chunks_exact_mut(3).zip(vectors) {
        place.copy_from_slice(&vector.to_array());
    }
    row
}

/// The rows of an array of vectors, copied on all threads.
///
/// # Errors
/// `ValueError` for another shape, and `ArgumentError` about the first number that is not finite.
fn vectors(
    py: Python<'_>,
    name: &str,
    view: ArrayView3<'_, f64>,
    [count, nodes]: [usize; 2],
) -> PyResult<Vec<DVec3>> {
    if view.shape() != [count, nodes, 3] {
        let shape = view.shape();
        let message = format!("the shape is {shape:?}; it must be [{count}, {nodes}, 3]");
        return Err(PyValueError::new_err(message));
    }
    let total = count * nodes;
    let list = room::list("vectors", total);
    let mut vectors: Vec<DVec3> = list.map_err(|e| raise(py, &e))?;
    work::begin(py)?;
    let wrong = AtomicUsize::new(usize::MAX);
    let flat = view.as_slice();
    let vector = |i: usize| {
        let vector = match flat {
            Some(numbers) => DVec3::from_slice(&numbers[3 * i..]),
            None => DVec3::from_array([0, 1, 2].map(|k| view[[i / nodes, i % nodes, k]])),
        };
        if !vector.is_finite() {
            wrong.fetch_min(i, Ordering::Relaxed);
        }
        vector
    };
    for first in (0..total).step_by(BLOCK) {
        py.check_signals()?;
        let block = first..total.min(first + BLOCK);
        py.detach(|| vectors.par_extend(block.into_par_iter().with_min_len(4096).map(vector)));
        let wrong = wrong.load(Ordering::Relaxed);
        if let Some(vector) = vectors.get(wrong) {
            let k = (0..3).find(|&k| !vector[k].is_finite()).unwrap_or_default();
            let number = if vector[k].is_nan() { "nan".into() } else { vector[k].to_string() };
            let (row, node) = (wrong / nodes, wrong % nodes);
            let problem = format!("{name}[{row}, {node}, {k}] is {number}; it must be finite");
            return Err(argument(py, &problem));
        }
    }
    Ok(vectors)
}
