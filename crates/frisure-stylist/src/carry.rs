//! The parts of carrying a scene out: its head, and what is refused on the way, at the key it comes from.

use frisure::hairstyle::head::{Head, ScalpSource};
use frisure::hairstyle::styling::StyleError;
use frisure::hairstyle::{
    Adoption, Hairstyle, HairstyleSpec, HistoryError, Monitor, PredictError, adopt, predict,
};
use frisure::io::files::Files;
use frisure::io::scene::{Scene, SceneError};
use frisure::strands::Strands;

/// The head of a scene.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub fn head(scene: &Scene, files: &Files) -> Result<Head, SceneError> {
    let Some(mesh) = scene.head_mesh_in(files)? else { return Ok(Head::mannequin()) };
    let scalp = mesh.scalp.map_or(ScalpSource::Guess, ScalpSource::Weights);
    Head::from_surface(mesh.surface, scalp).map_err(|e| scene.fault("head.mesh", e.to_string(), ""))
}

/// What the hair of a scene begins with: what its `[hair]` predicts, or the groom that it names, and how well that
/// was held.
///
/// # Errors
/// [`SceneError`] at the key that has to change; none if the monitor said to stop.
pub fn beginning(
    scene: &Scene,
    spec: &HairstyleSpec,
    head: &Head,
    files: &Files,
    monitor: &dyn Monitor,
) -> Result<(Hairstyle, Option<Adoption>), Option<SceneError>> {
    let Some(groom) = scene.groom_in(files)? else {
        let predicted = predict(spec, head, monitor).map_err(|e| not_predicted(&e, scene))?;
        return Ok((predicted, None));
    };
    let most = scene.groom.as_ref().map_or(usize::MAX, |file| file.guides);
    let told = !groom.guides.is_empty();
    let guides = evenly(if told { &groom.guides } else { &groom.hairs }, most);
    check_rooted(scene, head, &guides)?;
    adopt(spec, head, &guides, &groom.hairs, monitor)
        .map(|(hairstyle, adoption)| (hairstyle, Some(adoption)))
        .map_err(|e| match e {
            PredictError::Quantity(e) => Some(scene.fault("groom.file", e.to_string(), "")),
            e => not_predicted(&e, scene),
        })
}

/// Distance (m) from the skin at which most strands of a groom are rooted at most.
const ROOTED: f64 = 0.01;

/// Refuses a groom that is not on the head.
fn check_rooted(scene: &Scene, head: &Head, guides: &Strands) -> Result<(), SceneError> {
    let distance = |strand: frisure::strands::Strand<'_>| {
        head.signed_distance().value(strand.points[0].as_dvec3()).abs()
    };
    let mut distances: Vec<f64> = guides.iter().map(distance).collect();
    let half = distances.len() / 2;
    let median = *distances.select_nth_unstable_by(half, f64::total_cmp).1;
    if median <= ROOTED {
        return Ok(());
    }
    let message = format!(
        "half of the groom's strands are rooted more than {:.1} cm from the skin of the head; {:.0} cm are possible",
        1e2 * median,
        1e2 * ROOTED
    );
    let hint = "`unit` and `up` of `[groom]` say what it is in; `mesh` of `[head]` is the head that it was made on";
    Err(scene.fault("groom.file", message, hint))
}

/// At most so many of some strands, evenly chosen.
fn evenly(strands: &Strands, most: usize) -> Strands {
    let count = strands.len().min(most);
    let mut chosen = Strands::new();
    for k in 0..count {
        let strand = strands.strand(k * strands.len() / count);
        chosen.push(strand.points, strand.radii);
    }
    chosen
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
