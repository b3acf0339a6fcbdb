//! Reports as JSON.

use std::path::Path;

use serde::Serialize;

use frisure_files::{WriteError, write_atomically};

/// Writes a report as indented JSON, atomically.
///
/// Numbers are written with as many digits as it takes to read the same number back.
///
/// # Errors
/// [`WriteError`].
pub fn write(path: &Path, report: &impl Serialize) -> Result<(), WriteError> {
    write_atomically(path, |out| {
        serde_json::to_writer_pretty(&mut *out, report)?;
        out.write_all(b"\n")
    })
}
