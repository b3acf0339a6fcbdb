//! `frisure render`: the final picture of a scene.

use super::{predict, read_scene};
use crate::args::{Predict, Quality, Render};
use crate::failure::{Done, Failure};

/// Predicts the scene and follows the light in it.
pub(crate) fn run(arguments: Render, quiet: bool) -> Result<Done, Failure> {
    let Render { scene: path, output, paths, size, camera } = arguments;
    let mut scene = read_scene(&path)?;
    if let Some((width, height)) = size {
        (scene.output.width, scene.output.height) = (width, height);
    }
    if let Some(camera) = camera {
        scene.camera.azimuth = camera.azimuth();
    }
    let (outputs, image, quality) = (Vec::new(), Some(output), Quality::Final);
    let arguments =
        Predict { scene: path, outputs, image, report: None, quality, paths, each_step: false };
    predict::run_scene(arguments, scene, quiet)
}
