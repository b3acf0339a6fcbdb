//! The noise estimate that stops a tile.
//!
//! A tile's noise is the standard error of its pixels as a screen would show it: light is taken to the
//! root, about the transfer curve of displays, so that 0.01 is one part in a hundred from black to white.
//! It is found from the difference of the picture's two halves (as in Dammertz et al. 2010, *A hierarchical
//! automatic stopping condition for Monte Carlo global illumination*), every other block of samples each. A
//! block is evenly spread by itself, so that much of what even spreading gains is seen; that all blocks
//! together are spread evenly, too, is not: the figure is on the safe side.

use super::{Accumulator, Pixel, Tile};

/// Light below which the square root is linear, as the toe of a display's curve; chosen, not measured.
const TOE: f32 = 0.01;

/// Samples per block (a power of two, so that a block is stratified). Chosen.
const BLOCK: u32 = 8;

/// Whether a sample belongs to the first of the two halves.
pub(in super::super) fn in_first_half(index: u32) -> bool {
    (index / BLOCK).is_multiple_of(2)
}

/// Number of samples in the first half among `samples`.
fn first_half(samples: u32) -> u32 {
    samples / (2 * BLOCK) * BLOCK + (samples % (2 * BLOCK)).min(BLOCK)
}

impl Tile {
    /// Root mean square of the pixels' standard error, on a display's scale; infinite before each half
    /// has a block.
    pub(in super::super) fn noise(&self) -> f32 {
        if self.samples < 2 * BLOCK {
            return f32::INFINITY;
        }
        let sum: f32 = self.pixels.iter().map(|pixel| self.squared(pixel)).sum();
        (sum / self.pixels.len() as f32).sqrt()
    }

    fn squared(&self, pixel: &Pixel) -> f32 {
        let (all, first) = (self.samples as f32, first_half(self.samples) as f32);
        let mean = pixel.light / all;
        let difference = mean - pixel.half / first;
        // Of halves of a and b samples, the whole differs from the first by b/a of its own variance.
        let variance = difference.length_squared() / 3.0 * first / (all - first);
        // d√x/dx = ½/√x carries the error of light to that of the display.
        let slope = 0.5 / (mean.element_sum() / 3.0).max(TOE).sqrt();
        variance * slope * slope
    }
}

impl Accumulator {
    /// How noisy it is: the root mean square of the pixels' standard error, where 1 is all that a
    /// display has from black to white. Infinite before every pixel has sixteen samples.
    #[must_use]
    pub fn noise(&self) -> f32 {
        let of = |tile: &Tile| tile.pixels.len() as f32 * tile.noise().powi(2);
        let sum: f32 = self.tiles.iter().map(of).sum();
        (sum / (self.width * self.height) as f32).sqrt()
    }
}
