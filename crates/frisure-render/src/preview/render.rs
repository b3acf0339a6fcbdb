//! The preview, in the order of its computation.

use std::sync::atomic::{AtomicUsize, Ordering};

use frisure_progress::Progress;
use frisure_strands::Strands;
use rayon::prelude::*;
use thiserror::Error;

use super::area::TILE;
use super::cache::RadianceCache;
use super::composite::TilePainter;
use super::curves::Curves;
use super::head::Head;
use super::material::Materials;
use super::projection::Projection;
use super::shading::Shader;
use super::tiles::TileGrid;
use crate::film::{Image, MAX_SIZE};
use crate::scene::{Scene, facial_hairs};

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

/// Why a picture cannot be drawn.
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
/// ```
/// use frisure_render::Scene;
/// use frisure_render::preview::{PreviewOptions, render};
/// use frisure_strands::Strands;
/// use glam::Vec3;
///
/// let mut strands = Strands::new();
/// strands.push(&[Vec3::ZERO, Vec3::new(0.0, 0.02, -0.1)], &[4e-5; 2]);
/// let options = PreviewOptions { width: 32, height: 32, ..PreviewOptions::default() };
/// let image = render(&Scene::portrait(&strands, None), &options, &())?;
/// assert_eq!(image.to_srgb8().len(), 32 * 32 * 4);
/// # Ok::<(), frisure_render::preview::PreviewError>(())
/// ```
///
/// Reports the stage `picture`. The same input gives the same bytes on any number of threads.
///
/// # Errors
/// [`PreviewError`], if the size is impossible, or `progress` cancels.
pub fn render(
    scene: &Scene<'_>,
    options: &PreviewOptions,
    progress: &dyn Progress,
) -> Result<Image, PreviewError> {
    let (width, height) = (options.width, options.height);
    if !(1..=MAX_SIZE).contains(&width) || !(1..=MAX_SIZE).contains(&height) {
        return Err(PreviewError::Size { width, height });
    }
    let report = |done: f64| {
        progress.report("picture", done);
        progress.check().map_err(|_| PreviewError::Cancelled)
    };
    report(0.0)?;

    let hair = scene.all_hair();
    let scene = &Scene { strands: &hair, ..scene.clone() };
    let view = Projection::new(&scene.camera, width, height);
    let scale = width_scale(scene.strands, options);
    let curves = Curves::new(scene.strands, &view, scale);
    report(0.1)?;
    let materials = Materials::new(scene.strands, &scene.look.hair);
    let surfaces = scene.all_surfaces();
    let mut head = surfaces.as_deref().map(|all| Head::new(all).looking(scene.look.skin));
    let shader = Shader::new(scene, &curves, materials, head.as_mut());
    report(0.3)?;
    let grid = TileGrid::new(&view, &curves, head.as_ref());
    report(0.4)?;

    let painter = TilePainter {
        view: &view,
        curves: &curves,
        head: head.as_ref(),
        shader: &shader,
        radiances: RadianceCache::new(curves.vertices.len()),
        background: scene.look.background,
        environment: &scene.lights.environment,
        samples: options.samples.clamp(1, 8),
    };
    let done = AtomicUsize::new(0);
    let tiles: Vec<Vec<[f32; 4]>> = (0..grid.len())
        .into_par_iter()
        .map(|tile| {
            let before = done.fetch_add(1, Ordering::Relaxed);
            report(0.4 + 0.6 * before as f64 / grid.len() as f64)?;
            Ok(painter.paint(&grid, tile))
        })
        .collect::<Result<_, _>>()?;
    let image = assemble(&tiles, &grid, width, height);
    report(1.0)?;
    Ok(image)
}

/// The factor on the strands' width: given, or chosen.
fn width_scale(strands: &Strands, options: &PreviewOptions) -> f32 {
    let given = options.width_scale.filter(|s| s.is_finite() && *s > 0.0);
    given.unwrap_or_else(|| chosen_width(strands.len() - facial_hairs(strands)))
}

/// The factor on the width of `count` strands with which fewer than a full head still cover it.
#[must_use]
pub fn chosen_width(count: usize) -> f32 {
    /// Hairs on a head. The usual number.
    const FULL_HEAD: f32 = 100_000.0;
    // Less than in proportion, since hairs overlap; the exponent and the bound are chosen by eye.
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
