//! A photo to compare with.

use std::path::Path;
use std::sync::Arc;

use frisure::formats::picture::photo::{self, PhotoReadError, Pixels};

/// A photo to compare with.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Its name.
    pub name: String,
    /// Width and height (pixels).
    pub size: [usize; 2],
    /// Red, green, blue (sRGB), rows from the top.
    pub rgb: Arc<Vec<u8>>,
    /// Opacity (0 to 1) with which it lies over the picture; `None` where it is beside it.
    pub over: Option<f32>,
    /// Differs for each photo.
    pub version: u64,
}

impl Reference {
    /// Decodes a photo (PNG or JPEG), beside the picture at first.
    ///
    /// # Errors
    /// [`PhotoReadError`].
    pub(super) fn decode(name: String, bytes: &[u8], version: u64) -> Result<Self, PhotoReadError> {
        let (size, rgb) = reduced(&photo::decode(bytes, Path::new(&name))?);
        Ok(Self { name, size, rgb: Arc::new(rgb), over: None, version })
    }
}

/// Longest side (pixels) of a photo that is shown: what every graphics device has room for.
const LARGEST: usize = 2048;

/// The size and the colours of a photo, made smaller by a whole factor where it is larger than [`LARGEST`].
fn reduced(photo: &Pixels) -> ([usize; 2], Vec<u8>) {
    let factor = photo.width.max(photo.height).div_ceil(LARGEST);
    if factor <= 1 {
        return ([photo.width, photo.height], photo.rgb.clone());
    }
    let (width, height) = ((photo.width / factor).max(1), (photo.height / factor).max(1));
    let mut rgb = Vec::with_capacity(3 * width * height);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let block = (0..factor * factor).filter_map(|i| {
                    let (column, row) = (x * factor + i % factor, y * factor + i / factor);
                    photo.rgb.get(3 * (row * photo.width + column) + channel)
                });
                let (sum, count) =
                    block.fold((0_usize, 0), |(sum, count), c| (sum + usize::from(*c), count + 1));
                rgb.push((sum / count.max(1)) as u8);
            }
        }
    }
    ([width, height], rgb)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_photos_are_made_smaller_and_keep_their_colours() {
        for (width, height, factor) in [(3, 2, 1), (4100, 7, 3), (5, 2049, 2)] {
            let photo = Pixels { width, height, rgb: [10, 200, 30].repeat(width * height) };
            let (size, rgb) = reduced(&photo);
            assert_eq!(size, [(width / factor).max(1), (height / factor).max(1)]);
            assert_eq!(rgb, [10, 200, 30].repeat(size[0] * size[1]));
        }
    }
}
