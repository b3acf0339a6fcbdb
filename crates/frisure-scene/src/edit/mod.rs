//! Scenes edited as text: steps, and single keys; every other byte stays as it was.

mod dependent;
mod error;
mod keys;
mod layout;
mod paths;
mod steps;

pub use error::EditError;
pub use keys::{set_key, set_keys, unset_key};
pub use paths::{in_folder, relative_path};
pub use steps::{append, insert, remove, replace};
