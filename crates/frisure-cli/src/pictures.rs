//! Final pictures: traced into files, with what is printed about them.

use std::path::{Path, PathBuf};

use frisure::denoise::{Denoiser, VARIABLE};
use frisure::files::WriteError;
use frisure::look::NamedCamera;
use frisure::progress::{Cancelled, SubStage};
use frisure::render::preview::PreviewOptions;
use frisure::scene::Output;
use frisure_engine::Error;
use frisure_engine::checkpoint::picture as checkpoint;
use frisure_engine::picture::{
    self, FinalPicture, FrameSet, Frames, NoiseFilter, Subject, TraceEnd,
};

use crate::outputs::{self, numbered, suffixed};
use crate::progress::Bar;
use crate::{console, interrupt};

/// Most bytes of a pixel in a file: four numbers of an `.exr`, not compressed.
const LARGEST_PIXEL: usize = 16;

/// The pictures of one hairstyle.
#[derive(Clone, Debug)]
pub(crate) enum Views {
    /// From the scene's camera, or from each of these.
    Cameras(Vec<NamedCamera>),
    /// From all around the head.
    Turntable(Turntable),
}

impl Views {
    /// The same for the renderers.
    pub(crate) fn frames(&self) -> Frames {
        match self {
            Self::Cameras(cameras) if cameras.is_empty() => Frames::Scene,
            Self::Cameras(cameras) => {
                Frames::Azimuths(cameras.iter().map(|camera| camera.azimuth).collect())
            }
            Self::Turntable(Turntable { frames, .. }) => Frames::Turntable(*frames),
        }
    }

    /// The files of the pictures: the one, or those with the camera or the number in the name.
    pub(crate) fn paths(&self, path: &Path) -> Vec<PathBuf> {
        match self {
            Self::Cameras(cameras) if cameras.len() < 2 => vec![path.to_owned()],
            Self::Cameras(cameras) => {
                cameras.iter().map(|camera| suffixed(path, camera.name)).collect()
            }
            Self::Turntable(Turntable { frames, .. }) => {
                (0..*frames).map(|frame| numbered(path, frame, *frames)).collect()
            }
        }
    }

    /// The number of the first picture that is drawn.
    pub(crate) fn first(&self) -> usize {
        match self {
            Self::Cameras(_) => 0,
            Self::Turntable(Turntable { first, .. }) => *first,
        }
    }
}

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
    views: &Views,
    progress: &Bar,
) -> Result<Vec<String>, Error> {
    let paths = views.paths(path);
    let mut lines = Vec::new();
    for (frame, path) in paths.iter().enumerate().skip(views.first()) {
        let name = match paths.len() {
            1 => "picture".to_owned(),
            count => format!("picture {} of {count}", frame + 1),
        };
        let stage = SubStage { progress, stage: &name, range: [0.0, 1.0] };
        let mut picture = frames.open(frame, path)?;
        // Hours of work are not begun for a file that has no room.
        let bytes =
            picture.accumulator.checkpoint_size() + LARGEST_PIXEL * picture.accumulator.pixels();
        outputs::check_room(path, bytes as u64)?;
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
                if let Views::Turntable(_) = views {
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

/// Draws and writes previews of a scene's size; returns a line about each.
pub(crate) fn previews(
    subject: &Subject<'_>,
    path: &Path,
    views: &Views,
    progress: &Bar,
) -> Result<Vec<String>, Error> {
    let output = &subject.scene.output;
    let Output { width, height, samples, .. } = *output;
    let options = PreviewOptions { width, height, samples, ..PreviewOptions::default() };
    let paths = views.paths(path);
    let mut lines = Vec::new();
    subject.previews(&views.frames(), views.first(), &options, progress, &mut |index, image| {
        interrupt::check()?;
        interrupt::writing(|| picture::write(&paths[index], image, output))?;
        lines.push(console::shown(&paths[index]));
        Ok(())
    })?;
    Ok(lines)
}

/// A line about a finished picture.
fn summary(picture: &FinalPicture<'_>) -> String {
    let FinalPicture { accumulator, path, resumed_paths: before, .. } = picture;
    let (paths, noise) = (accumulator.mean_samples(), accumulator.noise());
    let mut line = format!("{}: {paths:.0} paths per pixel", console::shown(path));
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
