//! Removal of noise from traced pictures.

use frisure::denoise::{Denoiser, Noisy};
use frisure::render::Image;
use frisure::render::trace::Layers;

use crate::error::Error;

/// Removes a fraction of the noise, by Open Image Denoise.
#[derive(Clone, Copy, Debug)]
pub struct NoiseFilter {
    /// The library.
    pub denoiser: Denoiser,
    /// The fraction (0 to 1).
    pub fraction: f32,
}

impl NoiseFilter {
    /// The picture with less noise; coverage stays.
    pub(super) fn apply(&self, image: &Image, layers: &Layers) -> Result<Image, Error> {
        let light: Vec<[f32; 3]> = image.pixels().iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
        // A hair's normal turns across its width; its tangent is what it shares with its neighbours.
        let directions = layers.hair.iter().zip(layers.tangent.iter().zip(&layers.normal));
        let direction: Vec<[f32; 3]> =
            directions.map(|(hair, (t, n))| if *hair > 0.5 { *t } else { *n }).collect();
        let (width, height) = (image.width(), image.height());
        let noisy =
            Noisy { width, height, light: &light, albedo: &layers.albedo, direction: &direction };
        let clean = self.denoiser.denoise(&noisy).map_err(|e| Error::failed(&e, ""))?;
        let mut image = image.clone();
        for (pixel, light) in image.pixels_mut().iter_mut().zip(clean) {
            for (noisy, clean) in pixel.iter_mut().zip(light) {
                *noisy += self.fraction * (clean - *noisy);
            }
        }
        Ok(image)
    }
}
