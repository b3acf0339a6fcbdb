//! Errors as plain data.

use frisure::scene::SceneError;
use serde::{Deserialize, Serialize};

use crate::error::{Error, message};

/// Why a request cannot be executed, for a person.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// What is wrong, with the value and the allowed range.
    pub problem: String,
    /// The key of the scene that is wrong, such as `hair.length`; may be empty.
    pub key: String,
    /// Line of the scene's text, from 1; 0 for none.
    pub line: usize,
    /// What to do; may be empty.
    pub hint: String,
}

impl From<&SceneError> for Diagnostic {
    fn from(error: &SceneError) -> Self {
        match error.diagnostic() {
            None => Self { problem: message(error), ..Self::default() },
            Some(found) => Self {
                problem: found.message(),
                key: found.key.clone(),
                line: found.line,
                hint: found.hint.clone(),
            },
        }
    }
}

impl From<&Error> for Diagnostic {
    fn from(error: &Error) -> Self {
        match error {
            Error::Scene(error) => error.into(),
            error => {
                Self { problem: message(error), hint: error.hint().to_owned(), ..Self::default() }
            }
        }
    }
}
