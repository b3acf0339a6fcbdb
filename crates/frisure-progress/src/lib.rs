//! Progress and cancellation of long computations.
//!
//! A long computation takes a `&dyn` [`Progress`]: it reports how far each stage is, and asks at
//! short intervals whether it is cancelled. `()` ignores reports and never cancels.
//!
//! ```
//! use frisure_progress::{Cancelled, CancellationToken, Progress, StageCounter};
//!
//! fn sum(values: &[f64], progress: &dyn Progress) -> Result<f64, Cancelled> {
//!     let stage = StageCounter::new(progress, "summing", values.len());
//!     let mut sum = 0.0;
//!     for value in values {
//!         stage.check()?;
//!         sum += value;
//!         stage.advance();
//!     }
//!     Ok(sum)
//! }
//!
//! assert_eq!(sum(&[1.0, 2.0], &()), Ok(3.0));
//! let token = CancellationToken::default();
//! token.cancel();
//! assert_eq!(sum(&[1.0, 2.0], &token), Err(Cancelled));
//! ```

#![forbid(unsafe_code)]

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Receives the progress of a computation and can cancel it; called from any thread.
pub trait Progress: Sync {
    /// Receives that a stage is done by this fraction (0 to 1).
    fn report(&self, stage: &str, fraction: f64);

    /// Whether the computation should stop as soon as possible.
    fn is_cancelled(&self) -> bool;

    /// An error if the computation is cancelled.
    ///
    /// # Errors
    /// [`Cancelled`], if [`Progress::is_cancelled`].
    fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

/// Ignores reports and never cancels.
impl Progress for () {
    fn report(&self, _stage: &str, _fraction: f64) {}

    fn is_cancelled(&self) -> bool {
        false
    }
}

/// The computation stopped because [`Progress::is_cancelled`] returned true.
#[derive(Clone, Copy, Debug, thiserror::Error, PartialEq, Eq)]
#[error("cancelled")]
pub struct Cancelled;

/// A flag that cancels a computation from another thread; clones share it.
#[derive(Clone, Debug, Default)]
pub struct CancellationToken(Arc<AtomicBool>);

impl CancellationToken {
    /// Cancels every computation that has this token.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Ignores reports.
impl Progress for CancellationToken {
    fn report(&self, _stage: &str, _fraction: f64) {}

    fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Passes cancellation on and ignores reports: for one of many computations that run at once.
pub struct Silent<'a>(pub &'a dyn Progress);

impl Progress for Silent<'_> {
    fn report(&self, _stage: &str, _fraction: f64) {}

    fn is_cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

/// Passes reports on as a part of one stage with another name.
pub struct SubStage<'a> {
    /// Receives the reports.
    pub progress: &'a dyn Progress,
    /// The name of the stage that is reported.
    pub stage: &'a str,
    /// The fractions of that stage at the start and at the end.
    pub range: [f64; 2],
}

impl Progress for SubStage<'_> {
    fn report(&self, _stage: &str, fraction: f64) {
        let [start, end] = self.range;
        self.progress.report(self.stage, start + fraction * (end - start));
    }

    fn is_cancelled(&self) -> bool {
        self.progress.is_cancelled()
    }
}

/// Passes reports on, and also cancels when a condition holds.
pub struct Until<'a> {
    /// Receives the reports.
    pub progress: &'a dyn Progress,
    /// The condition.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

impl Progress for Until<'_> {
    fn report(&self, stage: &str, fraction: f64) {
        self.progress.report(stage, fraction);
    }

    fn is_cancelled(&self) -> bool {
        self.progress.is_cancelled() || (self.stop)()
    }
}

/// Counts the items of one stage and reports their fraction.
pub struct StageCounter<'a> {
    progress: &'a dyn Progress,
    name: &'static str,
    total: usize,
    done: AtomicUsize,
}

/// Most reports of one stage; enough for any progress bar.
const REPORTS: usize = 100;

impl<'a> StageCounter<'a> {
    /// Reports the start of a stage of `total` items.
    #[must_use]
    pub fn new(progress: &'a dyn Progress, name: &'static str, total: usize) -> Self {
        progress.report(name, 0.0);
        Self { progress, name, total, done: AtomicUsize::new(0) }
    }

    /// Counts one more finished item.
    pub fn advance(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        let stride = (self.total / REPORTS).max(1);
        if done.is_multiple_of(stride) || done == self.total {
            self.progress.report(self.name, done as f64 / self.total as f64);
        }
    }

    /// Reports a fraction (0 to 1) of work that has no countable items.
    pub fn at(&self, fraction: f64) {
        self.progress.report(self.name, fraction.clamp(0.0, 1.0));
    }

    /// An error if the computation is cancelled.
    ///
    /// # Errors
    /// [`Cancelled`], if [`Progress::is_cancelled`].
    pub fn check(&self) -> Result<(), Cancelled> {
        self.progress.check()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    #[derive(Default)]
    struct Recorded(Mutex<Vec<(String, f64)>>);

    impl Progress for Recorded {
        fn report(&self, stage: &str, fraction: f64) {
            self.0.lock().unwrap().push((stage.to_owned(), fraction));
        }

        fn is_cancelled(&self) -> bool {
            false
        }
    }

    #[test]
    fn a_stage_reports_from_zero_to_one_at_most_a_hundred_times_between() {
        let recorded = Recorded::default();
        let stage = StageCounter::new(&recorded, "work", 1000);
        (0..1000).for_each(|_| stage.advance());
        let reports = recorded.0.into_inner().unwrap();
        assert_eq!(reports.first(), Some(&("work".to_owned(), 0.0)));
        assert_eq!(reports.last(), Some(&("work".to_owned(), 1.0)));
        assert_eq!(reports.len(), 101);
    }

    #[test]
    fn clones_of_a_token_cancel_together() {
        let token = CancellationToken::default();
        let clone = token.clone();
        assert!(token.check().is_ok());
        clone.cancel();
        assert_eq!(token.check(), Err(Cancelled));
        assert!(Silent(&token).is_cancelled());
    }

    #[test]
    fn a_sub_stage_reports_its_range_of_the_whole() {
        let recorded = Recorded::default();
        let frame = SubStage { progress: &recorded, stage: "frames", range: [0.5, 1.0] };
        frame.report("picture", 0.5);
        assert_eq!(recorded.0.into_inner().unwrap(), [("frames".to_owned(), 0.75)]);
    }
}
