//! Operations as the text of steps, which reads as the same operations to the last bit.

use frisure_hairstyle::InvalidSpec;
use frisure_hairstyle::styling::{Operation, Release, Selection};
use thiserror::Error;

use crate::kind::ToText;
use crate::operation::{Where, declaration};
use crate::step::parse_step;

/// Why an operation cannot be written as a step.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum WriteStepError {
    /// One of its numbers is out of range.
    #[error(transparent)]
    Invalid(#[from] InvalidSpec),
    /// There are no words for it, such as for hair that is held in some way while it is cut to a length.
    #[error("no step says this `{operation}`")]
    Unsaid {
        /// The name of the operation.
        operation: &'static str,
    },
}

/// A choice of wisps as the value of `where`, in a step or a section of a scene, which reads as the same choice to the last bit.
///
/// # Errors
/// [`WriteStepError`].
pub fn write_selection(selection: &Selection) -> Result<String, WriteStepError> {
    // A step can be without its choice, which is everything then; a section says it.
    write_step(&Operation::Release(Release { selection: selection.clone() }))?;
    Ok(Where::text(selection))
}

/// An operation as a step of a scene: the line `[[step]]` and one with the operation, as a person would
/// write it as far as that is exact. The text reads as the same operation to the last bit.
///
/// # Errors
/// [`WriteStepError`].
pub fn write_step(operation: &Operation) -> Result<String, WriteStepError> {
    operation.check()?;
    let name = operation.name();
    let text = format!("{name} = {}\n", declaration(operation).write(operation));
    match parse_step(name, text.as_str()) {
        Ok(read) if read == *operation => Ok(format!("[[step]]\n{text}")),
        _ => Err(WriteStepError::Unsaid { operation: name }),
    }
}
