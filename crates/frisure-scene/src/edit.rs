//! Scenes edited as text: steps, and single keys; every other byte stays as it was.

mod keys;
mod ways;

pub use super::step::edit::{EditError, append, insert, remove, replace};
pub use keys::{set_key, set_keys, unset_key};
