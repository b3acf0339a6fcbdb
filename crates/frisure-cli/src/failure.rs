//! How a command ends: exit codes, and errors as people see them.

use std::error::Error;
use std::process::ExitCode;

use frisure::files::ReadError;
use frisure::scene::{Fault, SceneError};
use miette::{Diagnostic, LabeledSpan, MietteHandlerOpts, NamedSource, Report};
use thiserror::Error;

/// What a command achieved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Done {
    /// Everything.
    Well,
    /// A result that says of itself that it is not an equilibrium.
    NotConverged,
    /// A report in which a verdict fails.
    NotHeld,
}

impl Done {
    /// The exit code.
    pub(crate) fn code(self) -> ExitCode {
        match self {
            Self::Well => ExitCode::SUCCESS,
            Self::NotConverged | Self::NotHeld => ExitCode::from(3),
        }
    }
}

/// Why a command achieved nothing.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Something failed that was asked for rightly.
    Failed(Report),
    /// The command line, the scene or the head is wrong.
    Wrong(Report),
    /// Ctrl-C.
    Interrupted,
    /// Ctrl-C, with something to go on from; told in sentences.
    Paused(String),
}

impl Failure {
    /// Something failed that was asked for rightly.
    pub(crate) fn failed(error: &dyn Error) -> Self {
        Self::Failed(report(error, ""))
    }

    /// The same, with what to do.
    pub(crate) fn failed_because(error: &dyn Error, hint: &str) -> Self {
        Self::Failed(report(error, hint))
    }

    /// What was asked for is wrong; `hint` says what to do, and may be empty.
    pub(crate) fn wrong(error: &dyn Error, hint: &str) -> Self {
        Self::Wrong(report(error, hint))
    }

    /// What was asked for is wrong, in words.
    pub(crate) fn wrong_because(message: impl Into<String>, hint: &str) -> Self {
        let shown = Shown { message: message.into(), hint: some(hint), ..Shown::default() };
        Self::Wrong(shown.into())
    }

    /// The exit code.
    pub(crate) fn code(&self) -> ExitCode {
        match self {
            Self::Failed(_) => ExitCode::FAILURE,
            Self::Wrong(_) => ExitCode::from(2),
            // As shells report a death by SIGINT.
            Self::Interrupted | Self::Paused(_) => ExitCode::from(130),
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Fault(fault) => Self::Wrong(Shown::from(*fault).into()),
            SceneError::Read(error) => error.into(),
        }
    }
}

impl From<frisure_engine::Error> for Failure {
    fn from(error: frisure_engine::Error) -> Self {
        use frisure_engine::Error;
        match error {
            Error::Cancelled(_) => Self::Interrupted,
            Error::Scene(error) => error.into(),
            Error::Invalid { problem, hint } => Self::wrong_because(problem, &hint),
            error @ Error::Internal(_) => {
                Self::failed_because(&error, "please report it, with the scene")
            }
        }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self::wrong(&error, "")
    }
}

/// An error as it is shown: with the line of the scene, where there is one.
#[derive(Debug, Default, Diagnostic, Error)]
#[error("{message}")]
struct Shown {
    message: String,
    #[help]
    hint: Option<String>,
    #[source_code]
    text: Option<NamedSource<String>>,
    #[label(collection)]
    labels: Vec<LabeledSpan>,
}

impl From<Fault> for Shown {
    fn from(fault: Fault) -> Self {
        let message = fault.message();
        let label = if fault.allowed.is_empty() || !fault.problem.is_empty() {
            "here".to_owned()
        } else {
            format!("must be {}", fault.allowed)
        };
        let mut labels = vec![LabeledSpan::new_primary_with_span(Some(label), fault.span)];
        let related = fault.related.into_iter();
        labels.extend(related.map(|(span, what)| LabeledSpan::new_with_span(Some(what), span)));
        let text = Some(NamedSource::new(fault.file, fault.text));
        Self { message, hint: some(&fault.hint), text, labels }
    }
}

fn some(text: &str) -> Option<String> {
    (!text.is_empty()).then(|| text.to_owned())
}

/// An error with its causes in one sentence: `cannot write `x`: no space left`.
fn report(error: &dyn Error, hint: &str) -> Report {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        message = format!("{message}: {error}");
        cause = error.source();
    }
    Shown { message, hint: some(hint), ..Shown::default() }.into()
}

/// Sets how errors are shown.
pub(crate) fn install_handler() {
    let set = miette::set_hook(Box::new(|_| {
        // Broken lines cannot be searched for, and paths break badly.
        let options = MietteHandlerOpts::new().context_lines(1).terminal_links(false);
        Box::new(options.wrap_lines(false).build())
    }));
    // Only a second hook is refused.
    debug_assert!(set.is_ok());
}
