//! Final pictures: traced into files, with a checkpoint of each.

use std::path::{Path, PathBuf};
use std::time::Duration;

use frisure::files::{WriteError, write_atomically};
use frisure::look::{Camera, Lights};
use frisure::progress::Progress;
use frisure::render::trace::{Accumulator, TraceOptions, Tracer};
use frisure::scene::Output;

use super::accumulate::{Pauses, accumulate};
use super::denoise::NoiseFilter;
use super::file::write_traced;
use super::subject::{Frames, Subject};
use crate::checkpoint::picture as checkpoint;
use crate::error::Error;

/// When the picture so far is saved: every minute, and for at most a twentieth of the time; chosen.
const PAUSES: Pauses = Pauses { every: Duration::from_mins(1), spacing: 20 };

/// The final pictures of a subject, as its [`Frames`] say.
pub struct FrameSet {
    tracer: Tracer,
    /// What differs between the pictures.
    views: Vec<(Camera, Lights)>,
    output: Output,
    filter: Option<NoiseFilter>,
}

/// A final picture and its file.
pub struct FinalPicture<'a> {
    frames: &'a FrameSet,
    /// The samples so far.
    pub accumulator: Accumulator,
    /// The file.
    pub path: PathBuf,
    /// Mean number of paths per pixel that were in the checkpoint.
    pub resumed_paths: f64,
    /// The new name of the checkpoint of another picture that was in the way.
    pub moved_to: Option<PathBuf>,
}

/// How the tracing of a picture ends.
#[derive(Debug)]
pub enum TraceEnd {
    /// The picture is written.
    Finished,
    /// The picture so far is written, and its samples are in the checkpoint, unless that failed.
    Cancelled(Result<(), WriteError>),
}

impl FrameSet {
    /// Prepares the pictures.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub fn new(
        subject: &Subject<'_>,
        options: &TraceOptions,
        frames: &Frames,
        filter: Option<NoiseFilter>,
    ) -> Result<Self, Error> {
        let views = subject.frames(frames, options.width as f64 / options.height as f64)?;
        let tracer = subject.tracer_from(views[0].0, options)?;
        Ok(Self { tracer, views, output: subject.scene.output, filter })
    }

    /// Begins the picture of a frame, or resumes it from its checkpoint.
    ///
    /// # Errors
    /// [`Error`], for a frame with impossible light and for a checkpoint that cannot be read.
    pub fn open(&mut self, frame: usize, path: &Path) -> Result<FinalPicture<'_>, Error> {
        if let Some((camera, lights)) = self.views.get(frame) {
            self.tracer.look_from(camera, lights).map_err(|e| Error::because(&e, ""))?;
        }
        let (found, moved_to) = checkpoint::resume(&checkpoint::path_for(path), &self.tracer)?;
        let accumulator = found.unwrap_or_else(|| self.tracer.accumulator());
        let resumed_paths = accumulator.mean_samples();
        Ok(FinalPicture { frames: self, accumulator, path: path.into(), resumed_paths, moved_to })
    }

    fn write(&self, path: &Path, accumulator: &Accumulator) -> Result<(), Error> {
        let (image, layers) = (accumulator.image(), accumulator.layers());
        let denoised = self.filter.map(|filter| filter.apply(&image, &layers)).transpose()?;
        let images = (&image, denoised.as_ref());
        write_traced(path, images, layers, accumulator.mean_samples(), &self.output)
    }
}

impl FinalPicture<'_> {
    /// Traces and writes the picture; saves picture and checkpoint on the way, and after a cancellation.
    ///
    /// # Errors
    /// [`Error::Failed`], if the picture cannot be written.
    pub fn trace(&mut self, progress: &dyn Progress) -> Result<TraceEnd, Error> {
        let Self { frames, path, accumulator, .. } = self;
        let checkpoint = checkpoint::path_for(path);
        let mut saved = Ok(());
        let end = accumulate(&frames.tracer, accumulator, PAUSES, progress, &mut |so_far, _| {
            frames.write(path, so_far)?;
            // A checkpoint that cannot be saved now may be at the next time.
            saved = write_atomically(&checkpoint, |out| out.write_all(&so_far.to_bytes()));
            Ok(())
        });
        match end {
            Ok(()) => {
                frames.write(path, accumulator)?;
                // A checkpoint that cannot be removed does no harm.
                let _ = std::fs::remove_file(checkpoint);
                Ok(TraceEnd::Finished)
            }
            Err(Error::Cancelled(_)) => Ok(TraceEnd::Cancelled(saved)),
            Err(error) => Err(error),
        }
    }
}
