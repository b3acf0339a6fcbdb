//! The equilibria of many rods, by the solver in SIMD lanes.

use frisure::progress::{Cancelled, Progress, StageCounter};
use frisure::rod::batch::{Batch, BatchSolution, Precision, RodSolution};
use frisure::rod::{Rod, Stability};
use frisure_engine::Error;
use numpy::{PyArray1, PyArray3, PyArray4, PyArrayMethods};
use pyo3::prelude::*;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use rayon::slice::{ParallelSlice, ParallelSliceMut};

use super::fibres::{Clamped, Fibres};
use super::gradient::RodsAtRest;
use crate::work;

/// Elements of the rods that one thread solves at a time: a cancellation waits for them. 512 rods of 15 elements, as in
/// the benchmark `batch` of `frisure-rod`.
const CHUNK_ELEMENTS: usize = 512 * 15;

/// Fewest and most rods that one thread solves at a time; the fewest fill the widest vector. The result does not depend on
/// how many there are.
const CHUNK: (usize, usize) = (8, 512);

/// Largest weight against elasticity, ρSgL³/EI with the smaller EI, of a rod that is called stable. Chosen: of 20 000 rods out of the whole ranges, the
/// equilibria that the second variation called minima and that other tolerances did not confirm had 1e12 and more; a hair of a metre has 1e4.
const MOST_HEAVINESS: f64 = 1e10;

/// What is computed of rods.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    elements: usize,
    tolerance: f64,
    single: bool,
    /// Whether the nodes are wanted.
    points: bool,
    /// Whether the error of the nodes is estimated, for which the rods are solved with fewer elements, too.
    error: bool,
    /// Whether the frames of the nodes are wanted.
    frames: bool,
    /// Whether the smallest eigenvalues are wanted.
    eigenvalue: bool,
    /// Whether the rods are kept, for their derivatives.
    derivatives: bool,
}

/// Rods at rest: one value for each, and nodes and their coordinates one rod after the other; empty lists of what is not wanted.
#[derive(Default)]
struct Rest {
    points: Vec<f64>,
    frames: Vec<f64>,
    eigenvalue: Vec<f64>,
    energy: Vec<f64>,
    stable: Vec<bool>,
    gradient: Vec<f64>,
    iterations: Vec<u32>,
    error: Vec<f64>,
    /// The solutions of the chunks, for derivatives.
    found: Vec<Option<BatchSolution>>,
}

/// Where the results of a chunk of rods go.
struct ChunkOfRest<'a> {
    points: &'a mut [f64],
    frames: &'a mut [f64],
    eigenvalue: &'a mut [f64],
    energy: &'a mut [f64],
    stable: &'a mut [bool],
    gradient: &'a mut [f64],
    iterations: &'a mut [u32],
    error: &'a mut [f64],
    found: &'a mut Option<BatchSolution>,
}

impl Options {
    fn solve(&self, rods: &[Rod], progress: &dyn Progress) -> Result<Rest, Error> {
        let (nodes, count) = (self.elements + 1, rods.len());
        let room = |wanted: bool, each: usize| vec![0.0; if wanted { count * each } else { 0 }];
        let mut rest = Rest {
            points: room(self.points, 3 * nodes),
            frames: room(self.frames, 9 * nodes),
            eigenvalue: room(self.eigenvalue, 1),
            energy: vec![0.0; count],
            stable: vec![false; count],
            gradient: vec![0.0; count],
            iterations: vec![0; count],
            error: room(self.error, 1),
            found: Vec::new(),
        };
        let chunk = self.chunk();
        rest.found.resize_with(count.div_ceil(chunk), || None);
        let stage = StageCounter::new(progress, "rods", count.div_ceil(chunk));
        rods.par_chunks(chunk).zip(rest.chunks(chunk, nodes)).try_for_each(|(rods, rest)| {
            stage.check()?;
            self.solve_chunk(rods, rest);
            stage.advance();
            Ok::<(), Cancelled>(())
        })?;
        Ok(rest)
    }

    /// Memory of what is computed of a rod (bytes).
    fn size(&self) -> usize {
        let nodes = size_of::<[f64; 3]>() * (self.elements + 1);
        // Energy, gradient, error and eigenvalue; iterations, and whether it is stable.
        let numbers = 4 * size_of::<f64>() + size_of::<u32>() + size_of::<bool>();
        // The solution, and tangent, d1 and curl in Python.
        let clamp = 8 * size_of::<f64>();
        let kept = size_of::<RodSolution>() + clamp + size_of::<[f64; 3]>() * self.elements;
        let sizes = [(self.points, nodes), (self.frames, 3 * nodes), (self.derivatives, kept)];
        numbers + sizes.iter().filter(|(wanted, _)| *wanted).map(|(_, size)| size).sum::<usize>()
    }

    /// Rods that one thread solves at a time.
    fn chunk(&self) -> usize {
        (CHUNK_ELEMENTS / self.elements).clamp(CHUNK.0, CHUNK.1)
    }

    fn batch(&self) -> Batch {
        Batch {
            elements: self.elements,
            tolerance: self.tolerance,
            precision: if self.single { Precision::Single } else { Precision::Double },
            ..Batch::default()
        }
    }

    fn solve_chunk(&self, rods: &[Rod], mut rest: ChunkOfRest<'_>) {
        let found = self.rest_chunk(rods, &mut rest);
        *rest.found = self.derivatives.then_some(found);
    }

