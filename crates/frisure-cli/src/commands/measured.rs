//! `frisure measured`: tables of measured hair into a scene of that hair.

use std::path::Path;

use frisure::scene::measurements::{Choices, Steepness, measured};
use frisure_engine::Error;

use super::parse_scene;
use crate::args::Measured;
use crate::diagnostics::ExitStatus;
use crate::{console, outputs};

/// Reads the tables and writes the scene, with notes on what was not measured.
pub(crate) fn run(arguments: &Measured, quiet: bool) -> Result<ExitStatus, Error> {
    let tables: Vec<&Path> = arguments.tables.iter().map(AsRef::as_ref).collect();
    outputs::prepare(&arguments.output.iter().map(AsRef::as_ref).collect::<Vec<_>>(), &tables)?;
    let estimate = measured(&tables, &choices(arguments));
    let estimate = estimate.map_err(|e| Error::because(&e, &e.hint()))?;
    let text = estimate.scene();
    let name = arguments.output.as_deref().unwrap_or(Path::new("measured.toml"));
    // Numbers that are each in range may be impossible together.
    parse_scene(name, text.clone())?.hairstyle_spec()?;
    match &arguments.output {
        Some(path) => outputs::write_text(path, &text)?,
        None => console::print(&text)?,
    }
    if !quiet {
        estimate.notes.iter().for_each(|note| console::note(note));
    }
    Ok(ExitStatus::Success)
}

fn choices(arguments: &Measured) -> Choices {
    let steepness = arguments.pitch.map(Steepness::Pitch);
    let steepness = steepness.or(arguments.radius.map(Steepness::Radius));
    let steepness = steepness.or(arguments.curl_index.map(Steepness::CurlIndex));
    Choices {
        columns: arguments.columns.clone(),
        rows: arguments.rows.clone(),
        window: arguments.window,
        shape_only: arguments.shape_only,
        hair_type: arguments.hair_type,
        steepness: steepness.or(arguments.turns.map(Steepness::Turns)),
    }
}
