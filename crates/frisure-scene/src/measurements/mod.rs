//! Measured hair: tables of sections, curvatures and moduli, into a fibre, its curl, and how both vary.
//!
//! What fibermorph writes is known by its columns; any other table names its columns and their units. A
//! table tells single hairs, windows along hairs, or groups of hairs; only the first two tell how hairs
//! of one head differ. What nothing tells is the hair type's, and [`Estimate::notes`] says so.

mod choices;
mod error;
mod estimate;
pub(crate) mod heading;
mod readings;
mod sample;
pub(crate) mod table;
mod text;

use std::collections::BTreeSet;
use std::path::Path;

pub use choices::{Choices, Steepness};
use error::MOST_TABLES;
pub use error::{MeasurementError, Place};
pub use estimate::Estimate;
pub use sample::Sample;

/// Reads tables and estimates the hair that they are of.
///
/// # Errors
/// [`MeasurementError`], naming file, line, column and value where there is one.
pub fn measured(paths: &[&Path], choices: &Choices) -> Result<Estimate, MeasurementError> {
    if paths.len() > MOST_TABLES {
        return Err(MeasurementError::TooMany(paths.len()));
    }
    let mut seen = BTreeSet::new();
    let whole = |path: &Path| std::fs::canonicalize(path).unwrap_or_else(|_| path.into());
    if let Some(twice) = paths.iter().find(|path| !seen.insert(whole(path))) {
        return Err(MeasurementError::Twice((*twice).into()));
    }
    let tables: Result<Vec<_>, _> = paths.iter().map(|path| table::Table::read(path)).collect();
    Estimate::of(&tables?, choices)
}
