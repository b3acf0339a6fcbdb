//! The hairstyle of a scene before its first step.

use frisure::files::Files;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{
    Adoption, Hairstyle, HairstyleSpec, PredictError, PredictOptions, adopt, predict,
};
use frisure::progress::Progress;
use frisure::scene::{Scene, SceneError};
use frisure::strands::Strands;
use glam::DVec3;

use crate::error::Error;
use crate::inputs::scene_groom;

/// The hairstyle before the first step: predicted from `[hair]`, or adopted from the groom of the scene.
///
/// # Errors
/// [`Error`], at the key of the scene that has to change.
pub(crate) fn initial_hairstyle(
    scene: &Scene,
    spec: &HairstyleSpec,
    head: &Head,
    files: &Files,
    progress: &dyn Progress,
) -> Result<(Hairstyle, Option<Adoption>), Error> {
    let Some(groom) = scene_groom(scene, files)? else {
        let predicted = predict(spec, head, PredictOptions::default(), progress)
            .map_err(|e| Error::of_prediction(&e, scene))?;
        return Ok((predicted, None));
    };
    let most = scene.groom.as_ref().map_or(usize::MAX, |file| file.guides);
    let guides = if groom.guides.is_empty() { &groom.hairs } else { &groom.guides };
    let guides = evenly(guides, most);
    check_roots(scene, head, &guides)?;
    adopt(spec, head, &guides, &groom.hairs, progress)
        .map(|(hairstyle, adoption)| (hairstyle, Some(adoption)))
        .map_err(|e| match e {
            PredictError::Quantity(e) => scene.fault("groom.file", e.to_string(), "").into(),
            e => Error::of_prediction(&e, scene),
        })
}

/// Largest median distance (m) of roots from the skin; chosen.
const MOST_DISTANCE: f64 = 0.01;

/// Median distance (m) below which the groom is on this head and the right way up; chosen.
const SURE: f64 = 1e-3;

/// Part of the distance to which another axis or unit must bring the roots to be suggested; chosen.
const NEARER: f64 = 0.25;

/// Factors between the units that are tried for a suggestion.
const SIZES: [f64; 8] = [0.001, 0.01, 0.0254, 0.1, 10.0, 1.0 / 0.0254, 100.0, 1000.0];

/// An error if the groom is not on the head; it suggests another axis or unit where that fits.
fn check_roots(scene: &Scene, head: &Head, guides: &Strands) -> Result<(), SceneError> {
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
    if distance <= MOST_DISTANCE && other.is_none() {
        return Ok(());
    }
    let possible = if distance > MOST_DISTANCE { "; 1 cm is possible" } else { "" };
    let larger = || {
        let as_it_is: (&str, &dyn Fn(DVec3) -> DVec3) = ("", &|p| p);
        let near = |size: f64, turned: &dyn Fn(DVec3) -> DVec3| {
            median(&|p| turned(p * size)) < NEARER * MOST_DISTANCE
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

/// At most `most` of the strands, evenly chosen.
fn evenly(strands: &Strands, most: usize) -> Strands {
    let count = strands.len().min(most);
    let mut chosen = Strands::new();
    for k in 0..count {
        let strand = strands.strand(k * strands.len() / count);
        chosen.push(strand.points, strand.radii);
    }
    chosen
}
