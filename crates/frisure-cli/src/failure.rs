//! How a command ends: exit codes, and errors as people see them.

use std::error::Error;
use std::ops::Range;
use std::process::ExitCode;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use frisure::files::ReadError;
use frisure::scene::{Fault, SceneError};

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
    Failed(Diagnostic),
    /// The command line, the scene or the head is wrong.
    Wrong(Diagnostic),
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
        Self::Wrong(Diagnostic::new(message.into(), hint))
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
            SceneError::Fault(fault) => Self::Wrong(Diagnostic::from(*fault)),
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

/// An error for people: with the line of the scene, where there is one.
#[derive(Debug)]
pub(crate) struct Diagnostic {
    message: String,
    hint: String,
    source: Option<Source>,
}

/// A text, and what is said about places in it; the first place is the error's.
#[derive(Debug)]
struct Source {
    file: String,
    text: String,
    labels: Vec<(Range<usize>, String)>,
}

impl Diagnostic {
    fn new(message: String, hint: &str) -> Self {
        Self { message, hint: hint.to_owned(), source: None }
    }

    /// The diagnostic as text of several lines, with colours as escape sequences.
    pub(crate) fn render(&self) -> String {
        let mut group = Group::with_title(Level::ERROR.primary_title(self.message.as_str()));
        if let Some(Source { file, text, labels }) = &self.source {
            let mut kinds = std::iter::once(AnnotationKind::Primary);
            let annotations = labels.iter().map(|(span, label)| {
                let kind = kinds.next().unwrap_or(AnnotationKind::Context);
                kind.span(span.clone()).label(label.as_str())
            });
            group = group.element(
                Snippet::source(text.as_str()).path(file.as_str()).annotations(annotations),
            );
        }
        if !self.hint.is_empty() {
            group = group.element(Level::HELP.message(self.hint.as_str()));
        }
        let renderer = Renderer::styled().decor_style(DecorStyle::Unicode).term_width(10_000);
        renderer.render(&[group])
    }
}

impl From<Fault> for Diagnostic {
    fn from(fault: Fault) -> Self {
        let message = fault.message();
        let label = if fault.allowed.is_empty() || !fault.problem.is_empty() {
            // A message about a file does not name the key that the file stands at.
            let name = fault.key.rsplit('.').next().unwrap_or_default();
            let named = message.contains(&fault.key) || message.contains(&format!("`{name}`"));
            if named { "here".to_owned() } else { format!("`{}`", fault.key) }
        } else {
            format!("must be {}", fault.allowed)
        };
        let mut labels = vec![(fault.span, label)];
        labels.extend(fault.related);
        let source = Some(Source { file: fault.file, text: fault.text, labels });
        Self { message, hint: fault.hint, source }
    }
}

/// An error with its causes in one sentence: `cannot write `x`: no space left`.
fn report(error: &dyn Error, hint: &str) -> Diagnostic {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        message = format!("{message}: {error}");
        cause = error.source();
    }
    Diagnostic::new(message, hint)
}
