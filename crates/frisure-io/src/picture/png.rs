//! Pictures as PNG.

use std::path::Path;

use super::PictureError;
use crate::files::write_atomically;

/// Writes rows from the top, four bytes (red, green, blue, alpha; sRGB) per pixel, as an 8-bit
/// PNG that says that it is sRGB, atomically.
///
/// # Errors
/// [`PictureError`].
pub fn write(path: &Path, width: u32, height: u32, rgba: &[u8]) -> Result<(), PictureError> {
    let expected = u128::from(width) * u128::from(height) * 4;
    if expected == 0 || rgba.len() as u128 != expected {
        let (width, height) = (width as usize, height as usize);
        let what = "RGBA".to_owned();
        return Err(PictureError::Size { width, height, what, found: rgba.len() });
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
