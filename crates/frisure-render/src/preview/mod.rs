//! A picture of hair in seconds, by projection: what `predict` shows before anyone asks for the
//! traced picture.
//!
//! In the order of the computation: `curves` makes each strand smooth on the screen; `density` and
//! `ambient` measure how much hair lies between any point and each lamp or the environment, and `shadow` whether
//! the head does; `tiles` sorts the pieces of hair into small squares of the picture, and `composite`
//! lays them over the rasterised `head` from front to back, asking `shading` only for hair that is
//! seen. Lamps at a place are taken as far away in the direction in which the middle of the head sees
//! them, and an environment as its brightest spots and the mean of the rest by direction. Lamps follow Kajiya & Kay 1989 with the lobes of Marschner et al. 2003; self-shadowing is
//! the light-oriented density map of Bertails, Ménier & Cani 2005.
//!
//! What it does not do: light that bounces between hairs is a colour, not a computation; a hair's
//! section is round; and hairs that cross within one short piece may be seen in the wrong order.

mod ambient;
mod composite;
pub mod constants;
mod curves;
mod density;
mod head;
mod material;
pub mod parts;
mod projection;
mod raster;
mod shading;
mod shadow;
mod tiles;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure_strands::{Strands, Surface};
use glam::{DVec3, UVec3, Vec3};
use rayon::prelude::*;
use thiserror::Error;

use crate::{Camera, Image, Lights, Look};

use composite::TilePainter;
use curves::Curves;
use head::Head;
use material::Materials;
use projection::Projection;
use shading::Shader;
use tiles::{TILE, TileGrid};

/// Largest width or height of a picture (pixels).
pub const MAX_SIZE: usize = 16_384;

/// Everything that a picture shows.
///
/// Three attributes of the strands are used where they are present: `guide` (u32 per strand), whose
/// wisps then differ slightly in pigment; `tint` (f32 per strand), a factor on the pigment that
/// replaces all variation of our own; `wetness` (f32 per point, 0 to 1), which darkens the hair and
/// sharpens its highlights.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// The hair. Strands with fewer than two points or with a coordinate or radius that is not
    /// finite are left out.
    pub strands: &'a Strands,
    /// The head, which hides hair and is hidden by it; none draws hair alone.
    pub surface: Option<&'a Surface>,
    /// Where it is seen from.
    pub camera: Camera,
    /// What lights it.
    pub lights: Lights,
    /// What it looks like.
    pub look: Look,
}

impl<'a> Scene<'a> {
    /// The scene in the default look, framed from the three-quarter front view of a portrait for a
    /// square picture, in a studio that turns with that camera.
    #[must_use]
    pub fn portrait(strands: &'a Strands, surface: Option<&'a Surface>) -> Self {
        let camera = Camera::framing(bounds(strands, surface), 0.5, 0.08, 1.0);
        let lights = Lights::studio(&camera);
        Self { strands, surface, camera, lights, look: Look::default() }
    }
}

/// Size and quality of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreviewOptions {
    /// Pixels across, 1 to [`MAX_SIZE`].
    pub width: usize,
    /// Pixels down, 1 to [`MAX_SIZE`].
    pub height: usize,
    /// Samples along each side of a pixel for the edges of the head, 1 to 8. (Hair needs none: its
    /// coverage is computed.)
    pub samples: usize,
    /// Factor on the width of every strand, which lets few strands stand for many; `None` chooses
    /// it from their number: 1 from 100 000 strands, about 3 for 20 000.
    pub width_scale: Option<f32>,
}

impl Default for PreviewOptions {
    fn default() -> Self {
        Self { width: 1024, height: 1024, samples: 4, width_scale: None }
    }
}

/// Why there is no picture.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum PreviewError {
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
}

