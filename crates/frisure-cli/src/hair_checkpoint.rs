//! The checkpoint of simulated hairs, with what is printed about it.

use std::io;
use std::path::Path;

use frisure_engine::checkpoint::HairCheckpoint;
use frisure_engine::{Error, LoadedScene};

use crate::progress::Bar;
use crate::{console, interrupt, progress};

/// Opens the checkpoint at a path, and notes which hairs are resumed.
pub(crate) fn open(
    path: Option<&Path>,
    loaded: &LoadedScene,
    progress: &Bar,
) -> Result<Option<HairCheckpoint>, Error> {
    let Some(path) = path else { return Ok(None) };
    let checkpoint = HairCheckpoint::open(path, loaded, failed)?;
    let shown = path.display();
    if checkpoint.as_ref().is_some_and(|checkpoint| checkpoint.found() > 0) {
        let text = format!("hairs that came to rest before are taken from `{shown}`");
        progress.suspend(|| console::note(&text));
    }
    interrupt::set_resume(path.exists().then(|| {
        format!("the hairs that have converged are in the checkpoint `{shown}`; the same command resumes from it")
    }));
    Ok(checkpoint)
}

/// Removes a checkpoint: the hairs are written.
pub(crate) fn remove(checkpoint: Option<HairCheckpoint>) {
    interrupt::set_resume(None);
    if let Some(Err(error)) = checkpoint.map(HairCheckpoint::remove) {
        console::note(&format!("the checkpoint of simulated hairs could not be removed: {error}"));
    }
}

/// Tells that hairs are no longer kept.
fn failed(error: &io::Error) {
    progress::suspend(|| {
        console::note(&format!("simulated hairs cannot be kept for another time: {error}"));
    });
}
