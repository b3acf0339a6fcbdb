//! Pictures as PNG.

use std::io::{self, Write};
use std::path::Path;

use super::PictureError;
use frisure_files::write_atomically;

/// Writes rows from the top, four bytes (red, green, blue, alpha; sRGB) per pixel, as an 8-bit
/// PNG that says that it is sRGB, atomically.
///
/// # Errors
/// [`PictureError`].
pub fn write(path: &Path, width: u32, height: u32, rgba: &[u8]) -> Result<(), PictureError> {
    check(width, height, rgba)?;
    write_atomically(path, |out| still(out, width, height, rgba))?;
    Ok(())
}

/// The bytes of the file that [`write()`] writes.
///
/// # Errors
/// [`PictureError::Size`].
pub fn encode(width: u32, height: u32, rgba: &[u8]) -> Result<Vec<u8>, PictureError> {
    check(width, height, rgba)?;
    let mut bytes = Vec::new();
    still(&mut bytes, width, height, rgba).map_err(|e| PictureError::Encoding(e.to_string()))?;
    Ok(bytes)
}

/// The bytes of a PNG of numbers that are no colours, as in [`encode`] without a statement about sRGB.
///
/// # Errors
/// [`PictureError::Size`].
pub fn encode_data(width: u32, height: u32, rgba: &[u8]) -> Result<Vec<u8>, PictureError> {
    check(width, height, rgba)?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(rgba)?;
        writer.finish()
    });
    written.map_err(|e| PictureError::Encoding(e.to_string()))?;
    Ok(bytes)
}

/// The bytes of a PNG with one (grey), three (sRGB) or four (sRGB, alpha) bytes per pixel, row by row from the top.
///
/// # Errors
/// [`PictureError::Size`], also for another number of channels.
pub fn encode_channels(
    width: u32,
    height: u32,
    channels: u8,
    pixels: &[u8],
) -> Result<Vec<u8>, PictureError> {
    let (color, what) = match channels {
        1 => (png::ColorType::Grayscale, "grey"),
        3 => (png::ColorType::Rgb, "RGB"),
        _ => (png::ColorType::Rgba, "RGBA"),
    };
    let expected = u128::from(width) * u128::from(height) * color.samples() as u128;
    if expected == 0 || pixels.len() as u128 != expected || color.samples() != usize::from(channels)
    {
        let (width, height) = (width as usize, height as usize);
        let (what, found) = (what.to_owned(), pixels.len());
        return Err(PictureError::Size { width, height, what, found });
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    if channels > 1 {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    }
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    written.map_err(|e| PictureError::Encoding(e.to_string()))?;
    Ok(bytes)
}

/// The pixels of a PNG in eight bits a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decoded {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Bytes of each pixel: 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha.
    pub channels: usize,
    /// Row by row from the top left.
    pub pixels: Vec<u8>,
}

/// Most bytes of a picture that is read.
const MAX_DECODED: usize = 1 << 30;

/// Reads a PNG; what is wrong with it is told in a sentence.
///
/// # Errors
/// The sentence.
pub fn decode(bytes: &[u8]) -> Result<Decoded, String> {
    let limits = png::Limits { bytes: MAX_DECODED };
    let mut decoder = png::Decoder::new_with_limits(io::Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let size = reader.output_buffer_size().filter(|&n| n <= MAX_DECODED);
    let mut pixels = vec![0; size.ok_or("it has too many pixels")?];
    let frame = reader.next_frame(&mut pixels).map_err(|e| e.to_string())?;
    pixels.truncate(frame.buffer_size());
    let (width, height) = (frame.width as usize, frame.height as usize);
    Ok(Decoded { width, height, channels: frame.color_type.samples(), pixels })
}

/// The bytes of an animated PNG that never ends, of frames as in [`write()`], each seen for as many
/// milliseconds. Programs that know no animation show the first.
///
/// # Errors
/// [`PictureError::Size`], also for no frame at all.
pub fn encode_animated(
    width: u32,
    height: u32,
    frames: &[Vec<u8>],
    milliseconds: u16,
) -> Result<Vec<u8>, PictureError> {
    frames.iter().try_for_each(|frame| check(width, height, frame))?;
    check(width, height, frames.first().map_or(&[], Vec::as_slice))?;
    let mut bytes = Vec::new();
    animated(&mut bytes, (width, height), frames, milliseconds)
        .map_err(|e| PictureError::Encoding(e.to_string()))?;
    Ok(bytes)
}

fn check(width: u32, height: u32, rgba: &[u8]) -> Result<(), PictureError> {
    let expected = u128::from(width) * u128::from(height) * 4;
    if expected != 0 && rgba.len() as u128 == expected {
        return Ok(());
    }
    let (width, height) = (width as usize, height as usize);
    Err(PictureError::Size { width, height, what: "RGBA".to_owned(), found: rgba.len() })
}

fn encoder<W: Write>(out: W, width: u32, height: u32) -> png::Encoder<'static, W> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder
}

fn still(out: &mut dyn Write, width: u32, height: u32, rgba: &[u8]) -> io::Result<()> {
    let mut writer = encoder(out, width, height).write_header()?;
    writer.write_image_data(rgba)?;
    Ok(writer.finish()?)
}

fn animated(
    out: &mut dyn Write,
    (width, height): (u32, u32),
    frames: &[Vec<u8>],
    milliseconds: u16,
) -> Result<(), png::EncodingError> {
    let mut encoder = encoder(out, width, height);
    encoder.set_animated(u32::try_from(frames.len()).unwrap_or(u32::MAX), 0)?;
    encoder.set_frame_delay(milliseconds, 1000)?;
    let mut writer = encoder.write_header()?;
    for frame in frames {
        writer.write_image_data(frame)?;
    }
    writer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_come_back() {
        for channels in [1, 3, 4] {
            let pixels: Vec<u8> = (0..6 * channels).map(|i| 11 * i).collect();
            let bytes = encode_channels(2, 3, channels, &pixels).unwrap();
            let channels = usize::from(channels);
            assert_eq!(decode(&bytes), Ok(Decoded { width: 2, height: 3, channels, pixels }));
        }
        assert!(encode_channels(2, 3, 2, &[0; 12]).is_err());
        assert!(encode_channels(2, 3, 3, &[0; 17]).is_err());
        assert!(decode(b"no picture").is_err());
    }

    #[test]
    fn frames_come_back_from_an_animation() {
        let frames: Vec<Vec<u8>> = (0..3).map(|i| vec![40 * i; 2 * 3 * 4]).collect();
        let bytes = encode_animated(2, 3, &frames, 80).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(&bytes)).read_info().unwrap();
        let about = reader.info().animation_control.unwrap();
        assert_eq!((about.num_frames, about.num_plays), (3, 0));
        for frame in &frames {
            let mut read = vec![0; frame.len()];
            reader.next_frame(&mut read).unwrap();
            assert_eq!(&read, frame);
            let delay = reader.info().frame_control.unwrap();
            assert_eq!((delay.delay_num, delay.delay_den), (80, 1000));
        }
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        assert!(encode(2, 2, &[0; 15]).is_err());
        assert!(encode(0, 2, &[]).is_err());
        assert!(encode_animated(2, 2, &[], 80).is_err());
        assert!(encode_animated(2, 2, &[vec![0; 16], vec![0; 15]], 80).is_err());
    }
}
