//! Batches of heads, part by part, for `python/frisure/ray.py`.

use std::path::PathBuf;

use frisure_batch::{Batch, Run, Shard};
use frisure_engine::Error;
use pyo3::prelude::*;

use crate::work;

/// The number of parts of a batch, and the indices of those that are not in a folder; creates the folder.
#[pyfunction]
pub(crate) fn missing_parts(
    py: Python<'_>,
    spec: PathBuf,
    folder: PathBuf,
) -> PyResult<(usize, Vec<usize>)> {
    work::run(py, None, move |_| {
        let run = Run::new(Batch::read(&spec)?, &folder, Shard::WHOLE)?;
        let missing = run.missing()?.into_iter().map(|part| part.number).collect();
        Ok((run.parts().count(), missing))
    })
}

/// Computes one of so many parts of a batch into a folder on so many threads, unless it is there; returns the number of its
/// heads, how many of them were there, and how many failed now.
#[pyfunction]
pub(crate) fn compute_part(
    py: Python<'_>,
    spec: PathBuf,
    folder: PathBuf,
    part: usize,
    parts: usize,
    threads: usize,
) -> PyResult<(usize, usize, usize)> {
    work::run(py, None, move |progress| {
        let shard = Shard::new(part + 1, parts).map_err(|e| Error::because(&e, ""))?;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|e| Error::failed(&e, "ask for fewer threads"))?;
        let done = pool.install(|| {
            let run = Run::new(Batch::read(&spec)?, &folder, shard)?;
            run.all(progress).map_err(Error::from)
        })?;
        Ok((done.heads, done.before, done.failed))
    })
}
