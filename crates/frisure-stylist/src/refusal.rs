//! Why work ends without what was asked for.

use std::error::Error;

use frisure::hairstyle::Cancelled;
use frisure::scene::SceneError;

use crate::order::{Answer, Refusal};

/// Why there is no answer.
#[derive(Debug)]
pub(crate) enum Stop {
    /// Nobody waits for it any more.
    Cancelled,
    /// It cannot be done.
    Refused(Refusal),
}

impl Refusal {
    /// A refusal that is about nothing in the scene; `hint` may be empty.
    pub(crate) fn of(error: &dyn Error, hint: &str) -> Self {
        Self { problem: sentence(error), hint: hint.to_owned(), ..Self::default() }
    }

    /// A refusal in words.
    pub(crate) fn because(problem: impl Into<String>, hint: &str) -> Self {
        Self { problem: problem.into(), hint: hint.to_owned(), ..Self::default() }
    }
}

/// An error with its causes.
fn sentence(error: &dyn Error) -> String {
    let mut sentence = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        sentence = format!("{sentence}: {error}");
        cause = error.source();
    }
    sentence
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Self {
        match error.fault() {
            None => Self::of(&error, ""),
            Some(fault) => Self {
                problem: fault.message(),
                key: fault.key.clone(),
                line: fault.line,
                hint: fault.hint.clone(),
            },
        }
    }
}

impl From<Cancelled> for Stop {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<SceneError> for Stop {
    fn from(error: SceneError) -> Self {
        Self::Refused(error.into())
    }
}

impl From<Refusal> for Stop {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<Stop> for Answer {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Cancelled => Self::Cancelled,
            Stop::Refused(refusal) => Self::Refused(refusal),
        }
    }
}
