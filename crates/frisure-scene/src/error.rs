//! What is wrong with a scene, and where.

use std::fmt;
use std::ops::Range;

use thiserror::Error;

use super::bare;
use super::source::Source;
use frisure_files::ReadError;

/// Why a scene cannot be used.
#[derive(Debug, Error)]
pub enum SceneError {
    /// Its file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Something in it is wrong.
    #[error(transparent)]
    Fault(Box<Fault>),
}

impl SceneError {
    /// What is wrong in the text, if the text could be read.
    #[must_use]
    pub fn fault(&self) -> Option<&Fault> {
        match self {
            Self::Read(_) => None,
            Self::Fault(fault) => Some(fault),
        }
    }
}

/// Something wrong at one place of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fault {
    /// Name of the file, as it was asked for.
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
    /// The value as it is written; empty for a fault that is not in a value.
    pub value: String,
    /// What is wrong, in words, when it is not that the value is outside what is allowed.
    pub problem: String,
    /// What would be allowed, in words, to follow "it must be".
    pub allowed: String,
    /// What to try.
    pub hint: String,
    /// Other places that are part of it: bytes, and what stands there.
    pub related: Vec<(Range<usize>, String)>,
}

impl Fault {
    /// What is wrong, in words.
    pub(super) fn new(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), ..Self::default() }
    }

    /// A value outside what is allowed.
    pub(super) fn outside(allowed: impl Into<String>) -> Self {
        Self { allowed: allowed.into(), ..Self::default() }
    }

    pub(super) fn key(self, key: impl Into<String>) -> Self {
        Self { key: key.into(), ..self }
    }

    pub(super) fn value(self, value: impl Into<String>) -> Self {
        Self { value: value.into(), ..self }
    }

    pub(super) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: hint.into(), ..self }
    }

    pub(super) fn related(mut self, span: Range<usize>, what: impl Into<String>) -> Self {
        self.related.push((span, what.into()));
        self
    }

    /// The fault at a place of a text.
    pub(super) fn at(self, source: &Source, span: Range<usize>) -> SceneError {
        let (line, column) = source.position(span.start);
        let (file, text) = (source.name.clone(), source.text.clone());
        let hint = match (self.hint.is_empty(), self.problem.is_empty()) {
            // A number out of range may be one in another unit.
            (true, true) => bare::hint(&self.key, source.slice(span.clone())).unwrap_or_default(),
            _ => self.hint,
        };
        SceneError::Fault(Box::new(Self { file, text, line, column, span, hint, ..self }))
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

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.file, self.line, self.column, self.message())?;
        if !self.hint.is_empty() {
            write!(f, " ({})", self.hint)?;
        }
        Ok(())
    }
}

impl std::error::Error for Fault {}
