//! How noisy a picture still is.
//!
//! A tile's noise is the standard error of its pixels as a screen would show it: light is taken to the
//! root, about the transfer curve of displays, so that 0.01 is one part in a hundred from black to white.
//! It is half the difference of the picture's two halves, every other sample each (as in Dammertz et
//! al. 2010, *A hierarchical automatic stopping condition for Monte Carlo global illumination*). Samples
//! that are spread evenly err less than that: the figure is on the safe side.

use super::{Exposure, Pixel, Tile};

/// Light below which the root is taken to be a line: the toe of a display's curve.
const TOE: f32 = 0.01;

impl Tile {
    /// Root mean square of the pixels' standard error, on a display's scale; infinite for fewer than
    /// two samples.
    pub(in super::super) fn noise(&self) -> f32 {
        if self.samples < 2 {
            return f32::INFINITY;
        }
        let sum: f32 = self.pixels.iter().map(|pixel| self.squared(pixel)).sum();
        (sum / self.pixels.len() as f32).sqrt()
    }

    fn squared(&self, pixel: &Pixel) -> f32 {
        let (all, half) = (self.samples as f32, self.samples.div_ceil(2) as f32);
        let mean = pixel.light / all;
        let error = mean - pixel.half / half;
        let slope = 0.5 / mean.element_sum().max(3.0 * TOE).sqrt() * 3.0_f32.sqrt();
        error.length_squared() / 3.0 * slope * slope
    }
}

impl Exposure {
    /// How noisy it is: the root mean square of the pixels' standard error, where 1 is all that a
    /// display has from black to white. Infinite before every pixel has two samples.
    #[must_use]
    pub fn noise(&self) -> f32 {
        let of = |tile: &Tile| tile.pixels.len() as f32 * tile.noise().powi(2);
        let sum: f32 = self.tiles.iter().map(of).sum();
        (sum / (self.width * self.height) as f32).sqrt()
    }
}
