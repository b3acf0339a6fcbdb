//! Errors about scenes, with their positions.

use std::fmt;
use std::ops::Range;

use frisure_files::ReadError;
use frisure_hairstyle::InvalidSpec;
use thiserror::Error;

use crate::similar::nearest;

/// Why a scene cannot be used.
#[derive(Debug, Error)]
pub enum SceneError {
    /// Its file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Something in it is wrong.
    #[error(transparent)]
    Invalid(Box<Diagnostic>),
}

/// A result with an error about a scene.
pub(crate) type Result<T, E = SceneError> = std::result::Result<T, E>;

impl SceneError {
    /// What is wrong in the text, if the text could be read.
    #[must_use]
    pub fn diagnostic(&self) -> Option<&Diagnostic> {
        match self {
            Self::Read(_) => None,
            Self::Invalid(diagnostic) => Some(diagnostic),
        }
    }
}

/// An error at one position of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnostic {
    /// Name of the file.
    pub file: String,
    /// The whole text of the file.
    pub text: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Bytes of the text that are wrong.
    pub span: Range<usize>,
    /// Path of the key, such as `hair.curl.radius`; empty if the text is not TOML.
    pub key: String,
    /// The value as it is written; empty if the error is not in a value.
    pub value: String,
    /// What is wrong, in words, when it is not that the value is outside what is allowed.
    pub problem: String,
    /// What would be allowed, in words, to follow "it must be".
    pub allowed: String,
    /// What to try.
    pub hint: String,
    /// Other places that are part of it: spans, and labels for them.
    pub related: Vec<(Range<usize>, String)>,
}

impl Diagnostic {
    /// What is wrong, in words.
    pub(crate) fn new(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), ..Self::default() }
    }

    /// A value outside what is allowed.
    pub(crate) fn outside(allowed: impl Into<String>) -> Self {
        Self { allowed: allowed.into(), ..Self::default() }
    }

    pub(crate) fn key(self, key: impl Into<String>) -> Self {
        Self { key: key.into(), ..self }
    }

    pub(crate) fn value(self, value: impl Into<String>) -> Self {
        Self { value: value.into(), ..self }
    }

    /// The same with no text longer than a person reads; a scene may have megabytes in one word.
    pub(crate) fn shortened(self) -> Self {
        let Self { key, value, problem, allowed, hint, .. } = self;
        Self {
            key: shortened(key, LONGEST_QUOTE),
            value: shortened(value, LONGEST_QUOTE),
            problem: shortened(problem, LONGEST_SENTENCE),
            allowed: shortened(allowed, LONGEST_SENTENCE),
            hint: shortened(hint, LONGEST_SENTENCE),
            ..self
        }
    }

    pub(crate) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: hint.into(), ..self }
    }

    pub(crate) fn related(mut self, span: Range<usize>, what: impl Into<String>) -> Self {
        self.related.push((span, what.into()));
        self
    }

    /// What is wrong in one sentence, without the place and the hint.
    #[must_use]
    pub fn message(&self) -> String {
        if !self.problem.is_empty() {
            return self.problem.clone();
        }
        let Self { key, value, allowed, .. } = self;
        format!("`{key}` is {value}; it must be {allowed}")
    }
}

/// Most characters of what a scene has written that an error quotes. Chosen: two lines of a terminal.
pub(crate) const LONGEST_QUOTE: usize = 200;

/// Most characters of a sentence with quotes in it, above that of the longest list of keywords. Chosen.
const LONGEST_SENTENCE: usize = 4000;

/// The first characters of a text, and an ellipsis if there are more.
pub(crate) fn shortened(mut text: String, most: usize) -> String {
    if let Some((end, _)) = text.char_indices().nth(most) {
        text.truncate(end);
        text.push('…');
    }
    text
}

/// A text of the user's as a message quotes it: at most 200 characters, none of which commands a terminal.
#[must_use]
pub fn quoted(text: &str) -> String {
    let start: String = text.chars().take(LONGEST_QUOTE + 1).collect();
    shortened(escaped(&start, |_| false), LONGEST_QUOTE)
}

/// The text with control characters as escapes, but for those that are `kept`: a terminal takes them for commands.
#[must_use]
pub fn escaped(text: &str, kept: impl Fn(char) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c.is_control() && !kept(c) {
            true => out.extend(c.escape_default()),
            false => out.push(c),
        }
    }
    out
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.file, self.line, self.column, self.message())?;
        if !self.hint.is_empty() {
            write!(f, " ({})", self.hint)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostic {}

/// The error about a value that is not of its kind.
#[derive(Default)]
pub(crate) struct ValueError {
    /// What would be allowed, in words.
    pub(crate) allowed: String,
    /// What to try; may be empty.
    pub(crate) hint: String,
    /// What is wrong, where it is not that the value is outside what is allowed.
    pub(crate) problem: String,
    /// A short form of the value, where the text itself would be long.
    pub(crate) value: Option<Box<str>>,
    /// Path inside the value, such as `.plane.normal` or `[1]`, to what is wrong.
    pub(crate) inside: Box<str>,
    /// Whether it is the key that is wrong, not its value.
    pub(crate) in_key: bool,
}

impl ValueError {
    pub(crate) fn new(allowed: impl Into<String>) -> Self {
        Self { allowed: allowed.into(), ..Self::default() }
    }

    /// The error about another problem than the kind of the value.
    pub(crate) fn because(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), ..Self::default() }
    }

    /// The error about a key that a table does not have.
    pub(crate) fn unknown_key(name: &str, known: &[&str]) -> Self {
        let hint = match nearest(name, known.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("known keys: {}", known.join(", ")),
        };
        let unknown = Self::because(format!("unknown key `{name}`")).hint(hint);
        Self { in_key: true, ..unknown }.inside(&format!(".{name}"))
    }

    /// The error about a number out of range, in a part of the value.
    pub(crate) fn out_of_range(error: &InvalidSpec, inside: &str) -> Self {
        let value = Some(error.value.as_str().into());
        Self { value, ..Self::new(error.allowed).inside(inside) }
    }

    pub(crate) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: hint.into(), ..self }
    }

    pub(crate) fn has_hint(&self) -> bool {
        !self.hint.is_empty()
    }

    /// The same, where something else is allowed too.
    pub(crate) fn or(self, also: &str) -> Self {
        Self { allowed: format!("{}, {also}", self.allowed), ..self }
    }

    /// The same, of a part of the value that is read.
    pub(crate) fn inside(self, part: &str) -> Self {
        Self { inside: format!("{part}{}", self.inside).into(), ..self }
    }
}
