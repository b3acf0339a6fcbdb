//! OpenEXR pictures.

use std::io::Cursor;

use exr::image::pixel_vec::PixelVec;
use exr::prelude::*;

use super::map::{Environment, check_size};

/// Reads the first layer with red, green and blue, or says what is wrong with the picture.
pub(super) fn decode(bytes: &[u8], most: usize) -> std::result::Result<Environment, String> {
    let wrong = |e: Error| format!("is no OpenEXR picture that can be read: {e}");
    // Before anything is made as large as the picture says it is.
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(wrong)?;
    for header in &meta.headers {
        if header.deep {
            return Err("holds deep pixels; an environment is flat".into());
        }
        let Vec2(width, height) = header.layer_size;
        check_size(width, height, most)?;
        let whole = header.shared_attributes.display_window.size;
        if whole != header.layer_size {
            return Err(format!(
                "holds {width} x {height} of {} x {} pixels; an environment is whole",
                whole.0, whole.1
            ));
        }
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(PixelVec::<(f32, f32, f32)>::constructor, PixelVec::set_pixel)
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| match e {
            Error::Invalid(why) if why.contains("layer") => {
                "has no layer with the channels R, G and B".to_owned()
            }
            e => wrong(e),
        })?;
    let layer = image.layer_data;
    let Vec2(width, height) = layer.size;
    let pixels = layer.channel_data.pixels.pixels.into_iter().map(|(r, g, b)| [r, g, b]);
    Ok(Environment { width, height, pixels: pixels.collect() })
}
