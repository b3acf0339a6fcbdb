//! A photo: pixels, a crop, and the reduction to the size that is worked at.

use serde::Serialize;
use thiserror::Error;

/// Longest side (pixels) that is worked at; larger photos are averaged down. Chosen: a hair of a lock that fills the picture is then half a pixel
/// wide, and the shortest wave that is accepted has the length of some hairs.
const LONGEST_SIDE: usize = 2000;

/// Least width and height (pixels). Chosen: less holds no wave that could be measured.
pub const LEAST_SIDE: usize = 32;

/// A part of a photo (pixels from the top left).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Crop {
    /// Left edge.
    pub x: usize,
    /// Upper edge.
    pub y: usize,
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
}

/// Why pixels are no photo that can be measured.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum PhotoError {
    /// The number of values is not three for each pixel.
    #[error("{found} values are no picture of {width} x {height} pixels with red, green and blue")]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// Values given.
        found: usize,
    },
    /// The photo or its crop is too small.
    #[error(
        "{width} x {height} pixels are too few; a photo has at least {LEAST_SIDE} x {LEAST_SIDE}"
    )]
    Small {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The crop is not within the photo.
    #[error("the crop {},{},{},{} is not within the photo, which has {width} x {height} pixels", crop.x, crop.y, crop.width, crop.height)]
    Crop {
        /// The crop given.
        crop: Crop,
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
}

/// The part of a photo that is measured, at the size that is worked at.
#[derive(Clone, Debug)]
pub struct Photo {
    width: usize,
    height: usize,
    rgb: Vec<[f32; 3]>,
    reduction: usize,
    origin: [usize; 2],
}

impl Photo {
    /// A photo from rows from the top, three bytes (red, green, blue; sRGB) per pixel.
    ///
    /// # Errors
    /// [`PhotoError`].
    pub fn new(
        width: usize,
        height: usize,
        rgb: &[u8],
        crop: Option<Crop>,
    ) -> Result<Self, PhotoError> {
        if width.checked_mul(height).and_then(|n| n.checked_mul(3)) != Some(rgb.len()) {
            return Err(PhotoError::Size { width, height, found: rgb.len() });
        }
        let crop = crop.unwrap_or(Crop { x: 0, y: 0, width, height });
        let inside = |from: usize, size: usize, all: usize| {
            from.checked_add(size).is_some_and(|end| end <= all)
        };
        if !inside(crop.x, crop.width, width) || !inside(crop.y, crop.height, height) {
            return Err(PhotoError::Crop { crop, width, height });
        }
        if crop.width.min(crop.height) < LEAST_SIDE {
            let (width, height) = (crop.width, crop.height);
            return Err(PhotoError::Small { width, height });
        }
        let reduction = crop.width.max(crop.height).div_ceil(LONGEST_SIDE);
        let (columns, rows) = (crop.width / reduction, crop.height / reduction);
        let share = 1.0 / (255.0 * (reduction * reduction) as f32);
        let mut reduced = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            let mut sums = vec![[0_u32; 3]; columns];
            for y in 0..reduction {
                let start = 3 * ((crop.y + row * reduction + y) * width + crop.x);
                let line = &rgb[start..start + 3 * columns * reduction];
                for (i, pixel) in line.chunks_exact(3).enumerate() {
                    let sum = &mut sums[i / reduction];
                    for (total, value) in sum.iter_mut().zip(pixel) {
                        *total += u32::from(*value);
                    }
                }
            }
            reduced.extend(sums.iter().map(|sum| sum.map(|x| x as f32 * share)));
        }
        let (width, height) = (columns, rows);
        Ok(Self { width, height, rgb: reduced, reduction, origin: [crop.x, crop.y] })
    }

    /// Pixels across, as worked at.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down, as worked at.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Pixels of the photo along a side of one that is worked at.
    #[must_use]
    pub fn reduction(&self) -> usize {
        self.reduction
    }

    /// The upper left corner (pixels) in the photo that was given.
    #[must_use]
    pub fn origin(&self) -> [usize; 2] {
        self.origin
    }

    /// Red, green and blue from 0 to 1, row by row.
    #[must_use]
    pub fn rgb(&self) -> &[[f32; 3]] {
        &self.rgb
    }
}
