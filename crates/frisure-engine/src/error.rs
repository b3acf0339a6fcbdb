//! Why a computation has no result, and the one place where a panic becomes such a reason.

use std::any::Any;
use std::error::Error as StdError;
use std::panic::{AssertUnwindSafe, catch_unwind};

use frisure::files::ReadError;
use frisure::hairstyle::styling::StyleError;
use frisure::hairstyle::{HistoryError, PredictError};
use frisure::progress::Cancelled;
use frisure::scene::{Scene, SceneError};
use thiserror::Error;

/// Why a computation has no result.
#[derive(Debug, Error)]
pub enum Error {
    /// [`frisure::progress::Progress::is_cancelled`] returned true.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The scene, or a file that it names, is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The request is impossible.
    #[error("{problem}")]
    Invalid {
        /// What is wrong.
        problem: String,
        /// What to do; may be empty.
        hint: String,
    },
    /// The request is possible, and something else failed, such as a disk.
    #[error("{problem}")]
    Failed {
        /// What is wrong.
        problem: String,
        /// What to do; may be empty.
        hint: String,
    },
    /// A panic in the computation: a mistake in this program.
    #[error("internal error: {0}")]
    Internal(String),
}

impl Error {
    /// An impossible request; `hint` may be empty.
    pub fn invalid(problem: impl Into<String>, hint: &str) -> Self {
        Self::Invalid { problem: problem.into(), hint: hint.to_owned() }
    }

    /// The same with the message of an error and of its causes.
    pub fn because(error: &dyn StdError, hint: &str) -> Self {
        Self::invalid(message(error), hint)
    }

    /// A failure of something else than the request, with the message of an error and of its causes; `hint` may be
    /// empty.
    pub fn failed(error: &dyn StdError, hint: &str) -> Self {
        Self::Failed { problem: message(error), hint: hint.to_owned() }
    }

    /// What to do; may be empty. The hint of a [`Self::Scene`] is in it.
    #[must_use]
    pub fn hint(&self) -> &str {
        match self {
            Self::Invalid { hint, .. } | Self::Failed { hint, .. } => hint,
            Self::Internal(_) => "please report it, with the scene",
            Self::Cancelled(_) | Self::Scene(_) => "",
        }
    }

    /// The error of a prediction, at the key of the scene that has to change.
    pub(crate) fn of_prediction(error: &PredictError, scene: &Scene) -> Self {
        Self::Scene(match error {
            PredictError::Cancelled(cancelled) => return Self::Cancelled(*cancelled),
            PredictError::Quantity(error) => scene.quantity_error(error),
            PredictError::Parting(e) => {
                let key = format!("implantation.partings[{}].line[{}]", e.index, e.place);
                scene.error_at(&key, e.to_string(), "")
            }
            PredictError::Crowded(e) => scene.error_at("wisps.count", e.to_string(), ""),
            PredictError::Spec(error) => scene.spec_error(error),
        })
    }

    /// The error of a styling step (from 0), at the key of the scene that has to change.
    pub(crate) fn of_step(step: usize, error: &StyleError, scene: &Scene) -> Self {
        match error {
            StyleError::Cancelled(cancelled) => Self::Cancelled(*cancelled),
            error => Self::Scene(scene.step_error(step, error)),
        }
    }

    /// The same of a list of steps.
    pub(crate) fn of_history(error: &HistoryError, scene: &Scene) -> Self {
        Self::of_step(error.step, &error.error, scene)
    }
}

impl From<ReadError> for Error {
    fn from(error: ReadError) -> Self {
        Self::because(&error, "")
    }
}

/// Runs a computation; a panic in it becomes [`Error::Internal`].
///
/// # Errors
/// Those of `work`, and [`Error::Internal`].
pub fn catch_panic<T>(work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(Error::Internal(text(&*panic))))
}

/// The message of a panic.
fn text(panic: &(dyn Any + Send)) -> String {
    let message = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    message.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default()
}

/// The message of an error with those of its causes in one sentence: "cannot write `x`: no space left".
#[must_use]
pub fn message(error: &dyn StdError) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        message = format!("{message}: {error}");
        cause = error.source();
    }
    message
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_internal_error() {
        let failed = catch_panic::<()>(|| panic!("no element {}", 7)).unwrap_err();
        assert_eq!(failed.to_string(), "internal error: no element 7");
        assert_eq!(failed.hint(), "please report it, with the scene");
        assert_eq!(catch_panic(|| Ok(1)).unwrap(), 1);
    }
}
