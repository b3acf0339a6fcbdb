//! The final picture: light followed from the eye through hair, head and lamps.
//!
//! An unbiased path tracer on the CPU. Beside the attributes of [`crate::preview::Scene`] it uses `d1`
//! (three numbers per point), the director along the semi-axis a of the section, and `axis_ratio` (a/b,
//! per strand); without them fibres are round. Rays meet round tubes of the mean radius. In the order of the computation: `sampler` gives each sample of
//! each pixel its numbers, `integrator` follows the light, scattered by the fibres of `hair` and by the
//! skin, to the `lights`.

mod hair;
mod integrator;
mod lights;
mod sampler;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure_optics::scattering::FibreError;
use glam::Vec3;
use rayon::prelude::*;
use thiserror::Error;

use crate::accel::{self, AccelError, CurveOptions, Ray};
use crate::preview::{MAX_SIZE, Scene};
use crate::{Camera, Image};
use hair::Fibres;
use integrator::World;
use lights::Outside;
use sampler::Sampler;

/// Size and quality of a traced picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceOptions {
    /// Pixels across, 1 to [`MAX_SIZE`].
    pub width: usize,
    /// Pixels down, 1 to [`MAX_SIZE`].
    pub height: usize,
    /// Paths per pixel, 1 to 65 536; powers of two are spread best.
    pub samples: usize,
    /// Most bounces of a path; light hair needs 50 and more.
    pub bounces: u32,
    /// Another seed, other noise.
    pub seed: u32,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self { width: 1024, height: 1024, samples: 64, bounces: 100, seed: 1 }
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
    /// A number of samples of zero or above 65 536.
    #[error("{samples} samples per pixel: there must be 1 to {MAX_SAMPLES}")]
    Samples {
        /// Samples asked for.
        samples: usize,
    },
    /// Strands or head cannot be met by rays.
    #[error(transparent)]
    Accel(#[from] AccelError),
    /// The look makes no fibre.
    #[error("the fibre's {0}")]
    Fibre(FibreError),
}

/// Most samples per pixel.
const MAX_SAMPLES: usize = 65_536;

/// Radius of the picture's filter (pixels), a tent: sharper than a Gaussian, no ringing.
const FILTER: f32 = 1.0;

/// Traces the scene.
///
/// `watch` is called with the part that is done, 0 to 1, from any of rayon's threads; the picture is
/// given up when it answers [`ControlFlow::Break`]. The same input gives the same bytes on any number
/// of threads.
///
/// # Errors
/// [`TraceError`], if an option or the scene is impossible, or `watch` said to stop.
pub fn render(
    scene: &Scene<'_>,
    options: &TraceOptions,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Image, TraceError> {
    let TraceOptions { width, height, samples, .. } = *options;
    if !(1..=MAX_SIZE).contains(&width) || !(1..=MAX_SIZE).contains(&height) {
        return Err(TraceError::Size { width, height });
    }
    if !(1..=MAX_SAMPLES).contains(&samples) {
        return Err(TraceError::Samples { samples });
    }
    let world = World {
        scene: accel::Scene::new(scene.strands, scene.surface, &CurveOptions::default())?,
        fibres: Fibres::new(scene.strands, &scene.look.hair).map_err(TraceError::Fibre)?,
        outside: Outside::new(&scene.lights),
        skin: scene.look.skin,
        bounces: options.bounces,
    };
    let mut image = Image::new(width, height);
    let rows = AtomicUsize::new(0);
    let drawn: Result<(), TraceError> = image
        .pixels_mut()
        .par_chunks_mut(width)
        .enumerate()
        .map(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = self::pixel(scene, &world, options, (x, y));
            }
            let done = rows.fetch_add(1, Ordering::Relaxed) + 1;
            match watch(done as f64 / height as f64) {
                ControlFlow::Continue(()) => Ok(()),
                ControlFlow::Break(()) => Err(TraceError::Cancelled),
            }
        })
        .collect();
    drawn.map(|()| image)
}

/// The mean of all paths of a pixel, over the background.
fn pixel(
    scene: &Scene<'_>,
    world: &World,
    options: &TraceOptions,
    (x, y): (usize, usize),
) -> [f32; 4] {
    let (mut light, mut alpha) = (Vec3::ZERO, 0.0);
    for index in 0..options.samples {
        let number = (y * options.width + x) as u32;
        let mut sampler = Sampler::new(options.seed, number, index as u32);
        let [u, v] = sampler.pair().map(tent);
        let place = [
            2.0 * (x as f32 + 0.5 + u) / options.width as f32 - 1.0,
            1.0 - 2.0 * (y as f32 + 0.5 + v) / options.height as f32,
        ];
        let aspect = options.width as f32 / options.height as f32;
        let seen = world.seen(through(&scene.camera, place, aspect), &mut sampler);
        let (behind, covers) = scene.look.background.at(place[0], place[1]);
        if seen.covered {
            light += seen.radiance;
            alpha += 1.0;
        } else {
            light += behind;
            alpha += covers;
        }
    }
    let share = 1.0 / options.samples as f32;
    (light * share).extend(alpha * share).to_array()
}

/// The ray through a place of the picture, from −1 to 1 to the right and upwards.
fn through(camera: &Camera, [x, y]: [f32; 2], aspect: f32) -> Ray {
    let tan = (0.5 * camera.vertical_fov()).tan() as f32;
    let direction = camera.forward().as_vec3()
        + camera.right().as_vec3() * (x * tan * aspect)
        + camera.up().as_vec3() * (y * tan);
    Ray::new(camera.eye().as_vec3(), direction)
}

/// A number in [0, 1) as one with a tent of radius [`FILTER`] about zero as density.
fn tent(u: f32) -> f32 {
    let (side, u) = if u < 0.5 { (-1.0, 2.0 * u) } else { (1.0, 2.0 * (1.0 - u)) };
    side * FILTER * (1.0 - u.sqrt())
}
