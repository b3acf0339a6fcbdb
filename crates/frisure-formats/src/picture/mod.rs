//! Pictures: PNG for screens, OpenEXR for compositors, and photos that are read.

#[cfg(feature = "exr")]
pub mod exr;
pub mod photo;
pub mod png;
pub mod scene_text;

use std::path::Path;

use thiserror::Error;

use frisure_files::WriteError;

/// Why a picture could not be written.
#[derive(Debug, Error)]
pub enum PictureError {
    /// The number of values is not width × height, or 0.
    #[error("`{what}` has {found} values, which are no picture of {width} × {height} pixels")]
    Size {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// What is of the wrong size.
        what: String,
        /// Values given.
        found: usize,
    },
    /// The extension names no known format.
    #[error("pictures are written as `.png` or `.exr`; `{name}` is neither")]
    Extension {
        /// The file name given.
        name: String,
    },
    /// The pixels cannot be encoded.
    #[error("cannot encode the picture: {0}")]
    Encoding(String),
    /// The file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// A picture format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Eight bits a channel, sRGB, as a screen shows it.
    Png,
    /// Scene-linear light in half precision, with layers.
    Exr,
}

impl Format {
    /// The format that a path's extension names.
    ///
    /// # Errors
    /// [`PictureError::Extension`], if it is none of those known.
    pub fn of(path: &Path) -> Result<Self, PictureError> {
        match path.extension() {
            Some(e) if e.eq_ignore_ascii_case("png") => Ok(Self::Png),
            Some(e) if e.eq_ignore_ascii_case("exr") => Ok(Self::Exr),
            _ => Err(PictureError::Extension { name: path.display().to_string() }),
        }
    }
}
