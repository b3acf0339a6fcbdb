//! Batches: many scenes from one, by what is varied in it.
//!
//! A batch is TOML that names a scene, the keys of it that differ from head to head, and how: over a
//! grid, or drawn from ranges, distributions and tables of people who were measured. `read` reads
//! it, `way` is how a key varies, `sheet` the tables, and `trial` tries the ends of each range on the scene, so
//! that the work does not begin with values out of range. `views` are the pictures of each head. The head of a number follows from the batch and that
//! number alone.

mod heads;
mod names;
mod read;
mod sheet;
mod table;
mod trial;
mod variation;
mod views;
mod way;

use std::path::Path;

use crate::error::SceneError;
use crate::source::Source;
use crate::unit_hint;

pub use heads::{Batch, MOST_HEADS, Sample};
pub use views::{ViewCamera, ViewOutput, Views};
pub use way::{Kind, Value};

/// Largest description of a batch that is read (bytes).
pub const MAX_SIZE: u64 = 16 << 20;

impl Batch {
    /// Reads the description of a batch, with the scene and the tables that it names.
    ///
    /// # Errors
    /// [`SceneError`], for an error in the description or in the scene, and for values that the scene cannot
    /// have.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let text = frisure_files::read_text(path, MAX_SIZE, "a batch")?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), text, folder)
    }

    /// Reads the text of a batch; errors call it `name`, and paths in it are relative to `folder`.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(name: &str, text: impl Into<String>, folder: &Path) -> Result<Self, SceneError> {
        parse(Source::new(name, text), folder).map_err(unit_hint::add)
    }
}

fn parse(source: Source, folder: &Path) -> Result<Batch, SceneError> {
    let mut batch = read::batch(source, folder)?;
    let files = trial::all(&batch)?;
    batch.digest = batch.digest_with(&files);
    Ok(batch)
}
