//! What is asked for, and whether it is possible: known before the work.

use frisure_optics::scattering::FibreError;
use frisure_strands::{AttributeValues, Domain, Strands};
use glam::DVec3;
use thiserror::Error;

use super::fingerprint::Fingerprint;
use crate::accel::AccelError;
use crate::preview::{MAX_SIZE, Scene};

/// Most samples per pixel.
pub const MAX_SAMPLES: usize = 65_536;

/// Most pixels of a picture: 8192 × 8192, which need 6 GiB of memory.
pub const MAX_PIXELS: usize = 1 << 26;

/// Size and quality of a traced picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceOptions {
    /// Pixels across, 1 to [`MAX_SIZE`].
    pub width: usize,
    /// Pixels down, 1 to [`MAX_SIZE`]; [`MAX_PIXELS`] in all.
    pub height: usize,
    /// Paths per pixel, at most; 1 to [`MAX_SAMPLES`]. Powers of two are spread best.
    pub samples: usize,
    /// Noise at which a tile of the picture is good enough ([`super::Exposure::noise`]), above 0; `None`
    /// gives all its paths to each.
    pub noise: Option<f32>,
    /// Most bounces of a path; light hair needs 50 and more.
    pub bounces: u32,
    /// Another seed, other noise.
    pub seed: u32,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self { width: 1024, height: 1024, samples: 64, noise: None, bounces: 100, seed: 1 }
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TraceError {
    /// The caller asked to stop.
    #[error("the picture was cancelled")]
    Cancelled,
    /// A width or height of zero or above [`MAX_SIZE`].
    #[error("a picture of {width}×{height} pixels: each side must have 1 to {MAX_SIZE}")]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// More than [`MAX_PIXELS`].
    #[error(
        "a picture of {width}×{height} pixels: a traced one has at most {MAX_PIXELS}, \
         such as 8192×8192"
    )]
    Pixels {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// A number of samples of zero or above [`MAX_SAMPLES`].
    #[error("{samples} paths per pixel: there must be 1 to {MAX_SAMPLES}")]
    Samples {
        /// Samples asked for.
        samples: usize,
    },
    /// A noise that is not above 0.
    #[error("the noise to stop at must be above 0, not {noise}")]
    Noise {
        /// Noise asked for.
        noise: f32,
    },
    /// No strand has two points.
    #[error("there is no hair: no strand has two points")]
    NoHair,
    /// The camera is inside the head.
    #[error("the camera is inside the head, at {eye} m")]
    Inside {
        /// Where it is (m).
        eye: DVec3,
    },
    /// Strands or head cannot be met by rays.
    #[error(transparent)]
    Accel(#[from] AccelError),
    /// The look makes no fibre.
    #[error("the fibre's {0}")]
    Fibre(FibreError),
}

impl TraceOptions {
    /// Whether they are possible: to be known before the strands are computed.
    ///
    /// # Errors
    /// [`TraceError`], for the first that is not.
    pub fn check(&self) -> Result<(), TraceError> {
        let Self { width, height, samples, noise, .. } = *self;
        if !(1..=MAX_SIZE).contains(&width) || !(1..=MAX_SIZE).contains(&height) {
            return Err(TraceError::Size { width, height });
        }
        if width * height > MAX_PIXELS {
            return Err(TraceError::Pixels { width, height });
        }
        if !(1..=MAX_SAMPLES).contains(&samples) {
            return Err(TraceError::Samples { samples });
        }
        match noise {
            Some(noise) if noise.is_nan() || noise <= 0.0 => Err(TraceError::Noise { noise }),
            _ => Ok(()),
        }
    }
}

pub(super) fn strands(strands: &Strands) -> Result<(), TraceError> {
    let any = strands.iter().any(|strand| strand.points.len() >= 2);
    if any { Ok(()) } else { Err(TraceError::NoHair) }
}

/// The wisp of each strand, if strands know theirs.
pub(super) fn wisps(strands: &Strands) -> Option<Vec<u32>> {
    let guide = strands.attribute("guide").filter(|a| a.domain == Domain::Strand)?;
    match &guide.values {
        AttributeValues::U32(wisps) => Some(wisps.clone()),
        _ => None,
    }
}

/// Of all that makes a picture but its camera and lights.
pub(super) fn fingerprint(scene: &Scene<'_>, options: &TraceOptions) -> Fingerprint {
    let mut all = Fingerprint::new();
    all.put(env!("CARGO_PKG_VERSION").as_bytes());
    let Scene { strands, surface, look, .. } = scene;
    for strand in strands.iter() {
        strand.points.iter().for_each(|p| put(&mut all, &p.to_array()));
        put(&mut all, strand.radii);
    }
    for attribute in strands.attributes() {
        all.put(attribute.name.as_bytes());
        match &attribute.values {
            AttributeValues::F32(values) => put(&mut all, values),
            AttributeValues::F32x2(values) => put(&mut all, values.as_flattened()),
            AttributeValues::F32x3(values) => put(&mut all, values.as_flattened()),
            AttributeValues::U32(values) => values.iter().for_each(|x| all.put(&x.to_le_bytes())),
            AttributeValues::U32x3(values) => {
                values.as_flattened().iter().for_each(|x| all.put(&x.to_le_bytes()));
            }
        }
    }
    if let Some(surface) = surface {
        let corners = surface.positions().iter().flat_map(DVec3::to_array);
        corners.for_each(|x| all.put(&x.to_le_bytes()));
    }
    let TraceOptions { width, height, bounces, seed, .. } = options;
    all.put(format!("{look:?} {width} {height} {bounces} {seed}").as_bytes());
    all
}

fn put(all: &mut Fingerprint, values: &[f32]) {
    values.iter().for_each(|x| all.put(&x.to_le_bytes()));
}
