//! What was seen first in each pixel: for compositors and denoisers.

use glam::Vec3;

use super::{Exposure, Pixel};

/// What was seen first in each pixel, row by row from the top left, means over what was met.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Share of the light that hair in quantity, or skin, gives back: linear sRGB, premultiplied with
    /// what is covered.
    pub albedo: Vec<[f32; 3]>,
    /// Normal in the frame of the head, premultiplied; not of unit length where several hairs meet.
    pub normal: Vec<[f32; 3]>,
    /// Tangent of hair, from root to tip, in the frame of the head, premultiplied; 0 for all else.
    pub tangent: Vec<[f32; 3]>,
    /// Distance along the view (m); [`Layers::NOWHERE`] where nothing is.
    pub depth: Vec<f32>,
    /// Coverage by hair alone.
    pub hair: Vec<f32>,
    /// The wisp, or the strand where strands know no wisps, that covers most, counted from 1; 0 where
    /// there is no hair.
    pub wisp: Vec<u32>,
    /// Paths of light.
    pub samples: Vec<u32>,
}

impl Layers {
    /// The depth of nothing (m).
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
        if pixel.met > 0.0 {
            self.depth[i] = pixel.depth / pixel.met;
        }
        self.hair[i] = pixel.hair * share;
        self.wisp[i] = if pixel.hair > 0.0 { pixel.wisp } else { 0 };
        self.samples[i] = (1.0 / share).round() as u32;
    }
}

impl Exposure {
    /// What was seen first in each pixel.
    #[must_use]
    pub fn layers(&self) -> Layers {
        let mut layers = Layers::new(self.width * self.height);
        self.each(|(x, y), share, pixel| layers.put(y * self.width + x, share, pixel));
        layers
    }
}
