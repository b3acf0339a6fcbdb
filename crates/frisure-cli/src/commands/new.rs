//! `frisure new`: a scene to start from.

use frisure::scene::worn_template;
use frisure_engine::Error;

use crate::args::New;
use crate::console;
use crate::diagnostics::ExitStatus;

/// Prints a commented scene of a hair type.
pub(crate) fn run(arguments: &New) -> Result<ExitStatus, Error> {
    console::print(&worn_template(arguments.hair_type))?;
    Ok(ExitStatus::Success)
}
