//! Final pictures in memory.

use frisure::progress::Progress;
use frisure::render::Image;
use frisure::render::trace::TraceOptions;

use super::subject::Subject;
use crate::error::Error;

impl Subject<'_> {
    /// The final picture from the scene's camera, as [`super::FrameSet`] writes it, without a file and without checkpoints.
    ///
    /// # Errors
    /// [`Error::Cancelled`] and [`Error::Invalid`].
    pub fn traced(&self, options: &TraceOptions, progress: &dyn Progress) -> Result<Image, Error> {
        let tracer = self.tracer(None, options)?;
        let mut accumulator = tracer.accumulator();
        tracer.accumulate(&mut accumulator, progress)?;
        Ok(accumulator.image())
    }
}
