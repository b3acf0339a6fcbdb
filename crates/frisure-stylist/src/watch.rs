//! How the work tells where it is, and is told to stop.

use std::ops::ControlFlow;

use frisure::hairstyle::Monitor;

use crate::order::Answer;

/// Watches the work on an order; called from any thread.
pub trait Watch: Sync {
    /// Something on the way: [`Answer::Progress`] or [`Answer::Exposed`].
    fn tell(&self, answer: Answer);

    /// Whether nobody waits for the answer any more.
    fn cancelled(&self) -> bool;
}

/// Watches nothing and never stops.
impl Watch for () {
    fn tell(&self, _answer: Answer) {}

    fn cancelled(&self) -> bool {
        false
    }
}

/// Tells how far a stage is (0 to 1).
pub(crate) fn progress(watch: &dyn Watch, stage: &str, fraction: f64) {
    watch.tell(Answer::Progress { stage: stage.to_owned(), fraction: fraction as f32 });
}

/// Whether to go on.
pub(crate) fn going(watch: &dyn Watch) -> ControlFlow<()> {
    if watch.cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// A watch as the hairstyle sees it.
pub(crate) struct Watched<'a>(pub(crate) &'a dyn Watch);

impl Monitor for Watched<'_> {
    fn progress(&self, stage: &'static str, fraction: f64) {
        progress(self.0, stage, fraction);
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
