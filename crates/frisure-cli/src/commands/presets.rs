//! `frisure presets`: what a scene can start from.

use std::fmt::Write;

use frisure::hairstyle::PRESETS;

use crate::console;
use crate::failure::{Done, Failure};

/// Prints a table of the hair types.
pub(crate) fn run() -> Result<Done, Failure> {
    let mut out = format!(
        "{:<20} {:>8} {:>6} {:>8} {:>8} {:>8}  {}\n",
        "type", "diameter", "axes", "radius", "pitch", "length", "description"
    );
    for preset in PRESETS {
        let spec = preset.spec();
        let section = spec.fibre.section;
        let (radius, pitch) = spec.curl.radius_pitch().unwrap_or_default();
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "{:<20} {:>5.0} um {:>6.2} {:>5.1} mm {:>5.1} mm {:>5.0} cm  {}",
            preset.name,
            section.mean_radius() * 2e6,
            section.axis_ratio(),
            radius * 1e3,
            pitch * 1e3,
            spec.length.mean * 1e2,
            preset.description,
        );
    }
    console::print(&out)?;
    Ok(Done::Well)
}
