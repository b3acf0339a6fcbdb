//! How long work tells where it is, and is told to stop.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Watches long work; called from any thread.
pub trait Monitor: Sync {
    /// A stage has come this far (0 to 1).
    fn progress(&self, stage: &'static str, fraction: f64);

    /// Whether to give up as soon as possible.
    fn cancelled(&self) -> bool;
}

/// Watches nothing and never stops.
impl Monitor for () {
    fn progress(&self, _stage: &'static str, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        false
    }
}

/// The work was given up because [`Monitor::cancelled`] said so.
#[derive(Clone, Copy, Debug, thiserror::Error, PartialEq, Eq)]
#[error("cancelled")]
pub struct Cancelled;

/// Counts the items of one stage.
pub(crate) struct Stage<'a> {
    monitor: &'a dyn Monitor,
    name: &'static str,
    total: usize,
    done: AtomicUsize,
}

impl<'a> Stage<'a> {
    pub(crate) fn new(monitor: &'a dyn Monitor, name: &'static str, total: usize) -> Self {
        monitor.progress(name, 0.0);
        Self { monitor, name, total, done: AtomicUsize::new(0) }
    }

    /// One more item is done.
    pub(crate) fn advance(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        // A hundred reports are enough for any bar.
        let step = (self.total / 100).max(1);
        if done.is_multiple_of(step) || done == self.total {
            self.monitor.progress(self.name, done as f64 / self.total as f64);
        }
    }

    /// Reports a fraction (0 to 1), for work whose length is not known in items.
    pub(crate) fn at(&self, fraction: f64) {
        self.monitor.progress(self.name, fraction.clamp(0.0, 1.0));
    }

    pub(crate) fn check(&self) -> Result<(), Cancelled> {
        if self.monitor.cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}
