//! The accumulation of samples, with pauses in which the picture so far is shown or saved.

use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use frisure::progress::{Progress, Until};
use frisure::render::trace::{Accumulator, Tracer};
use web_time::Instant;

use crate::error::Error;

/// When accumulation pauses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pauses {
    /// Least time between two pauses.
    pub(crate) every: Duration,
    /// Least time between two pauses as a multiple of the duration of the last: large pictures take long to develop
    /// and to write, and most of the time is for tracing.
    pub(crate) spacing: u32,
}

/// Keeps the last fraction that was reported.
struct LastFraction<'a> {
    progress: &'a dyn Progress,
    fraction: AtomicU32,
}

impl Progress for LastFraction<'_> {
    fn report(&self, stage: &str, fraction: f64) {
        self.fraction.store((fraction as f32).to_bits(), Ordering::Relaxed);
        self.progress.report(stage, fraction);
    }

    fn is_cancelled(&self) -> bool {
        self.progress.is_cancelled()
    }
}

/// Adds samples until the picture is finished. `at_pause` receives the samples so far and their fraction (0 to 1); it
/// also runs once after a cancellation.
///
/// # Errors
/// [`Error::Cancelled`], and those of `at_pause`.
pub(crate) fn accumulate(
    tracer: &Tracer,
    accumulator: &mut Accumulator,
    pauses: Pauses,
    progress: &dyn Progress,
    at_pause: &mut dyn FnMut(&Accumulator, f32) -> Result<(), Error>,
) -> Result<(), Error> {
    let last = LastFraction { progress, fraction: AtomicU32::new(0) };
    let mut interval = pauses.every;
    loop {
        let since = Instant::now();
        let stop = || since.elapsed() > interval;
        if tracer.accumulate(accumulator, &Until { progress: &last, stop: &stop }).is_ok() {
            return Ok(());
        }
        let pause = Instant::now();
        at_pause(accumulator, f32::from_bits(last.fraction.load(Ordering::Relaxed)))?;
        progress.check()?;
        interval = pauses.every.max(pauses.spacing * pause.elapsed());
    }
}