    fn rest_chunk(&self, rods: &[Rod], rest: &mut ChunkOfRest<'_>) -> BatchSolution {
        let found = self.batch().solve(rods);
        for (i, rod) in found.rods.iter().enumerate() {
            rest.energy[i] = rod.energy;
            rest.stable[i] =
                rod.stability == Stability::Stable && rods[i].heaviness() <= MOST_HEAVINESS;
            rest.gradient[i] = rod.gradient_norm;
            rest.iterations[i] = u32::try_from(rod.iterations).unwrap_or(u32::MAX);
        }
        if self.eigenvalue {
            rest.eigenvalue.copy_from_slice(&found.min_eigenvalues(rods));
        }
        self.put_nodes(rods, &found, rest);
        if self.error {
            rest.error.copy_from_slice(&self.batch().errors(rods, &found));
        }
        found
    }

    /// Puts the nodes and their frames in their places, as far as they are wanted.
    fn put_nodes(&self, rods: &[Rod], found: &BatchSolution, rest: &mut ChunkOfRest<'_>) {
        let (points, _) = rest.points.as_chunks_mut();
        if self.frames {
            let (frames, _) = rest.frames.as_chunks_mut();
            let nodes = found.nodes(rods);
            for ((_, frame), place) in nodes.iter().zip(frames) {
                *place = frame.to_cols_array();
            }
            for ((position, _), place) in nodes.iter().zip(points) {
                *place = position.to_array();
            }
        } else if self.points {
            found.put_positions(rods, points);
        }
    }
}

impl Rest {
    /// The results by chunks of as many rods, with `nodes` of each rod.
    fn chunks(
        &mut self,
        chunk: usize,
        nodes: usize,
    ) -> impl IndexedParallelIterator<Item = ChunkOfRest<'_>> {
        let chunks = self.energy.len().div_ceil(chunk);
        let points = split(&mut self.points, chunk * 3 * nodes, chunks);
        let frames = split(&mut self.frames, chunk * 9 * nodes, chunks);
        let error = split(&mut self.error, chunk, chunks);
        let eigenvalue = split(&mut self.eigenvalue, chunk, chunks);
        let wanted = points.into_par_iter().zip(frames).zip(error.into_par_iter().zip(eigenvalue));
        let numbers = self.energy.par_chunks_mut(chunk).zip(self.gradient.par_chunks_mut(chunk));
        let counts = self.stable.par_chunks_mut(chunk).zip(self.iterations.par_chunks_mut(chunk));
        wanted.zip(&mut self.found).zip(numbers.zip(counts)).map(
            |(
                (((points, frames), (error, eigenvalue)), found),
                ((energy, gradient), (stable, iterations)),
            )| ChunkOfRest {
                points,
                frames,
                eigenvalue,
                energy,
                stable,
                gradient,
                iterations,
                error,
                found,
            },
        )
    }
}

/// The chunks of a list; as many empty ones of an empty list.
fn split(values: &mut [f64], chunk: usize, chunks: usize) -> Vec<&mut [f64]> {
    if values.is_empty() {
        return (0..chunks).map(|_| &mut [][..]).collect();
    }
    values.chunks_mut(chunk).collect()
}

/// Rods at rest as arrays: nodes (H, P, 3) if they are wanted, energy, stable, gradient, iterations; error, eigenvalue and frames (H, P, 3, 3), rows d1, d2
/// and tangent, if they are wanted, and the rods if derivatives are.
type Arrays<'py> = (
    Option<Bound<'py, PyArray3<f64>>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<u32>>,
    Option<Bound<'py, PyArray1<f64>>>,
    Option<Bound<'py, PyArray1<f64>>>,
    Option<Bound<'py, PyArray4<f64>>>,
    Option<Bound<'py, RodsAtRest>>,
);

/// Checks what `count` rods are made of, without solving them.
#[pyfunction]
#[pyo3(signature = (count, fibres, clamped))]
pub(crate) fn check_rods<'py>(
    py: Python<'py>,
    count: usize,
    fibres: Fibres<'py>,
    clamped: Clamped<'py>,
) -> PyResult<()> {
    clamped.views().check(py, &fibres.views(), count)
}

/// The equilibria of `count` rods.
#[pyfunction]
#[pyo3(signature = (count, fibres, clamped, options, progress))]
pub(crate) fn settle_rods<'py>(
    py: Python<'py>,
    count: usize,
    fibres: Fibres<'py>,
    clamped: Clamped<'py>,
    options: Options,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Arrays<'py>> {
    let views = clamped.views();
    let rods = views.rods(py, &fibres.views(), count, options.size())?;
    let clamps = views.clamps();
    let nodes = options.elements + 1;
    let (points, frames) = (options.points, options.frames);
    let (error, eigenvalue) = (options.error, options.eigenvalue);
    let (elements, chunk) = (options.elements, options.chunk());
    let (rods, rest) = work::run(py, progress, move |p| {
        let rest = options.solve(&rods, p)?;
        Ok((rods, rest))
    })?;
    let found: Option<Vec<BatchSolution>> = rest.found.into_iter().collect();
    let at_rest =
        found.map(|found| Bound::new(py, RodsAtRest::new(rods, elements, chunk, found, clamps)));
    let positions = PyArray1::from_vec(py, rest.points);
    let turns = PyArray1::from_vec(py, rest.frames);
    Ok((
        points.then(|| positions.reshape([count, nodes, 3])).transpose()?,
        PyArray1::from_vec(py, rest.energy),
        PyArray1::from_vec(py, rest.stable),
        PyArray1::from_vec(py, rest.gradient),
        PyArray1::from_vec(py, rest.iterations),
        error.then(|| PyArray1::from_vec(py, rest.error)),
        eigenvalue.then(|| PyArray1::from_vec(py, rest.eigenvalue)),
        frames.then(|| turns.reshape([count, nodes, 3, 3])).transpose()?,
        at_rest.transpose()?,
    ))
}
