//! Pictures as OpenEXR: scene-linear light, and whatever else is known of each pixel.
//!
//! One part of scan lines, losslessly packed, whose channels are named `layer.channel`, which is what
//! compositors and denoisers take for layers. Primaries and white are those of sRGB.

use std::io::Cursor;
use std::path::Path;

use exr::compression::Compression;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, ImageAttributes, Layer,
    LayerAttributes, LineOrder, SmallVec, Text, Vec2, WritableImage, f16,
};

use super::PictureError;
use frisure_files::write_atomically;

/// Values of a channel, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Kept in half precision: colours and directions. What is larger than 65 504 is cut to that.
    Half(Vec<f32>),
    /// Kept in single precision: depths.
    Single(Vec<f32>),
    /// Counts and identifiers.
    Whole(Vec<u32>),
}

/// A channel with its name, such as `R` or `albedo.R`.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its name.
    pub name: String,
    /// Its values.
    pub values: Values,
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Self::Half(values) | Self::Single(values) => values.len(),
            Self::Whole(values) => values.len(),
        }
    }

    fn samples(self) -> FlatSamples {
        let half = |x: f32| f16::from_f32(x.clamp(-f16::MAX.to_f32(), f16::MAX.to_f32()));
        match self {
            Self::Half(values) => FlatSamples::F16(values.into_iter().map(half).collect()),
            Self::Single(values) => FlatSamples::F32(values),
            Self::Whole(values) => FlatSamples::U32(values),
        }
    }
}

/// Writes channels of `width` × `height` values, atomically; `comment` is kept in the file for people.
///
/// # Errors
/// [`PictureError`], if a channel is of another size or the file cannot be written.
pub fn write(
    path: &Path,
    width: usize,
    height: usize,
    channels: Vec<Channel>,
    comment: &str,
) -> Result<(), PictureError> {
    let wrong = channels.iter().find(|c| c.values.len() != width * height || width * height == 0);
    if let Some(Channel { name, values }) = wrong {
        let (what, found) = (name.clone(), values.len());
        return Err(PictureError::Size { width, height, what, found });
    }
    let channels: SmallVec<[_; 4]> = channels
        .into_iter()
        .map(|c| AnyChannel::new(c.name.as_str(), c.values.samples()))
        .collect();
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let attributes = LayerAttributes {
        software_name: Some(Text::from("frisure")),
        comments: Text::new_or_none(comment),
        ..LayerAttributes::default()
    };
    let size = Vec2(width, height);
    let layer = Layer::new(size, attributes, encoding, AnyChannels::sort(channels));
    let image = Image {
        attributes: ImageAttributes {
            chromaticities: Some(SRGB),
            ..ImageAttributes::with_size(size)
        },
        layer_data: layer,
    };
    // The writer seeks back to fill in tables, which a stream cannot do.
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(|e| PictureError::Encoding(e.to_string()))?;
    write_atomically(path, |out| out.write_all(bytes.get_ref()))?;
    Ok(())
}

/// Primaries and white of ITU-R BT.709.
const SRGB: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};
