//! Photos, from PNG and JPEG.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use thiserror::Error;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use frisure_files::{ReadError, read_bytes};

/// Largest file (bytes). Chosen: above every camera's.
const LARGEST_FILE: u64 = 1 << 28;

/// Most pixels. Chosen: cameras have up to 150 million; they take three bytes each.
pub const MOST_PIXELS: usize = 160_000_000;

/// A photo: rows from the top, three bytes (red, green, blue; sRGB) per pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixels {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// The values.
    pub rgb: Vec<u8>,
}

/// Why a photo cannot be read.
#[derive(Debug, Error)]
pub enum PhotoReadError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// It is neither PNG nor JPEG.
    #[error("{}: it is neither PNG nor JPEG", path.display())]
    Format {
        /// The path given.
        path: PathBuf,
    },
    /// It is damaged, or of a kind that is not read.
    #[error("{}: {problem}", path.display())]
    Damaged {
        /// The path given.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// It is larger than what is read.
    #[error("{}: {problem}", path.display())]
    Large {
        /// The path given.
        path: PathBuf,
        /// How large it is, and may be.
        problem: String,
    },
}

/// What is wrong with the bytes of a photo.
#[derive(Debug)]
enum Fault {
    Damaged(String),
    Large(String),
}

impl From<String> for Fault {
    fn from(problem: String) -> Self {
        Self::Damaged(problem)
    }
}

/// Reads the photo in a file of at most `most` pixels, such as there is memory for, and at most [`MOST_PIXELS`]: [`decode`].
///
/// # Errors
/// [`PhotoReadError`].
pub fn read(path: &Path, most: usize) -> Result<Pixels, PhotoReadError> {
    decode_at_most(&read_bytes(path, LARGEST_FILE, "a photo")?, path, most.min(MOST_PIXELS))
}

/// A photo from the bytes of a file, whose `path` is for errors alone; the first bytes tell the format. Grey is read as colour, 16 bits as 8, what is transparent as if white were behind it, and a photo that
/// says that it has to be turned is turned (Exif).
///
/// # Errors
/// [`PhotoReadError`].
pub fn decode(bytes: &[u8], path: &Path) -> Result<Pixels, PhotoReadError> {
    decode_at_most(bytes, path, MOST_PIXELS)
}

fn decode_at_most(bytes: &[u8], path: &Path, most: usize) -> Result<Pixels, PhotoReadError> {
    let told = |fault| match fault {
        Fault::Damaged(problem) => PhotoReadError::Damaged { path: path.into(), problem },
        Fault::Large(problem) => PhotoReadError::Large { path: path.into(), problem },
    };
    if bytes.starts_with(b"\x89PNG") {
        from_png(bytes, most).map_err(told)
    } else if bytes.starts_with(&[0xff, 0xd8]) {
        from_jpeg(bytes, most).map_err(told)
    } else {
        Err(PhotoReadError::Format { path: path.into() })
    }
}

fn too_many(width: usize, height: usize, most: usize) -> Fault {
    let limit = match most {
        MOST_PIXELS => format!("at most {MOST_PIXELS} are read"),
        _ => format!("at most {most} have room in the memory that is free"),
    };
    Fault::Large(format!("{width} x {height} pixels are too many; {limit}"))
}

fn allowed(width: usize, height: usize, most: usize) -> Result<(), Fault> {
    let pixels = width.checked_mul(height);
    match pixels {
        Some(0) => Err(format!("{width} x {height} pixels are no picture").into()),
        Some(n) if n <= most => Ok(()),
        _ => Err(too_many(width, height, most)),
    }
}

fn from_png(bytes: &[u8], most: usize) -> Result<Pixels, Fault> {
    let limits = png::Limits { bytes: 5 * MOST_PIXELS };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    allowed(width, height, most)?;
    let size = reader.output_buffer_size().filter(|&n| n <= 4 * MOST_PIXELS);
    let mut pixels = vec![0; size.ok_or_else(|| too_many(width, height, most))?];
    let frame = reader.next_frame(&mut pixels).map_err(|e| e.to_string())?;
    let samples = frame.color_type.samples();
    let mut rgb = Vec::with_capacity(3 * width * height);
    for pixel in pixels[..frame.buffer_size()].chunks_exact(samples) {
        let (colours, alpha) = match *pixel {
            [grey] => ([grey; 3], 255),
            [grey, alpha] => ([grey; 3], alpha),
            [r, g, b] => ([r, g, b], 255),
            [r, g, b, alpha] => ([r, g, b], alpha),
            _ => return Err(format!("{samples} samples per pixel").into()),
        };
        let over = |c: u8| {
            let (c, a) = (u32::from(c), u32::from(alpha));
            // At most 255.
            ((c * a + 255 * (255 - a) + 127) / 255) as u8
        };
        rgb.extend(colours.map(over));
    }
    let (width, height) = (frame.width as usize, frame.height as usize);
    Ok(Pixels { width, height, rgb })
}

