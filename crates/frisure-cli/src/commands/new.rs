//! `frisure new`: a scene to start from.

use frisure::hairstyle::preset;
use frisure::scene::template;
use frisure_engine::Error;

use crate::args::New;
use crate::console;
use crate::diagnostics::ExitStatus;

/// Prints a commented scene of a hair type.
pub(crate) fn run(arguments: &New) -> Result<ExitStatus, Error> {
    let Some(preset) = preset(&arguments.hair_type) else {
        let message = format!("there is no hair type `{}`", arguments.hair_type);
        return Err(Error::invalid(message, "`frisure presets` lists them"));
    };
    console::print(&template(preset))?;
    Ok(ExitStatus::Success)
}
