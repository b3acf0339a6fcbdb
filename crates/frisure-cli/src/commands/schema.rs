//! `frisure schema`: the JSON Schema of scenes.

use frisure::scene::schema;
use frisure_engine::Error;

use crate::console;
use crate::diagnostics::ExitStatus;

/// Prints the JSON Schema of scenes.
pub(crate) fn run() -> Result<ExitStatus, Error> {
    console::print(&format!("{:#}\n", schema()))?;
    Ok(ExitStatus::Success)
}