fn from_jpeg(bytes: &[u8], most: usize) -> Result<Pixels, Fault> {
    if !is_whole(bytes) {
        return Err("it is cut short: its end is missing".to_owned().into());
    }
    let options = DecoderOptions::default()
        .set_max_width(MOST_PIXELS)
        .set_max_height(MOST_PIXELS)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions().ok_or_else(|| "it has no size".to_owned())?;
    allowed(width, height, most)?;
    let rgb = decoder.decode().map_err(|e| e.to_string())?;
    if rgb.len() != 3 * width * height {
        return Err("it has no colours that can be read".to_owned().into());
    }
    let turn = decoder.exif().and_then(|exif| orientation(exif)).unwrap_or(1);
    Ok(turned(Pixels { width, height, rgb }, turn))
}

/// Whether a JPEG has its end (EOI) behind its last scan (SOS): a decoder fills up what is missing. Within a scan neither occurs.
fn is_whole(bytes: &[u8]) -> bool {
    let scan = bytes.windows(2).rposition(|marker| marker == [0xff, 0xda]);
    scan.is_some_and(|at| bytes[at..].windows(2).any(|marker| marker == [0xff, 0xd9]))
}

/// The orientation, 1 to 8, that an Exif block states (Exif 2.3, tag 0x0112).
fn orientation(exif: &[u8]) -> Option<u16> {
    let exif = exif.strip_prefix(b"Exif\0\0").unwrap_or(exif);
    let little = match exif.get(..2)? {
        b"II" => true,
        b"MM" => false,
        _ => return None,
    };
    let short = |at: usize| {
        let bytes = exif.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if little { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) })
    };
    let long = |at: usize| {
        let bytes = exif.get(at..at.checked_add(4)?)?.try_into().ok()?;
        Some(if little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) } as usize)
    };
    let directory = long(4)?;
    let count = usize::from(short(directory)?);
    let entries = (0..count).map(|i| directory + 2 + 12 * i);
    let mut of_tag = entries.filter(|&at| short(at) == Some(0x0112));
    short(of_tag.next()? + 8)
}

