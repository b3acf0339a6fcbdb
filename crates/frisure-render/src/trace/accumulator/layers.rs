//! Layers (AOVs): the first hits of each pixel, for compositors and denoisers.

use glam::Vec3;

use super::{Accumulator, Pixel};

/// Layers (AOVs): means over the primary hits of each pixel, row by row from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Albedo of much hair, or of skin: linear sRGB, premultiplied with coverage.
    pub albedo: Vec<[f32; 3]>,
    /// Normal in the frame of the head, premultiplied; not of unit length where several hairs meet.
    pub normal: Vec<[f32; 3]>,
    /// Tangent of hair, from root to tip, in the frame of the head, premultiplied; 0 for all else.
    pub tangent: Vec<[f32; 3]>,
    /// Distance along the view (m); [`Layers::NOWHERE`] where nothing is.
    pub depth: Vec<f32>,
    /// Coverage by hair alone: without brows and lashes, which are part of the head.
    pub hair: Vec<f32>,
    /// The wisp, or the strand where strands know no wisps, that covers most, counted from 1; 0 where
    /// there is no hair.
    pub wisp: Vec<u32>,
    /// Number of samples (paths).
    pub samples: Vec<u32>,
}

impl Layers {
    /// The depth where nothing is hit (m). Chosen.
    pub const NOWHERE: f32 = 1e10;

    fn new(count: usize) -> Self {
        Self {
            albedo: vec![[0.0; 3]; count],
            normal: vec![[0.0; 3]; count],
            tangent: vec![[0.0; 3]; count],
            depth: vec![Self::NOWHERE; count],
            hair: vec![0.0; count],
            wisp: vec![0; count],
            samples: vec![0; count],
        }
    }

    fn put(&mut self, i: usize, share: f32, pixel: &Pixel) {
        let mean = |sum: Vec3| (sum * share).to_array();
        self.albedo[i] = mean(pixel.albedo);
        self.normal[i] = mean(pixel.normal);
        self.tangent[i] = mean(pixel.tangent);
        if pixel.hits > 0.0 {
            self.depth[i] = pixel.depth / pixel.hits;
        }
        self.hair[i] = pixel.hair * share;
        self.wisp[i] = if pixel.hair > 0.0 { pixel.wisp } else { 0 };
        self.samples[i] = (1.0 / share).round() as u32;
    }
}

impl Accumulator {
    /// The layers (AOVs) of the picture so far.
    #[must_use]
    pub fn layers(&self) -> Layers {
        let mut layers = Layers::new(self.width * self.height);
        self.each(|(x, y), share, pixel| layers.put(y * self.width + x, share, pixel));
        layers
    }
}
