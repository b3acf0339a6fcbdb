//! Camera, light, look and size of the picture of a scene.

use frisure::look::EnvironmentMap;
use frisure::render::{Image, PictureSpec};
use frisure::scene::{Output, Scene};

/// Camera, light and look of a scene, with the scene's environment map ([`crate::environment_map`]).
#[must_use]
pub fn spec<'a>(scene: &'a Scene, environment: Option<&'a EnvironmentMap>) -> PictureSpec<'a> {
    let Scene { camera, light, look, .. } = scene;
    PictureSpec { camera, light, look, environment }
}

/// Width over height of the scene's picture.
#[must_use]
pub fn aspect(scene: &Scene) -> f64 {
    scene.output.width as f64 / scene.output.height as f64
}

/// Bytes for a PNG, four per pixel (red, green, blue, alpha; sRGB), rows from the top, with the scene's tone curve and
/// exposure.
#[must_use]
pub fn developed(image: &Image, output: &Output) -> Vec<u8> {
    image.to_srgb8_with(output.tone, output.exposure as f32)
}
