//! The exit status of a command, and errors as people read them.

use std::iter;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use frisure::scene::Diagnostic;
use frisure_engine::{Error, message};

/// How a command ends that has a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExitStatus {
    /// The result is complete.
    Success,
    /// Some equilibrium of the result did not converge, or is unstable.
    NotConverged,
    /// Every equilibrium converged, but some misses the requested accuracy, or may be unstable.
    Uncertain,
    /// What was given does not tell the result: the reason is printed.
    Abstained,
    /// Some criterion of the report fails.
    #[cfg_attr(not(feature = "validate"), expect(dead_code, reason = "of `frisure validate`"))]
    CriterionFailed,
}

impl From<ExitStatus> for u8 {
    fn from(status: ExitStatus) -> Self {
        match status {
            ExitStatus::Success => 0,
            ExitStatus::NotConverged | ExitStatus::CriterionFailed => 3,
            ExitStatus::Uncertain => 4,
            ExitStatus::Abstained => 5,
        }
    }
}

/// The exit status of a command without a result.
pub(crate) fn exit_code(error: &Error) -> u8 {
    match error {
        Error::Failed { .. } | Error::Internal(_) => 1,
        Error::Scene(_) | Error::Invalid { .. } => 2,
        // As shells report a death by SIGINT.
        Error::Cancelled(_) => 130,
    }
}

/// An error as text of several lines, with the line of the scene and with colours as escape sequences.
pub(crate) fn render(error: &Error) -> String {
    rendered(error, &Renderer::styled())
}

/// An error as text of several lines, as a person reads it on a terminal, without colours.
#[must_use]
pub fn plain(error: &Error) -> String {
    rendered(error, &Renderer::plain())
}

fn rendered(error: &Error, renderer: &Renderer) -> String {
    let diagnostic = if let Error::Scene(error) = error { error.diagnostic() } else { None };
    let message = shortened(&diagnostic.map_or_else(|| message(error), Diagnostic::message));
    // A scene without a name is that of a command's arguments, and has no lines to show.
    let excerpt = diagnostic.filter(|found| !found.file.is_empty()).map(Excerpt::of);
    let mut group = Group::with_title(Level::ERROR.primary_title(message.as_str()));
    if let (Some(diagnostic), Some(excerpt)) = (diagnostic, &excerpt) {
        let kinds =
            iter::once(AnnotationKind::Primary).chain(iter::repeat(AnnotationKind::Context));
        let annotations = excerpt.labels.iter().zip(kinds);
        let annotations =
            annotations.map(|((span, label), kind)| kind.span(span.clone()).label(label.as_str()));
        let snippet = Snippet::source(excerpt.text).line_start(excerpt.line);
        let snippet = snippet.path(diagnostic.file.as_str());
        group = group.element(snippet.annotations(annotations));
    }
    let hint = shortened(diagnostic.map_or(error.hint(), |diagnostic| &diagnostic.hint));
    if !hint.is_empty() {
        group = group.element(Level::HELP.message(hint.as_str()));
    }
    let renderer = renderer.clone().decor_style(DecorStyle::Unicode).term_width(10_000);
    renderer.render(&[group])
}

/// The part of a scene that is shown with an error.
struct Excerpt<'a> {
    text: &'a str,
    /// Its first line, from 1.
    line: usize,
    /// Places in the text, and what is said about them.
    labels: Vec<(Range<usize>, String)>,
}

/// Longest part of a scene that is annotated as it is (bytes); of a longer one, the beginning is shown. Chosen.
const LONGEST_PLACE: usize = 1000;

/// Characters shown of a place that is longer, or in a longer line. Chosen: two lines of a terminal.
const SHOWN: usize = 200;

/// The text with the beginning of each word that is longer than a path: tables, grooms and arguments are quoted as they are.
fn shortened(text: &str) -> String {
    let short = |word: &str| match word.len() > LONGEST_PLACE {
        true => {
            let space = word.chars().last().filter(|c| c.is_whitespace());
            word.chars().take(SHOWN).chain(['…']).chain(space).collect()
        }
        false => word.to_owned(),
    };
    text.split_inclusive(char::is_whitespace).map(short).collect()
}

impl<'a> Excerpt<'a> {
    fn of(diagnostic: &'a Diagnostic) -> Self {
        let text = diagnostic.text.as_str();
        let labels = labels(diagnostic);
        let long = |(span, _): &(Range<usize>, String)| {
            let start = text[..span.start].rfind('\n').map_or(0, |i| i + 1);
            let end = text[span.end..].find('\n').map_or(text.len(), |i| span.end + i);
            end - start > LONGEST_PLACE
        };
        if !labels.iter().any(long) {
            return Self { text, line: 1, labels };
        }
        let Range { start, end } = diagnostic.span.clone();
        let shown = text[start..].char_indices().nth(SHOWN).map_or(text.len(), |(i, _)| start + i);
        let label = labels.into_iter().next().map_or_else(String::new, |(_, label)| label);
        let labels = vec![(0..end.min(shown) - start, label)];
        Self { text: &text[start..shown], line: diagnostic.line, labels }
    }
}

/// The labels of places in the scene; the first is that of the error.
fn labels(diagnostic: &Diagnostic) -> Vec<(Range<usize>, String)> {
    let label = if diagnostic.allowed.is_empty() || !diagnostic.problem.is_empty() {
        // A message about a file does not name the key that has the file.
        let message = diagnostic.message();
        let name = diagnostic.key.rsplit('.').next().unwrap_or_default();
        let named = message.contains(&diagnostic.key) || message.contains(&format!("`{name}`"));
        if named { "here".to_owned() } else { format!("`{}`", diagnostic.key) }
    } else {
        format!("must be {}", diagnostic.allowed)
    };
    let mut labels = vec![(diagnostic.span.clone(), label)];
    labels.extend(diagnostic.related.iter().cloned());
    labels
}
