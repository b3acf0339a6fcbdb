//! Removal of noise from traced pictures.

use frisure::denoise::{Denoiser, Noisy};
use frisure::render::Image;
use frisure::render::trace::Layers;

use crate::error::Error;

/// Removes a fraction of the noise of hair, and twice that of all else, by Open Image Denoise.
#[derive(Clone, Copy, Debug)]
pub struct NoiseFilter {
    /// The library.
    pub denoiser: Denoiser,
    /// The fraction (0 to 1).
    pub fraction: f32,
}

/// Coverage by hair from which a pixel keeps as much of its noise as hair does: a single fine hair covers about this much of a
/// pixel of 1 mm. Chosen.
const SINGLE_HAIR: f32 = 0.1;

impl NoiseFilter {
    /// The picture with less noise; coverage stays.
    pub(super) fn apply(&self, image: &Image, layers: &Layers) -> Result<Image, Error> {
        let light: Vec<[f32; 3]> = image.pixels().iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
        // A hair's normal turns across its width; its tangent is what it shares with its neighbours.
        let directions = layers.hair.iter().zip(layers.tangent.iter().zip(&layers.normal));
        let direction: Vec<[f32; 3]> =
            directions.map(|(hair, (t, n))| if *hair > 0.5 { *t } else { *n }).collect();
        // Hair reflects little and its strands differ by little of that: to the filter, which knows albedos of usual surfaces, they
        // look alike. The root is the scale on which they look different to a person.
        let albedo: Vec<[f32; 3]> =
            layers.albedo.iter().map(|rgb| rgb.map(|x| x.max(0.0).sqrt())).collect();
        let (width, height) = (image.width(), image.height());
        let noisy = Noisy { width, height, light: &light, albedo: &albedo, direction: &direction };
        let clean = self.denoiser.denoise(&noisy).map_err(|e| Error::failed(&e, ""))?;
        let mut image = image.clone();
        for ((pixel, light), hair) in image.pixels_mut().iter_mut().zip(clean).zip(&layers.hair) {
            let fraction = self.fraction_at(*hair);
            for (noisy, clean) in pixel.iter_mut().zip(light) {
                *noisy += fraction * (clean - *noisy);
            }
        }
        Ok(image)
    }

    /// The fraction of a pixel's noise to remove. Noise of hair hides how the denoiser blurs strands; skin, cloth and
    /// background have nothing as fine.
    fn fraction_at(&self, hair: f32) -> f32 {
        let elsewhere = (2.0 * self.fraction).min(1.0);
        elsewhere + (self.fraction - elsewhere) * (hair / SINGLE_HAIR).min(1.0)
    }
}
