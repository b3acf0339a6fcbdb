//! `frisure schema`: what a scene can say.

use frisure::scene::schema;

use crate::console;
use crate::failure::{Done, Failure};

/// Prints the JSON Schema of scenes.
pub(crate) fn run() -> Result<Done, Failure> {
    console::print(&format!("{:#}\n", schema()))?;
    Ok(Done::Well)
}
