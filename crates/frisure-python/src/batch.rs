//! Batches of heads: whole for `python/frisure/_batch.py`, and part by part for `python/frisure/ray.py`.

use std::path::{Path, PathBuf};

use frisure::progress::Progress;
use frisure_batch::{Batch, Run, Shard};
use frisure_engine::Error;
use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::values::{table, unwritable};
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

/// Where a batch is described; a description has the folder that its paths are relative to.
#[derive(FromPyObject)]
pub(crate) enum Spec<'py> {
    /// The text of a batch (TOML).
    Text((String, PathBuf)),
    /// The same as a mapping.
    Mapping((Bound<'py, PyMapping>, PathBuf)),
    /// A file.
    File(PathBuf),
}

/// The same without Python.
enum Source {
    File(PathBuf),
    Text { name: &'static str, text: String, folder: PathBuf },
}

impl Spec<'_> {
    fn source(self, py: Python<'_>) -> PyResult<Source> {
        Ok(match self {
            Self::File(path) => Source::File(path),
            Self::Text((text, folder)) => Source::Text { name: "<batch>", text, folder },
            Self::Mapping((mapping, folder)) => {
                let table = table(&mapping, "spec")?;
                let text = ::toml::to_string(&table).map_err(|e| unwritable(py, &e))?;
                Source::Text { name: "<dict>", text, folder }
            }
        })
    }
}

impl Source {
    fn read(&self) -> Result<Batch, Error> {
        Ok(match self {
            Self::File(path) => Batch::read(path)?,
            Self::Text { name, text, folder } => Batch::parse(name, text.as_str(), folder)?,
        })
    }
}

/// Computes all missing heads of a batch into a folder, on all processors or on so many threads; returns the number of heads, how many
/// of them were there, how many failed now, and whether there are views.
///
/// Columns that the heads do not have, and views where the folder does not last, are refused before anything is computed.
#[pyfunction]
#[pyo3(signature = (spec, folder, lasts, columns, threads, progress))]
pub(crate) fn run_batch(
    py: Python<'_>,
    spec: Spec<'_>,
    folder: PathBuf,
    lasts: bool,
    columns: Option<Vec<String>>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(usize, usize, usize, bool)> {
    let spec = spec.source(py)?;
    work::run(py, progress, move |progress| {
        let wanted = columns.unwrap_or_default();
        let run = || compute(&spec, &folder, lasts, &wanted, progress);
        let Some(threads) = threads else { return run() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|e| Error::failed(&e, "ask for fewer threads"))?.install(run)
    })
}

fn compute(
    spec: &Source,
    folder: &Path,
    lasts: bool,
    wanted: &[String],
    progress: &dyn Progress,
) -> Result<(usize, usize, usize, bool), Error> {
    let batch = spec.read()?;
    let views = batch.views().is_some();
    if views && !lasts {
        let problem = "the batch has views, which are files, and there is no folder for them";
        return Err(Error::invalid(problem, "give a folder"));
    }
    let run = Run::new(batch, folder, Shard::WHOLE)?;
    let columns = run.columns();
    if let Some(unknown) = wanted.iter().find(|name| !columns.contains(name)) {
        let problem = format!("columns has '{unknown}'; there are {}", columns.join(", "));
        return Err(Error::invalid(problem, ""));
    }
    let done = run.all(progress)?;
    Ok((done.heads, done.before, done.failed, views))
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
