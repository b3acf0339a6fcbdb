//! Why a text cannot be edited.

use thiserror::Error;

use crate::error::SceneError;
use crate::write::WriteStepError;

/// Why a text cannot be edited.
#[derive(Debug, Error)]
pub enum EditError {
    /// The text is no scene to begin with.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A step that cannot be written.
    #[error(transparent)]
    Step(#[from] WriteStepError),
    /// There is no such step.
    #[error("there is no step {}; the scene has {count}", index + 1)]
    NoSuchStep {
        /// The index of the step, from 0.
        index: usize,
        /// How many steps the scene has.
        count: usize,
    },
    /// A value that is none.
    #[error("`{key}` cannot be set: {problem}")]
    Value {
        /// The key that was to have it.
        key: String,
        /// What is wrong with it.
        problem: String,
    },
    /// There is no such place.
    #[error("`{key}` is no place for a value in this scene")]
    NoPlace {
        /// The path.
        key: String,
    },
    /// A key that the reader would not follow.
    #[error("`{key}` has more than {most} names; a key of a scene has fewer")]
    Deep {
        /// The beginning of the path.
        key: String,
        /// Most names of a path.
        most: usize,
    },
    /// The edited text does not have the intended values.
    #[error("the steps of this scene are too mixed with the rest to be edited one by one")]
    Scattered,
}
