//! Options of the path tracer, and its errors.

use frisure_optics::scattering::FibreError;
use glam::DVec3;
use thiserror::Error;

use crate::accel::AccelError;
use crate::film::MAX_SIZE;

/// Most samples per pixel. A guard on time.
pub const MAX_SAMPLES: usize = 65_536;

/// Most pixels of a picture: 8192 × 8192, which need 10 GiB of memory.
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
    /// Noise at which a tile of the picture stops ([`super::Accumulator::noise`]), above 0; `None` gives each
    /// tile all its paths.
    pub noise: Option<f32>,
    /// Most bounces of a path (maximum depth); light hair needs 50 and more.
    pub bounces: u32,
    /// The most light that a path may bring which was scattered twice or more, in each colour, above 0 (radiance; white paper in
    /// the picture's light has about 1): the firefly clamp. It takes away single bright pixels, and darkens the picture where
    /// much light comes that way; `None` is exact.
    pub clamp: Option<f32>,
    /// Seed of the sampler.
    pub seed: u32,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self {
            width: 1024,
            height: 1024,
            samples: 64,
            noise: None,
            bounces: 100,
            clamp: None,
            seed: 1,
        }
    }
}

/// Why a picture cannot be traced.
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
        /// The number given.
        samples: usize,
    },
    /// A noise that is not above 0.
    #[error("the noise to stop at must be above 0, not {noise}")]
    Noise {
        /// The noise given.
        noise: f32,
    },
    /// A firefly clamp that is not above 0.
    #[error("the firefly clamp must be above 0, not {clamp}")]
    Clamp {
        /// The clamp given.
        clamp: f32,
    },
    /// No strand has two points.
    #[error("there is no hair: no strand has two points")]
    NoHair,
    /// The camera is inside the head.
    #[error("the camera is inside the head, at {eye} m")]
    Inside {
        /// Position (m).
        eye: DVec3,
    },
    /// Strands or head cannot be put into a BVH.
    #[error(transparent)]
    Accel(#[from] AccelError),
    /// The look makes no fibre.
    #[error("the fibre's {0}")]
    Fibre(FibreError),
}

impl TraceOptions {
    /// Checks the options; worth calling before the strands are computed.
    ///
    /// # Errors
    /// [`TraceError`], for the first option out of range.
    pub fn check(&self) -> Result<(), TraceError> {
        let Self { width, height, samples, noise, clamp, .. } = *self;
        if !(1..=MAX_SIZE).contains(&width) || !(1..=MAX_SIZE).contains(&height) {
            return Err(TraceError::Size { width, height });
        }
        if width * height > MAX_PIXELS {
            return Err(TraceError::Pixels { width, height });
        }
        if !(1..=MAX_SAMPLES).contains(&samples) {
            return Err(TraceError::Samples { samples });
        }
        let positive =
            |value: Option<f32>| value.filter(|x| x.is_nan() || *x <= 0.0).map_or(Ok(()), Err);
        positive(noise).map_err(|noise| TraceError::Noise { noise })?;
        positive(clamp).map_err(|clamp| TraceError::Clamp { clamp })
    }
}
