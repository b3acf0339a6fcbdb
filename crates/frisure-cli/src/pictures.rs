//! Final pictures: traced into files, with what is printed about them.

use std::path::{Path, PathBuf};

use frisure::denoise::{Denoiser, VARIABLE};
use frisure::files::WriteError;
use frisure::progress::{Cancelled, SubStage};
use frisure_engine::Error;
use frisure_engine::checkpoint::picture as checkpoint;
use frisure_engine::picture::{FinalPicture, FrameSet, NoiseFilter, TraceEnd};

use crate::outputs::{self, numbered};
use crate::progress::Bar;
use crate::{console, interrupt};

/// Pictures from all around the head.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turntable {
    /// Number of pictures.
    pub(crate) frames: usize,
    /// The first that is drawn.
    pub(crate) first: usize,
}

/// The filter for a percentage of the noise, if it is wanted.
pub(crate) fn noise_filter(percent: Option<f32>) -> Result<Option<NoiseFilter>, Error> {
    let Some(percent) = percent else { return Ok(None) };
    let denoiser = Denoiser::find().map_err(|e| {
        let hint = format!(
            "install Open Image Denoise (openimagedenoise.org), or name its library in {VARIABLE} (what it \
             needs itself must be found, too: LD_LIBRARY_PATH); \
             without --denoise, more --paths have the same effect"
        );
        Error::failed(&e, &hint)
    })?;
    Ok(Some(NoiseFilter { denoiser, fraction: 0.01 * percent }))
}

/// The files of the pictures: numbered for a turntable, or the one.
pub(crate) fn paths(path: &Path, turntable: Option<Turntable>) -> Vec<PathBuf> {
    match turntable {
        Some(Turntable { frames, .. }) => {
            (0..frames).map(|frame| numbered(path, frame, frames)).collect()
        }
        None => vec![path.to_owned()],
    }
}

/// Prepares to write pictures with their checkpoints, and other files; none may be one of the `inputs`.
pub(crate) fn prepare(
    pictures: &[PathBuf],
    others: &[&Path],
    inputs: &[&Path],
) -> Result<(), Error> {
    let checkpoints: Vec<_> = pictures.iter().map(|path| checkpoint::path_for(path)).collect();
    let mut all = others.to_vec();
    all.extend(pictures.iter().map(PathBuf::as_path));
    all.extend(checkpoints.iter().map(PathBuf::as_path));
    outputs::prepare(&all, inputs)?;
    checkpoints.iter().try_for_each(|path| checkpoint::check(path))
}

/// Traces and writes the pictures; returns a line about each.
pub(crate) fn trace(
    mut frames: FrameSet,
    path: &Path,
    turntable: Option<Turntable>,
    progress: &Bar,
) -> Result<Vec<String>, Error> {
    let paths = paths(path, turntable);
    let mut lines = Vec::new();
    for (frame, path) in paths.iter().enumerate().skip(turntable.map_or(0, |t| t.first)) {
        let name = match turntable {
            Some(Turntable { frames, .. }) => format!("picture {} of {frames}", frame + 1),
            None => "picture".to_owned(),
        };
        let stage = SubStage { progress, stage: &name, range: [0.0, 1.0] };
        let mut picture = frames.open(frame, path)?;
        if let Some(old) = &picture.moved_to {
            let (path, old) = (checkpoint::path_for(path), old.display());
            let path = path.display();
            console::note(&format!(
                "`{path}` is of another picture, or damaged; it is now `{old}`"
            ));
        }
        match interrupt::writing(|| picture.trace(&stage))? {
            TraceEnd::Finished => lines.push(summary(&picture)),
            TraceEnd::Cancelled(saved) => {
                let mut text = interruption(&picture, saved.err().as_ref());
                if turntable.is_some() {
                    text +=
                        &format!(" With `--from {frame}` the frames before are not drawn again.");
                }
                interrupt::set_resume(Some(text));
                return Err(Cancelled.into());
            }
        }
    }
    Ok(lines)
}

/// A line about a finished picture.
fn summary(picture: &FinalPicture<'_>) -> String {
    let FinalPicture { accumulator, path, resumed_paths: before, .. } = picture;
    let (paths, noise) = (accumulator.mean_samples(), accumulator.noise());
    let mut line = format!("{}: {paths:.0} paths per pixel", path.display());
    if *before > 0.0 {
        line += &format!(", {before:.0} of them from before");
    }
    if noise.is_finite() {
        line += &format!(", noise {:.1} %", 100.0 * noise);
    }
    line
}

/// What an interrupted picture has, and how to resume it.
fn interruption(picture: &FinalPicture<'_>, unsaved: Option<&WriteError>) -> String {
    let (path, paths) = (picture.path.display(), picture.accumulator.mean_samples());
    let so_far = format!("`{path}` is what there is so far, {paths:.0} paths per pixel;");
    match unsaved {
        None => format!("{so_far} the same command resumes from there."),
        Some(error) => format!("{so_far} it cannot go on from there: {error}."),
    }
}
