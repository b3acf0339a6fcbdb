//! The parts of carrying a scene out: its head, and what is refused on the way, at the key it comes from.

use frisure::files::Files;
use frisure::hairstyle::head::{Head, ScalpSource};
use frisure::hairstyle::styling::StyleError;
use frisure::hairstyle::{
    Adoption, Hairstyle, HairstyleSpec, HistoryError, Monitor, PredictError, PredictOptions, adopt,
    predict,
};
use frisure::scene::{Scene, SceneError};
use frisure::strands::Strands;
use glam::DVec3;

/// The head of a scene, and what had to be guessed of it, for people.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub fn head(scene: &Scene, files: &Files) -> Result<(Head, Option<String>), SceneError> {
    let Some(mesh) = scene.head_mesh_in(files)? else { return Ok((Head::mannequin(), None)) };
    let note = scene.head_note(&mesh);
    let scalp = mesh.scalp.map_or(ScalpSource::Guess, ScalpSource::Weights);
    let head = Head::from_surface(mesh.surface, scalp);
    head.map(|head| (head, note)).map_err(|e| scene.fault("head.mesh", e.to_string(), ""))
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
        let predicted = predict(spec, head, PredictOptions::default(), monitor)
            .map_err(|e| not_predicted(&e, scene))?;
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

/// Distance (m) at which they are on this head and no other way up.
const SURE: f64 = 1e-3;

/// Part of a distance that is so much less that the other way up is meant.
const NEARER: f64 = 0.25;

/// Units that a groom of another unit may have been meant in, as lengths of this one.
const SIZES: [f64; 8] = [0.001, 0.01, 0.0254, 0.1, 10.0, 1.0 / 0.0254, 100.0, 1000.0];

/// Refuses a groom that is not on the head.
fn check_rooted(scene: &Scene, head: &Head, guides: &Strands) -> Result<(), SceneError> {
    let roots: Vec<DVec3> = guides.iter().map(|strand| strand.points[0].as_dvec3()).collect();
    let median = |turned: &dyn Fn(DVec3) -> DVec3| {
        let distance = |root: &DVec3| head.signed_distance().value(turned(*root)).abs();
        let mut distances: Vec<f64> = roots.iter().map(distance).collect();
        let half = distances.len() / 2;
        *distances.select_nth_unstable_by(half, f64::total_cmp).1
    };
    let distance = median(&|root| root);
    // A head is so round that roots which were turned over may come to lie near its skin again.
    let up_y = |p: DVec3| DVec3::new(p.x, -p.z, p.y);
    let up_z = |p: DVec3| DVec3::new(p.x, p.z, -p.y);
    let ways: [(&str, &dyn Fn(DVec3) -> DVec3); 2] = [("y", &up_y), ("z", &up_z)];
    let fits = |turned| median(turned) < NEARER * distance;
    let other = ways.iter().find(|(_, turned)| distance > SURE && fits(*turned));
    if distance <= ROOTED && other.is_none() {
        return Ok(());
    }
    let possible = if distance > ROOTED { "; 1 cm is possible" } else { "" };
    let larger = || {
        let as_it_is: (&str, &dyn Fn(DVec3) -> DVec3) = ("", &|p| p);
        let near = |size: f64, turned: &dyn Fn(DVec3) -> DVec3| {
            median(&|p| turned(p * size)) < NEARER * ROOTED
        };
        let sized = |(up, turned): &(&'static str, &dyn Fn(DVec3) -> DVec3)| {
            let size = SIZES.into_iter().find(|size| near(*size, turned))?;
            let up = if up.is_empty() { String::new() } else { format!(" and with {up} up") };
            Some(format!(", but {} times as large{up} they fit", short(size)))
        };
        [as_it_is, ways[0], ways[1]].iter().find_map(sized)
    };
    let other = match other {
        Some((up, _)) => format!(", but with {up} up they fit"),
        None => larger().unwrap_or_default(),
    };
    let message = format!(
        "half of the groom's strands are rooted more than {:.1} cm from the skin of the head{possible}{other}",
        1e2 * distance
    );
    let hint = "`unit` and `up` of `[groom]` say what it is in, those of `[head]` what the head is in; `mesh` is the head that \
                it was made on";
    Err(scene.fault("groom.file", message, hint))
}

/// A number of at most three digits.
fn short(x: f64) -> String {
    if x < 1.0 {
        format!("1/{:.3}", 1.0 / x).trim_end_matches('0').trim_end_matches('.').into()
    } else {
        format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').into()
    }
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
        StyleError::Cancelled(_) => None,
        error => Some(scene.step_fault(step, error)),
    }
}

/// The same of a list of steps.
#[must_use]
pub fn not_followed(error: &HistoryError, scene: &Scene) -> Option<SceneError> {
    not_done(error.step, &error.error, scene)
}
