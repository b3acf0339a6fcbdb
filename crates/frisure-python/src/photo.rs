//! Photos of locks; `python/frisure/photos.py` has the units.

use std::path::PathBuf;

use frisure::formats::picture::photo::{Pixels, read};
use frisure::hairstyle::preset;
use frisure::measure::{Crop, Hang, Options, Photo, Scale, draw, measure};
use frisure_engine::Error;
use frisure_engine::photo::KnownFibre;
use numpy::PyReadonlyArray3;
use numpy::ndarray::ArrayView3;
use pyo3::prelude::*;

use crate::array::Memory;
use crate::errors::raise;
use crate::work;

/// A photo: a file, or rows from the top of pixels of red, green, blue (and alpha, which is left out).
#[derive(FromPyObject)]
pub(crate) enum Source<'py> {
    Pixels(PyReadonlyArray3<'py, u8>),
    File(PathBuf),
}

fn pixels(array: ArrayView3<'_, u8>) -> Pixels {
    let (height, width, channels) = array.dim();
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| (y, x)));
    let value = |y: usize, x: usize, channel: usize| array[[y, x, channel.min(channels - 1)]];
    let rgb = rows.flat_map(|(y, x)| [0, 1, 2].map(|channel| value(y, x, channel))).collect();
    Pixels { width, height, rgb }
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
        Source::Pixels(array) => Ok(pixels(array.as_array())),
        Source::File(path) => Err(path),
    };
    let crop = crop.map(|(x, y, width, height)| Crop { x, y, width, height });
    let found = work::run(py, progress, move |p| {
        let mut pixels = match given {
            Ok(pixels) => pixels,
            Err(path) => read(&path).map_err(|e| Error::because(&e, ""))?,
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
