//! The exit status of a command, and errors as people read them.

use std::iter;
use std::ops::Range;
use std::process::ExitCode;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use frisure::scene::Fault;
use frisure_engine::{Error, message};

/// How a command ends that has a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExitStatus {
    /// The result is complete.
    Success,
    /// Some equilibrium of the result did not converge.
    NotConverged,
    /// Some criterion of the report fails.
    #[cfg_attr(not(feature = "validate"), expect(dead_code, reason = "of `frisure validate`"))]
    CriterionFailed,
}

impl From<ExitStatus> for ExitCode {
    fn from(status: ExitStatus) -> Self {
        match status {
            ExitStatus::Success => Self::SUCCESS,
            ExitStatus::NotConverged | ExitStatus::CriterionFailed => Self::from(3),
        }
    }
}

/// The exit code of a command without a result.
pub(crate) fn exit_code(error: &Error) -> ExitCode {
    match error {
        Error::Failed { .. } | Error::Internal(_) => ExitCode::FAILURE,
        Error::Scene(_) | Error::Invalid { .. } => ExitCode::from(2),
        // As shells report a death by SIGINT.
        Error::Cancelled(_) => ExitCode::from(130),
    }
}

/// An error as text of several lines, with the line of the scene and with colours as escape sequences.
pub(crate) fn render(error: &Error) -> String {
    let fault = if let Error::Scene(error) = error { error.fault() } else { None };
    let message = fault.map_or_else(|| message(error), Fault::message);
    let labels = fault.map(labels).unwrap_or_default();
    let mut group = Group::with_title(Level::ERROR.primary_title(message.as_str()));
    if let Some(fault) = fault {
        let kinds =
            iter::once(AnnotationKind::Primary).chain(iter::repeat(AnnotationKind::Context));
        let annotations = labels.iter().zip(kinds);
        let annotations =
            annotations.map(|((span, label), kind)| kind.span(span.clone()).label(label.as_str()));
        let snippet = Snippet::source(fault.text.as_str()).path(fault.file.as_str());
        group = group.element(snippet.annotations(annotations));
    }
    let hint = fault.map_or(error.hint(), |fault| &fault.hint);
    if !hint.is_empty() {
        group = group.element(Level::HELP.message(hint));
    }
    let renderer = Renderer::styled().decor_style(DecorStyle::Unicode).term_width(10_000);
    renderer.render(&[group])
}

/// What is said about places in the scene; the first is where the error is.
fn labels(fault: &Fault) -> Vec<(Range<usize>, String)> {
    let label = if fault.allowed.is_empty() || !fault.problem.is_empty() {
        // A message about a file does not name the key that has the file.
        let message = fault.message();
        let name = fault.key.rsplit('.').next().unwrap_or_default();
        let named = message.contains(&fault.key) || message.contains(&format!("`{name}`"));
        if named { "here".to_owned() } else { format!("`{}`", fault.key) }
    } else {
        format!("must be {}", fault.allowed)
    };
    let mut labels = vec![(fault.span.clone(), label)];
    labels.extend(fault.related.iter().cloned());
    labels
}
