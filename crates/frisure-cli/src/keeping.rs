//! Simulated hairs that are kept while they come to rest, so that the same command goes on after Ctrl-C or a crash.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{HairModel, Hairstyle, HairstyleSpec, simulation_key};
use frisure_engine::CheckpointFile;

use crate::console;
use crate::failure::Failure;
use crate::progress::Bar;

/// Fewer hairs than this are not worth a file: they take seconds.
const MANY: usize = 50_000;

/// The file that keeps the simulated hairs of an output, `curls.hair.hairs.part`; none for other hairs, and for devices.
pub(crate) fn part(spec: &HairstyleSpec, output: &Path) -> Option<PathBuf> {
    if spec.wisps.strands != HairModel::Simulated {
        return None;
    }
    if std::fs::metadata(output).is_ok_and(|found| !found.is_file()) {
        return None;
    }
    let mut name = output.file_name()?.to_owned();
    name.push(".hairs.part");
    Some(output.with_file_name(name))
}

/// Refuses to begin where a file of somebody else's would be overwritten.
pub(crate) fn check(parts: &[PathBuf]) -> Result<(), Failure> {
    for path in parts {
        let ours = match CheckpointFile::is_one(path) {
            Ok(ours) => ours,
            Err(error) => error.kind() == ErrorKind::NotFound,
        };
        if !ours {
            let message = format!("`{}` is in the way: it keeps no hairs", path.display());
            let hint = "simulated hairs so far are kept under that name; move the file away";
            return Err(Failure::wrong_because(message, hint));
        }
    }
    Ok(())
}

/// What is kept for a hairstyle; none if that is not worth it.
pub(crate) fn open(
    part: Option<PathBuf>,
    hairstyle: &Hairstyle,
    head: &Head,
    progress: &Bar,
) -> Result<Option<CheckpointFile>, Failure> {
    let Some(path) = part.filter(|_| hairstyle.drawn() >= MANY) else { return Ok(None) };
    let Some(key) = simulation_key(hairstyle, head) else { return Ok(None) };
    let kept = CheckpointFile::open(&path, key).map_err(|e| Failure::failed(&e))?;
    if kept.found() > 0 {
        let text = format!("hairs that came to rest before are taken from `{}`", path.display());
        progress.aside(|| console::note(&text));
    }
    Ok(Some(kept))
}

/// What became of work that was interrupted.
pub(crate) fn interrupted(failure: Failure, part: Option<&Path>) -> Failure {
    match (failure, part.filter(|path| path.exists())) {
        (Failure::Interrupted, Some(path)) => Failure::Paused(format!(
            "hairs that have come to rest are kept in `{}`; the same command goes on from there",
            path.display()
        )),
        (failure, _) => failure,
    }
}

/// Takes away what was kept: what it was kept for is written.
pub(crate) fn done(kept: Option<CheckpointFile>) {
    if let Some(Err(error)) = kept.map(CheckpointFile::remove) {
        console::note(&format!("simulated hairs could not be kept for another time: {error}"));
    }
}
