//! The checkpoint of simulated hairs, with what is printed about it.

use std::path::Path;

use frisure_engine::checkpoint::HairCheckpoint;
use frisure_engine::{Error, LoadedScene};

use crate::console;
use crate::progress::Bar;

/// Opens the checkpoint at a path, and notes which hairs are resumed.
pub(crate) fn open(
    path: Option<&Path>,
    loaded: &LoadedScene,
    progress: &Bar,
) -> Result<Option<HairCheckpoint>, Error> {
    let Some(path) = path else { return Ok(None) };
    let checkpoint = HairCheckpoint::open(path, loaded)?;
    if checkpoint.as_ref().is_some_and(|checkpoint| checkpoint.found() > 0) {
        let text = format!("hairs that came to rest before are taken from `{}`", path.display());
        progress.suspend(|| console::note(&text));
    }
    Ok(checkpoint)
}

/// Adds how to resume to a cancellation, if there is a checkpoint.
pub(crate) fn resumable(error: Error, path: Option<&Path>) -> Error {
    match (error, path.filter(|path| path.exists())) {
        (Error::Cancelled(_), Some(path)) => Error::Paused(format!(
            "hairs that have come to rest are kept in `{}`; the same command goes on from there",
            path.display()
        )),
        (error, _) => error,
    }
}

/// Removes a checkpoint: the hairs are written.
pub(crate) fn remove(checkpoint: Option<HairCheckpoint>) {
    if let Some(Err(error)) = checkpoint.map(HairCheckpoint::remove) {
        console::note(&format!("simulated hairs could not be kept for another time: {error}"));
    }
}
