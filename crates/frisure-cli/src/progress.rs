//! How far long work is.

use std::io::IsTerminal;
use std::time::Duration;

use frisure::hairstyle::Monitor;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::interrupt;

/// Progress of a long computation on standard error, if a person is looking.
#[derive(Clone)]
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// A bar, or nothing where standard error is no terminal or `quiet` is asked for.
    pub(crate) fn new(quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::stderr());
        if quiet || !std::io::stderr().is_terminal() {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        let style = ProgressStyle::with_template(
            "{msg:>20} {bar:30} {percent:>3} %  {elapsed}, {eta} left",
        );
        if let Ok(style) = style {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    /// Shows how far a stage is, 0 to 1.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    pub(crate) fn show(&self, stage: &str, fraction: f64) {
        if self.0.message() != stage {
            self.0.set_message(stage.to_owned());
            self.0.reset_eta();
        }
        self.0.set_position((fraction.clamp(0.0, 1.0) * 1000.0) as u64);
    }

    /// Does something that prints, with the bar out of its way.
    pub(crate) fn aside<T>(&self, print: impl FnOnce() -> T) -> T {
        self.0.suspend(print)
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

/// Work that is watched stops after Ctrl-C.
impl Monitor for Progress {
    fn progress(&self, stage: &'static str, fraction: f64) {
        self.show(stage, fraction);
    }

    fn cancelled(&self) -> bool {
        interrupt::interrupted()
    }
}
