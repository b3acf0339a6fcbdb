//! Animated PNGs of previews: from all around the head, and of one hairstyle after the other.

use frisure::formats::picture::png;
use frisure::progress::{Progress, SubStage};
use frisure::render::MAX_SIZE;
use frisure::render::preview::{PreviewError, PreviewOptions};
use frisure::render::trace::MAX_PIXELS;

use super::options::developed;
use super::subject::{Subject, Viewpoint, project};
use crate::error::Error;

/// Most pixels of all frames of a turntable together: a quarter of a gigabyte.
const MOST_PIXELS: usize = 1 << 26;

/// Duration of a turn of the animated picture (ms); chosen.
const TURN: usize = 6000;

/// How long each picture of a film is seen (ms). Chosen: long enough to see what a step has changed.
const PAUSE: u16 = 1200;

/// An error if a turntable or a film is impossible.
pub(crate) fn check_turntable([width, height]: [usize; 2], frames: usize) -> Result<(), Error> {
    let sides = 1..=MAX_SIZE;
    if !sides.contains(&width) || !sides.contains(&height) || width * height > MAX_PIXELS {
        let error = PreviewError::Size { width, height };
        return Err(Error::because(&error, "choose a smaller picture"));
    }
    let most = (MOST_PIXELS / (width * height)).min(720);
    if (1..=most).contains(&frames) {
        return Ok(());
    }
    let problem = format!(
        "{frames} pictures of {width}×{height} pixels: a turntable or a film of this size has 1 to {most}"
    );
    Err(Error::invalid(problem, "choose fewer pictures, or smaller ones"))
}

/// The bytes of a turntable of previews, of a size that [`check_turntable`] accepts.
pub(crate) fn turntable(
    subject: &Subject<'_>,
    viewpoint: Option<Viewpoint>,
    size: [usize; 2],
    frames: usize,
    progress: &dyn Progress,
) -> Result<Vec<u8>, Error> {
    let pictures = previews(subject, viewpoint, size, frames, progress)?;
    let pause = u16::try_from((TURN / frames).clamp(20, 1000)).unwrap_or(100);
    encoded(size, &pictures, pause)
}

/// The bytes of a film of pictures (sRGB with alpha), which are the [`previews`] of hairstyles: each is seen for [`PAUSE`]. One that is the same as the one
/// before is left out.
pub(crate) fn film(size: [usize; 2], mut pictures: Vec<Vec<u8>>) -> Result<Vec<u8>, Error> {
    pictures.dedup();
    encoded(size, &pictures, PAUSE)
}

fn encoded(
    [width, height]: [usize; 2],
    pictures: &[Vec<u8>],
    pause: u16,
) -> Result<Vec<u8>, Error> {
    // Both sides are at most 16384.
    png::encode_animated(width as u32, height as u32, pictures, pause)
        .map_err(|e| Error::because(&e, ""))
}

/// Previews from around the head, or from a viewpoint alone, of a size that [`check_turntable`] accepts (sRGB with alpha, rows from the top).
pub(crate) fn previews(
    subject: &Subject<'_>,
    viewpoint: Option<Viewpoint>,
    [width, height]: [usize; 2],
    frames: usize,
    progress: &dyn Progress,
) -> Result<Vec<Vec<u8>>, Error> {
    let output = &subject.scene.output;
    let views = subject.views(viewpoint, frames, width as f64 / height as f64)?;
    let mut scene = subject.render_scene(views[0].0)?;
    let options =
        PreviewOptions { width, height, samples: output.samples, ..PreviewOptions::default() };
    let mut pictures = Vec::with_capacity(frames);
    for (frame, (camera, lights)) in views.into_iter().enumerate() {
        (scene.camera, scene.lights) = (camera, lights);
        let at = |part: f64| (frame as f64 + part) / frames as f64;
        let stage = SubStage { progress, stage: "turntable", range: [at(0.0), at(1.0)] };
        pictures.push(developed(&project(&scene, &options, &stage)?, output));
    }
    Ok(pictures)
}
