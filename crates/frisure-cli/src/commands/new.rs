//! `frisure new`: a scene to start from.

use frisure::hairstyle::preset;
use frisure::scene::template;

use crate::args::New;
use crate::console;
use crate::failure::{Done, Failure};

/// Prints a commented scene of a hair type.
pub(crate) fn run(arguments: &New) -> Result<Done, Failure> {
    let Some(preset) = preset(&arguments.hair_type) else {
        let message = format!("there is no hair type `{}`", arguments.hair_type);
        return Err(Failure::wrong_because(message, "`frisure presets` lists them"));
    };
    console::print(&template(preset))?;
    Ok(Done::Well)
}
