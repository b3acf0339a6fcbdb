//! Pictures as PNG.

use std::path::Path;

use thiserror::Error;

use crate::files::{WriteError, write_atomically};

/// Why a picture could not be written.
#[derive(Debug, Error)]
pub enum PictureError {
    /// The pixels are not width × height × 4 bytes, or there is none.
    #[error("{bytes} bytes are not a picture of {width} × {height} pixels of four bytes")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes given.
        bytes: usize,
    },
    /// The name does not end in `.png`.
    #[error("pictures are written as `.png`; `{name}` is not")]
    Extension {
        /// The file name asked for.
        name: String,
    },
    /// The file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Whether pictures can be written under that name.
///
/// # Errors
/// [`PictureError::Extension`] unless it ends in `.png`.
pub fn check_name(path: &Path) -> Result<(), PictureError> {
    match path.extension() {
        Some(e) if e.eq_ignore_ascii_case("png") => Ok(()),
        _ => Err(PictureError::Extension { name: path.display().to_string() }),
    }
}

/// Writes rows from the top, four bytes (red, green, blue, alpha; sRGB) per pixel, as an 8-bit
/// PNG, atomically.
///
/// # Errors
/// [`PictureError`].
pub fn write(path: &Path, width: u32, height: u32, rgba: &[u8]) -> Result<(), PictureError> {
    check_name(path)?;
    let expected = u128::from(width) * u128::from(height) * 4;
    if expected == 0 || rgba.len() as u128 != expected {
        return Err(PictureError::Size { width, height, bytes: rgba.len() });
    }
    write_atomically(path, |out| {
        let mut encoder = png::Encoder::new(out, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(rgba)?;
        Ok(writer.finish()?)
    })?;
    Ok(())
}
