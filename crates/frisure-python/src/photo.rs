//! Photos of locks; `python/frisure/photos.py` has the units.

use std::path::PathBuf;

use frisure::formats::picture::photo::{MOST_PIXELS, Pixels, read};
use frisure::hairstyle::preset;
use frisure::measure::{Crop, Hang, Options, Photo, Scale, draw, measure};
use frisure_engine::photo::KnownFibre;
use frisure_engine::{Error, memory};
use numpy::PyReadonlyArray3;
use numpy::ndarray::{ArrayView3, Axis};
use pyo3::prelude::*;

use crate::array::Memory;
use crate::errors::{argument, raise};
use crate::{room, work};

/// A photo: a file, or rows from the top of pixels of red, green, blue (and alpha, which is left out).
#[derive(FromPyObject)]
pub(crate) enum Source<'py> {
    Pixels(PyReadonlyArray3<'py, u8>),
    File(PathBuf),
}

/// Bytes that are copied between two looks at signals.
const BLOCK: usize = 1 << 24;

/// A copy of an array with three or four channels.
///
/// # Errors
/// `ArgumentError`, if it has more pixels than are measured or have room in memory, and what a signal raises.
fn copied(py: Python<'_>, array: ArrayView3<'_, u8>) -> PyResult<Pixels> {
    let (height, width, channels) = array.dim();
    let free = memory::room(memory::PHOTO_PIXEL, 0.0);
    if width.checked_mul(height).is_none_or(|pixels| pixels > free.min(MOST_PIXELS)) {
        let most = match free < MOST_PIXELS {
            true => format!("{free} have room in the memory that is free"),
            false => format!("{MOST_PIXELS} are read"),
        };
        let problem = format!("photo has {width} x {height} pixels; at most {most}");
        return Err(argument(py, &problem));
    }
    let mut rgb = room::list("bytes", 3 * width * height).map_err(|e| raise(py, &e))?;
    for rows in array.axis_chunks_iter(Axis(0), (BLOCK / (width * channels).max(1)).max(1)) {
        py.check_signals()?;
        py.detach(|| append(&mut rgb, rows));
    }
    Ok(Pixels { width, height, rgb })
}

/// Appends red, green and blue of the pixels of some rows.
fn append(rgb: &mut Vec<u8>, rows: ArrayView3<'_, u8>) {
    let (height, width, channels) = rows.dim();
    if let Some(bytes) = rows.as_slice().filter(|_| channels == 3) {
        return rgb.extend_from_slice(bytes);
    }
    let start = rgb.len();
    rgb.resize(start + 3 * width * height, 0);
    if width == 0 {
        return;
    }
    for (line, row) in rgb[start..].chunks_exact_mut(3 * width).zip(rows.outer_iter()) {
        match row.as_slice() {
            Some(bytes) if channels == 3 => line.copy_from_slice(bytes),
            Some(bytes) => {
                for (place, pixel) in line.chunks_exact_mut(3).zip(bytes.chunks_exact(channels)) {
                    place.copy_from_slice(&pixel[..3]);
                }
            }
            None => {
                for channel in 0..3 {
                    let places = line.iter_mut().skip(channel).step_by(3);
                    places.zip(row.column(channel)).for_each(|(place, value)| *place = *value);
                }
            }
        }
    }
}

/// What is known besides the photo.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct KnownOfLock {
    hair_type: String,
    length: Option<f64>,
    diameter: Option<f64>,
    axis_ratio: Option<f64>,
    youngs_modulus: Option<f64>,
}

impl KnownOfLock {
    fn fibre(&self) -> Result<KnownFibre, Error> {
        let preset = preset(&self.hair_type).ok_or_else(|| {
            let problem = format!("there is no hair type {:?}", self.hair_type);
            Error::invalid(problem, "frisure.presets has them")
        })?;
        Ok(KnownFibre {
            hair_type: preset.hair_type(),
            diameter: self.diameter,
            axis_ratio: self.axis_ratio,
            youngs_modulus: self.youngs_modulus,
        })
    }
}

/// Measures a lock: the measurement or why there is none as JSON, and the photo with what was found drawn over it.
#[pyfunction]
#[pyo3(signature = (photo, scale, crop, hangs, known, progress))]
pub(crate) fn measure_photo(
    py: Python<'_>,
    photo: Source<'_>,
    scale: &str,
    crop: Option<(usize, usize, usize, usize)>,
    hangs: bool,
    known: KnownOfLock,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Memory)> {
    let scale = Scale::parse(scale).map_err(|problem| {
        raise(py, &Error::invalid(format!("scale is {scale:?}: {problem}"), ""))
    })?;
    let given = match photo {
        Source::Pixels(array) => Ok(copied(py, array.as_array())?),
        Source::File(path) => Err(path),
    };
    let crop = crop.map(|(x, y, width, height)| Crop { x, y, width, height });
    let found = work::run(py, progress, move |p| {
        let mut pixels = match given {
            Ok(pixels) => pixels,
            Err(path) => read(&path, memory::room(memory::PHOTO_PIXEL, 0.0))
                .map_err(|e| Error::because(&e, ""))?,
        };
        let fibre = known.fibre()?.fibre().map_err(|e| Error::because(&e, ""))?;
        let hang = if hangs { Hang::Down } else { Hang::None };
        let options = Options { scale, hang, fibre, length: known.length };
        let photo = Photo::new(pixels.width, pixels.height, &pixels.rgb, crop)
            .map_err(|e| Error::because(&e, ""))?;
        let outcome = measure(&photo, &options, p)?;
        draw(pixels.width, &mut pixels.rgb, &outcome.drawing);
        let told = match &outcome.result {
            Ok(found) => serde_json::to_value(found),
            Err(why) => Ok(serde_json::json!({ "reason": why.to_string(), "hint": why.hint() })),
        };
        let told = told.map_err(|e| Error::failed(&e, ""))?.to_string();
        Ok((told, pixels.rgb, vec![pixels.height, pixels.width, 3]))
    });
    found.map(|(told, rgb, shape)| (told, Memory::whole(rgb, shape)))
}
