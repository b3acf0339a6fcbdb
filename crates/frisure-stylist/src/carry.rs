//! The parts of carrying a scene out: its head, and what is refused on the way, at the key it comes from.

use frisure::hairstyle::head::{Head, ScalpSource};
use frisure::hairstyle::styling::StyleError;
use frisure::hairstyle::{HistoryError, PredictError};
use frisure::io::files::Files;
use frisure::io::scene::{Scene, SceneError};

/// The head of a scene.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub fn head(scene: &Scene, files: &Files) -> Result<Head, SceneError> {
    let Some(mesh) = scene.head_mesh_in(files)? else { return Ok(Head::mannequin()) };
    let scalp = mesh.scalp.map_or(ScalpSource::Guess, ScalpSource::Weights);
    Head::from_surface(mesh.surface, scalp).map_err(|e| scene.fault("head.mesh", e.to_string(), ""))
}

/// Why there is no hairstyle, at the key that has to change; none if it was cancelled.
#[must_use]
pub fn not_predicted(error: &PredictError, scene: &Scene) -> Option<SceneError> {
    Some(match error {
        PredictError::Cancelled(_) => return None,
        PredictError::Quantity(error) => scene.blame(error),
        PredictError::Parting(e) => {
            let key = format!("implantation.partings[{}].line[{}]", e.index, e.place);
            scene.fault(&key, e.to_string(), "")
        }
        PredictError::Crowded(e) => scene.fault("wisps.count", e.to_string(), ""),
        PredictError::Spec(error) => scene.out_of_range(error),
    })
}

/// Why a step cannot be done, at the key that has to change; none if it was cancelled.
#[must_use]
pub fn not_done(step: usize, error: &StyleError, scene: &Scene) -> Option<SceneError> {
    match error {
        StyleError::Cancelled(_) | StyleError::Predict(PredictError::Cancelled(_)) => None,
        error => Some(scene.step_fault(step, error)),
    }
}

/// The same of a list of steps.
#[must_use]
pub fn not_followed(error: &HistoryError, scene: &Scene) -> Option<SceneError> {
    not_done(error.step, &error.error, scene)
}
