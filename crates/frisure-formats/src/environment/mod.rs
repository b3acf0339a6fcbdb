//! Environment maps with all of their light: Radiance `.hdr` and OpenEXR `.exr`.

mod map;
#[cfg(feature = "exr")]
mod openexr;
mod radiance;

use std::path::{Path, PathBuf};

use thiserror::Error;

use frisure_files::{Files, ReadError};

pub use map::Environment;

/// Largest file that is read (bytes).
const MAX_SIZE: u64 = 1 << 30;

/// Negative light that is no more than rounding.
const ROUNDING: f32 = 0.01;

/// Brightest light that is understood.
const BRIGHTEST: f32 = 1e12;

/// Why there is no environment.
#[derive(Debug, Error)]
pub enum EnvironmentError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Its name has another ending.
    #[error("environments are read from `.hdr` and `.exr`; `{}` is neither", path.display())]
    Extension {
        /// The path given.
        path: PathBuf,
    },
    /// The file is of another format, or no environment map.
    #[error("`{}` {problem}", path.display())]
    Broken {
        /// The path given.
        path: PathBuf,
        /// The fault, as words that follow the file's name.
        problem: String,
    },
}

impl EnvironmentError {
    /// What to try; may be empty.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Extension { path } if is_of_screens(path) => {
                "a picture for screens cuts off all lamps at white; environments keep them"
            }
            Self::Broken { problem, .. } if problem.contains("twice as wide") => {
                "convert it to an equirectangular (latitude-longitude) picture"
            }
            Self::Broken { problem, .. } if problem.contains("have room") => {
                "a map of 4096 x 2048 pixels has all the light that hair shows; make this one smaller"
            }
            _ => "",
        }
    }
}

/// Whether a file's name is that of a picture of a few bits.
fn is_of_screens(path: &Path) -> bool {
    let endings = ["png", "jpg", "jpeg", "webp", "avif", "gif", "bmp", "tga", "tif", "tiff"];
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    endings.contains(&ending.as_str())
}

/// Reads an environment of at most `most` pixels, such as there is memory for; its name says which format.
///
/// # Errors
/// [`EnvironmentError`], also for a picture that is not twice as wide as it is high, larger than 16 384 ×
/// 8192, or that has light below zero, above 1e12 or not finite. Negative light down to −0.01 becomes 0.
pub fn read(path: &Path, files: &Files, most: usize) -> Result<Environment, EnvironmentError> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    let decode = match ending.as_str() {
        "hdr" => radiance::decode,
        #[cfg(feature = "exr")]
        "exr" => openexr::decode,
        _ => return Err(EnvironmentError::Extension { path: path.into() }),
    };
    let bytes = files.read_bytes(path, MAX_SIZE, "an environment")?;
    let broken = |problem| EnvironmentError::Broken { path: path.into(), problem };
    let mut environment = decode(&bytes, most).map_err(broken)?;
    clean(&mut environment).map_err(broken)?;
    Ok(environment)
}

/// Takes rounding below zero away, and refuses what is no light.
fn clean(environment: &mut Environment) -> Result<(), String> {
    let width = environment.width;
    for (i, pixel) in environment.pixels.iter_mut().enumerate() {
        if pixel.iter().all(|x| (-ROUNDING..=BRIGHTEST).contains(x)) {
            *pixel = pixel.map(|x| x.max(0.0));
            continue;
        }
        let what = match pixel.iter().any(|x| *x < 0.0 && x.is_finite()) {
            true => "light is not negative",
            false => "light is finite, at most 1e12",
        };
        let (x, y) = (i % width, i / width);
        return Err(format!("has {pixel:?} in column {x} of row {y}; {what}"));
    }
    Ok(())
}

#[cfg(test)]
mod tests;