/// Draws the scene.
///
/// `watch` is called with the part that is done, 0 to 1, from any of rayon's threads; the picture is
/// given up when it answers [`ControlFlow::Break`]. The same input gives the same bytes on any number
/// of threads.
///
/// # Errors
/// [`PreviewError`], if the size is impossible or `watch` said to stop.
pub fn render(
    scene: &Scene<'_>,
    options: &PreviewOptions,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Image, PreviewError> {
    let (width, height) = (options.width, options.height);
    if !(1..=MAX_SIZE).contains(&width) || !(1..=MAX_SIZE).contains(&height) {
        return Err(PreviewError::Size { width, height });
    }
    let go_on = |done: f64| match watch(done) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(PreviewError::Cancelled),
    };
    go_on(0.0)?;

    let view = Projection::new(&scene.camera, width, height);
    let scale = width_scale(scene.strands, options);
    let curves = Curves::new(scene.strands, &view, scale);
    go_on(0.1)?;
    let materials = Materials::new(scene.strands, &scene.look.hair);
    let mut head = scene.surface.map(Head::new);
    let shader = Shader::new(scene, &curves, materials, head.as_mut());
    go_on(0.3)?;
    let grid = TileGrid::new(&view, &curves, head.as_ref());
    go_on(0.4)?;

    let painter = TilePainter {
        view: &view,
        curves: &curves,
        head: head.as_ref(),
        shader: &shader,
        background: scene.look.background,
        environment: &scene.lights.environment,
        samples: options.samples.clamp(1, 8),
    };
    let done = AtomicUsize::new(0);
    let tiles: Vec<Vec<[f32; 4]>> = (0..grid.len())
        .into_par_iter()
        .map(|tile| {
            let before = done.fetch_add(1, Ordering::Relaxed);
            go_on(0.4 + 0.6 * before as f64 / grid.len() as f64)?;
            Ok(painter.paint(&grid, tile))
        })
        .collect::<Result<_, _>>()?;
    let image = assemble(&tiles, &grid, width, height);
    go_on(1.0)?;
    Ok(image)
}

/// The box (smallest and largest corner, m) that a picture of this hair should show, for
/// [`Camera::framing`]: all finite points of the strands, and of the surface its upper 0.27 m, the
/// head without the shoulders. Without strands it is the whole surface; without either, a box around
/// a head at the origin.
#[must_use]
pub fn bounds(strands: &Strands, surface: Option<&Surface>) -> (DVec3, DVec3) {
    let hair = enclose(strands.points().iter().map(|p| p.as_dvec3()).filter(|p| p.is_finite()));
    let head = surface.and_then(|surface| {
        let top = surface.bounds().1.z;
        let shown = |p: &DVec3| hair.is_none() || p.z > top - HEAD;
        enclose(surface.positions().iter().copied().filter(shown))
    });
    match (hair, head) {
        (Some(a), Some(b)) => (a.0.min(b.0), a.1.max(b.1)),
        (Some(all), None) | (None, Some(all)) => all,
        (None, None) => (DVec3::splat(-0.15), DVec3::splat(0.15)),
    }
}

/// The middle of the head (m), or of the hair where there is no head: what lamps are aimed at.
#[must_use]
pub fn middle(strands: &Strands, surface: Option<&Surface>) -> DVec3 {
    let head = surface.and_then(|surface| {
        let top = surface.bounds().1.z;
        enclose(surface.positions().iter().copied().filter(|p| p.z > top - HEAD))
    });
    let (low, high) = head.unwrap_or_else(|| bounds(strands, None));
    0.5 * (low + high)
}

/// From the crown to below the chin (m).
const HEAD: f64 = 0.27;

/// The box around some points; `None` without points.
fn enclose(mut points: impl Iterator<Item = DVec3>) -> Option<(DVec3, DVec3)> {
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
}

/// The factor on the strands' width: given, or chosen.
fn width_scale(strands: &Strands, options: &PreviewOptions) -> f32 {
    let given = options.width_scale.filter(|s| s.is_finite() && *s > 0.0);
    given.unwrap_or_else(|| chosen_width(strands.len()))
}

/// The factor on the width of `count` strands with which fewer than a full head still cover it.
#[must_use]
pub fn chosen_width(count: usize) -> f32 {
    /// Hairs on a head.
    const FULL_HEAD: f32 = 100_000.0;
    (FULL_HEAD / count.max(1) as f32).powf(0.7).clamp(1.0, 6.0)
}

/// Puts the tiles into one picture.
fn assemble(tiles: &[Vec<[f32; 4]>], grid: &TileGrid, width: usize, height: usize) -> Image {
    let mut image = Image::new(width, height);
    for (index, tile) in tiles.iter().enumerate() {
        let area = grid.area(index);
        for row in area.y0..area.y1 {
            let from = (row - area.y0) * TILE;
            let to = row * width + area.x0;
            let n = area.x1 - area.x0;
            image.pixels_mut()[to..to + n].copy_from_slice(&tile[from..from + n]);
        }
    }
    image
}

/// The cell of a grid that a place (in cells, not negative) lies in, and where in it. Casts, since
/// rounding is a call into the C library on processors without SSE 4.1.
fn split(place: Vec3) -> (UVec3, Vec3) {
    let cell = place.as_uvec3();
    (cell, place - cell.as_vec3())
}

/// Two unit vectors that make a right-handed frame with the unit vector `w`.
fn frame(w: Vec3) -> (Vec3, Vec3) {
    let u = w.any_orthonormal_vector();
    (u, w.cross(u))
}
