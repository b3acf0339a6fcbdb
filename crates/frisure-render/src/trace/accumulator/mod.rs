//! The accumulator (film): sums of samples per pixel, which are a picture at any time and can be resumed.
//!
//! The film is cut into tiles, the unit of work and of stopping. All pixels of a tile have the same number of
//! samples, so that a render that was interrupted anywhere resumes to the same bytes as one that was not.

mod checkpoint;
mod layers;
mod noise;

pub use checkpoint::{AccumulatorError, MAGIC, VERSION};
pub use layers::Layers;
pub(super) use noise::in_first_half;

use glam::Vec3;

use crate::Image;

/// Side of a tile (pixels). Chosen; part of a checkpoint's format.
pub(super) const TILE: usize = 16;

/// The film: sums of samples per pixel. It can be shown, written to a checkpoint and resumed.
///
/// ```
/// use frisure_render::Scene;
/// use frisure_render::trace::{TraceOptions, Tracer};
/// use frisure_strands::Strands;
/// use glam::Vec3;
///
/// let mut strands = Strands::new();
/// strands.push(&[Vec3::ZERO, Vec3::new(0.0, 0.02, -0.1)], &[4e-5; 2]);
/// let options = TraceOptions { width: 16, height: 16, samples: 4, ..TraceOptions::default() };
/// let tracer = Tracer::new(&Scene::portrait(&strands, None), &options)?;
///
/// let mut film = tracer.accumulator();
/// assert_eq!(film.mean_samples(), 0.0);
/// tracer.accumulate(&mut film, &()).expect("nothing cancels it");
/// assert_eq!(film.mean_samples(), 4.0);
/// assert!(tracer.can_resume(&film));
/// # Ok::<(), frisure_render::trace::TraceError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Accumulator {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Checkpoint digest of the picture ([`super::Tracer::digest`]).
    pub(super) digest: u64,
    pub(super) tiles: Vec<Tile>,
}

/// A square of the picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tile {
    /// First column and row.
    pub(super) x: usize,
    pub(super) y: usize,
    /// Columns.
    pub(super) width: usize,
    /// Samples in each pixel.
    pub(super) samples: u32,
    pub(super) pixels: Vec<Pixel>,
}

/// Sums over the samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pixel {
    /// Scene-linear light, premultiplied.
    pub(super) light: Vec3,
    /// The light of half the samples: the difference of the halves estimates the noise.
    pub(super) half: Vec3,
    pub(super) alpha: f32,
    /// Sums over primary hits: reflectance,
    pub(super) albedo: Vec3,
    /// unit normal,
    pub(super) normal: Vec3,
    /// unit tangent of hair,
    pub(super) tangent: Vec3,
    /// distance along the view (m),
    pub(super) depth: f32,
    /// number of samples with a hit,
    pub(super) hits: f32,
    /// and number of samples that hit hair.
    pub(super) hair: f32,
    /// A wisp, counted from 1, and by how much it leads (Boyer and Moore's majority vote).
    pub(super) wisp: u32,
    pub(super) lead: u32,
}

impl Pixel {
    /// Counts a sample that hits a wisp, numbered from 1.
    pub(super) fn vote(&mut self, wisp: u32) {
        // A wisp with more than half of the votes is left whatever their order; otherwise one that has many.
        if self.lead == 0 {
            (self.wisp, self.lead) = (wisp, 1);
        } else if self.wisp == wisp {
            self.lead += 1;
        } else {
            self.lead -= 1;
        }
    }
}

impl Accumulator {
    pub(super) fn new(width: usize, height: usize, digest: u64) -> Self {
        let (across, down) = (width.div_ceil(TILE), height.div_ceil(TILE));
        let tile = |i: usize| {
            let (x, y) = (i % across * TILE, i / across * TILE);
            let (columns, rows) = ((width - x).min(TILE), (height - y).min(TILE));
            let pixels = vec![Pixel::default(); columns * rows];
            Tile { x, y, width: columns, samples: 0, pixels }
        };
        let tiles = (0..across * down).map(tile).collect();
        Self { width, height, digest, tiles }
    }

    /// Pixels across.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Mean number of samples (paths) per pixel.
    #[must_use]
    pub fn mean_samples(&self) -> f64 {
        let of = |tile: &Tile| tile.pixels.len() as f64 * f64::from(tile.samples);
        self.tiles.iter().map(of).sum::<f64>() / (self.width * self.height) as f64
    }

    /// The picture so far; transparent where there is no sample yet.
    #[must_use]
    pub fn image(&self) -> Image {
        let mut image = Image::new(self.width, self.height);
        let width = self.width;
        self.each(|place, share, pixel| {
            let light = (pixel.light * share).extend(pixel.alpha * share);
            image.pixels_mut()[place.1 * width + place.0] = light.to_array();
        });
        image
    }

    /// Visits every pixel that has samples: its column and row, one over its number of samples, and its sums.
    fn each(&self, mut visit: impl FnMut((usize, usize), f32, &Pixel)) {
        for tile in self.tiles.iter().filter(|tile| tile.samples > 0) {
            let share = 1.0 / tile.samples as f32;
            for (i, pixel) in tile.pixels.iter().enumerate() {
                visit((tile.x + i % tile.width, tile.y + i / tile.width), share, pixel);
            }
        }
    }
}