/// The photo as it is to be seen: mirrored for even orientations up to 4, and so on (Exif 2.3, "Orientation").
fn turned(photo: Pixels, orientation: u16) -> Pixels {
    if !(2..=8).contains(&orientation) {
        return photo;
    }
    let Pixels { width: w, height: h, rgb } = photo;
    let (width, height) = if orientation > 4 { (h, w) } else { (w, h) };
    let mut out = Vec::with_capacity(rgb.len());
    for y in 0..height {
        for x in 0..width {
            let (u, v) = match orientation {
                2 => (w - 1 - x, y),
                3 => (w - 1 - x, h - 1 - y),
                4 => (x, h - 1 - y),
                5 => (y, x),
                6 => (y, h - 1 - x),
                7 => (w - 1 - y, h - 1 - x),
                _ => (w - 1 - y, x),
            };
            let at = 3 * (v * w + u);
            out.extend_from_slice(&rgb[at..at + 3]);
        }
    }
    Pixels { width, height, rgb: out }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_of_every_kind_is_read() {
        let encoded = |color, depth, data: &[u8]| {
            let mut bytes = Vec::new();
            let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
            encoder.set_color(color);
            encoder.set_depth(depth);
            encoder.write_header().unwrap().write_image_data(data).unwrap();
            from_png(&bytes, MOST_PIXELS).unwrap().rgb
        };
        use png::{BitDepth, ColorType};
        assert_eq!(
            encoded(ColorType::Grayscale, BitDepth::Eight, &[0, 200]),
            [0, 0, 0, 200, 200, 200]
        );
        assert_eq!(
            encoded(ColorType::GrayscaleAlpha, BitDepth::Eight, &[0, 0, 7, 255]),
            [255, 255, 255, 7, 7, 7]
        );
        let sixteen = [10, 99, 20, 99, 30, 99, 40, 0, 50, 0, 60, 0];
        assert_eq!(encoded(ColorType::Rgb, BitDepth::Sixteen, &sixteen), [10, 20, 30, 40, 50, 60]);
        assert_eq!(
            encoded(ColorType::Rgba, BitDepth::Eight, &[1, 2, 3, 255, 9, 9, 9, 0])[..3],
            [1, 2, 3]
        );
    }

    #[test]
    fn jpeg_is_read_and_turned() {
        // Red rises by 20 a pixel to the right, green by 25 downwards, in 12 x 9 pixels; saved by libjpeg, which loses a little.
        let baseline =
            from_jpeg(include_bytes!("../../tests/data/turned.jpg"), MOST_PIXELS).unwrap();
        let progressive =
            from_jpeg(include_bytes!("../../tests/data/progressive.jpg"), MOST_PIXELS).unwrap();
        let grey = from_jpeg(include_bytes!("../../tests/data/grey.jpg"), MOST_PIXELS).unwrap();
        // The first says that it is to be turned clockwise.
        assert_eq!((baseline.width, baseline.height), (9, 12));
        assert_eq!((progressive.width, progressive.height, grey.rgb.len()), (12, 9, 324));
        assert!(grey.rgb.chunks_exact(3).all(|p| p[0] == p[1] && p[1] == p[2]));
        let (mut of_turned, mut of_progressive) = (0, 0);
        for (x, y) in (0..12).flat_map(|x| (0..9).map(move |y| (x, y))) {
            let off = |photo: &Pixels, at: usize| {
                let [r, g] = [photo.rgb[3 * at], photo.rgb[3 * at + 1]].map(usize::from);
                r.abs_diff(20 * x) + g.abs_diff(25 * y)
            };
            of_turned += off(&baseline, x * 9 + (8 - y));
            of_progressive += off(&progressive, y * 12 + x);
        }
        let mean = [of_turned, of_progressive].map(|sum| sum as f64 / 108.0);
        assert!(mean.iter().all(|mean| *mean < 25.0), "{mean:?}");
    }

    #[test]
    fn a_photo_is_turned_as_it_says() {
        // Two pixels beside each other.
        let photo = Pixels { width: 2, height: 1, rgb: vec![1, 1, 1, 2, 2, 2] };
        let of = |orientation| turned(photo.clone(), orientation);
        assert_eq!(of(1), photo);
        assert_eq!(of(3).rgb, [2, 2, 2, 1, 1, 1]);
        // 6 is to be turned clockwise: the left pixel is then above.
        assert_eq!((of(6).width, of(6).height, of(6).rgb), (1, 2, vec![1, 1, 1, 2, 2, 2]));
        assert_eq!(of(8).rgb, [2, 2, 2, 1, 1, 1]);
        let exif = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0";
        assert_eq!(orientation(exif), Some(6));
        assert_eq!(orientation(&exif[..20]), None);
        assert_eq!(orientation(b"II"), None);
    }

    #[test]
    fn a_jpeg_that_is_cut_short_is_an_error() {
        let whole = include_bytes!("../../tests/data/progressive.jpg");
        for length in [whole.len() - 2, whole.len() / 2 + 100] {
            let fault = from_jpeg(&whole[..length], MOST_PIXELS).unwrap_err();
            assert!(
                matches!(&fault, Fault::Damaged(problem) if problem.contains("cut short")),
                "{fault:?}"
            );
        }
    }

    #[test]
    fn damaged_files_are_errors() {
        for bytes in [&b"\x89PNG\r\n\x1a\n"[..], b"\xff\xd8\xff\xe0", b"\xff\xd8", b"\x89PNG"] {
            assert!(from_png(bytes, MOST_PIXELS).is_err());
            assert!(from_jpeg(bytes, MOST_PIXELS).is_err());
        }
        // A header that asks for 2^31 pixels a side.
        let mut huge =
            b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x02\0\0\0".to_vec();
        huge.extend([0; 4]);
        assert!(from_png(&huge, MOST_PIXELS).is_err());
        assert!(matches!(allowed(usize::MAX, 3, MOST_PIXELS), Err(Fault::Large(_))));
        assert!(allowed(0, 5, 25).is_err() && allowed(5, 5, 25).is_ok());
        let Err(Fault::Large(problem)) = allowed(5, 6, 25) else { panic!("30 of 25 pixels") };
        assert!(problem.contains("at most 25 have room"), "{problem}");
    }
}
