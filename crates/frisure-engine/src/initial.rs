//! The hairstyle of a scene before its first step.

use frisure::files::Files;
use frisure::files::frame::UpAxis;
use frisure::formats::groom::Format;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{
    Adoption, Hairstyle, HairstyleSpec, PredictError, PredictOptions, adopt, predict, transfer,
};
use frisure::progress::Progress;
use frisure::scene::{GroomFile, Placement, Scene, SceneError};
use frisure::strands::{Strand, Strands};
use glam::DVec3;

use crate::error::Error;
use crate::heads::groom_head;
use crate::inputs::{GROOM_FRAME, read_groom, scene_groom};
use crate::placement::{guess, lines, placed, words};

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
    let Some(file) = &scene.groom else {
        let predicted = predict(spec, head, PredictOptions::default(), progress)
            .map_err(|e| Error::of_prediction(&e, scene))?;
        return Ok((predicted, None));
    };
    let wrong = |e| match e {
        PredictError::Quantity(e) => scene.error_at("groom.file", e.to_string(), "").into(),
        e => Error::of_prediction(&e, scene),
    };
    let made_on = file.head.as_ref();
    let made_on = made_on.map(|source| groom_head(scene, source, files)).transpose()?;
    let from = made_on.as_deref().unwrap_or(head);
    let groom = match scene_groom(scene, files) {
        Ok(groom) => groom.expect("the scene has one"),
        Err(error) => return Err(with_place(error, scene, file, from, files).into()),
    };
    let hairs = placed(&groom.hairs, &file.placement);
    let guides = match groom.guides.is_empty() {
        true => evenly(&hairs, file.guides),
        false => placed(&evenly(&groom.guides, file.guides), &file.placement),
    };
    check_roots(scene, from, &guides)?;
    let (adopted, adoption) = adopt(spec, from, &guides, &hairs, progress).map_err(wrong)?;
    let hairstyle = match &made_on {
        Some(from) => transfer(&adopted, from, head, progress).map_err(wrong)?,
        None => adopted,
    };
    Ok((hairstyle, Some(Adoption { times: groom.times, ..adoption })))
}

/// Largest median distance (m) of roots from the skin; chosen.
const MOST_DISTANCE: f64 = 0.01;

/// Median distance (m) below which the groom is on this head and the right way up; chosen.
const SURE: f64 = 1e-3;

/// Part of the distance to which another axis or unit must bring the roots to be suggested; chosen.
const NEARER: f64 = 0.25;

/// Factors between the units that are tried for a suggestion.
const SIZES: [f64; 8] = [0.001, 0.01, 0.0254, 0.1, 10.0, 1.0 / 0.0254, 100.0, 1000.0];

/// An axis that may point up in a groom, and where it takes a point.
type Turn = (&'static str, fn(DVec3) -> DVec3);

/// The groom as it is, and with another axis up.
const TURNS: [Turn; 3] =
    [("", |p| p), ("y", |p| DVec3::new(p.x, -p.z, p.y)), ("z", |p| DVec3::new(p.x, p.z, -p.y))];

/// Checks that the groom is on the head; the error suggests another axis or unit if that fits.
fn check_roots(scene: &Scene, head: &Head, guides: &Strands) -> Result<(), SceneError> {
    let roots: Vec<DVec3> = guides.iter().map(|strand| strand.points[0].as_dvec3()).collect();
    // Median distance (m) of turned and scaled roots from the skin.
    let median = |turn: fn(DVec3) -> DVec3, size: f64| {
        let turned: Vec<DVec3> = roots.iter().map(|root| turn(*root * size)).collect();
        median_height(head, &turned)
    };
    let distance = median(TURNS[0].1, 1.0);
    // An axis that the scene names already is how the groom was read, and naming it again changes nothing.
    let named = scene.groom.as_ref().and_then(|file| file.frame.up).map_or("", UpAxis::name);
    let turns = || TURNS.iter().filter(|(up, _)| up.is_empty() || *up != named);
    // A head is so round that turned roots may be near its skin again; far from it, any turn may come a good part nearer.
    let fits = |turn| {
        let turned = median(turn, 1.0);
        distance > SURE && turned < NEARER * distance && turned <= MOST_DISTANCE
    };
    let turned = turns().skip(1).find(|(_, turn)| fits(*turn));
    if distance <= MOST_DISTANCE && turned.is_none() {
        return Ok(());
    }
    let scaled = |(up, turn): &Turn| {
        let near = |size: &f64| median(*turn, *size) < NEARER * MOST_DISTANCE;
        let size = short(SIZES.into_iter().find(near)?);
        let up = if up.is_empty() { String::new() } else { format!(" and with {up} up") };
        Some(format!(", but {size} times as large{up} they fit"))
    };
    let suggestion = match turned {
        Some((up, _)) => format!(", but with {up} up they fit"),
        None => turns().find_map(scaled).unwrap_or_default(),
    };
    if suggestion.is_empty() && median_height(head, &last_points(guides)) < NEARER * distance {
        let problem = format!(
            "half of the groom's strands are rooted more than {:.1} cm from the skin of the head, and their last points lie nearer to it",
            1e2 * distance
        );
        let hint = "a strand begins at its root: reverse the strands in the program that made them";
        return Err(scene.error_at("groom.file", problem, hint));
    }
    let possible = if distance > MOST_DISTANCE { "; 1 cm is possible" } else { "" };
    let problem = format!(
        "half of the groom's strands are rooted more than {:.1} cm from the skin of the head{possible}{suggestion}",
        1e2 * distance
    );
    // An axis or a unit alone is the simpler mistake; a placement that the scene has already is not placed once more.
    let placed = scene.groom.as_ref().is_some_and(|file| file.placement != Placement::default());
    if suggestion.is_empty()
        && !placed
        && let Some(placement) = guess(head, &roots)
    {
        let hint = place_hint(scene.groom.as_ref(), &placement);
        return Err(scene.error_at("groom.file", problem, hint));
    }
    let hint = format!("{GROOM_FRAME}, or name the head that the groom was made on");
    Err(scene.error_at("groom.file", problem, hint))
}

fn last_points(strands: &Strands) -> Vec<DVec3> {
    strands.iter().map(|strand| strand.points[strand.points.len() - 1].as_dvec3()).collect()
}

/// The median distance (m) of points from the skin.
fn median_height(head: &Head, points: &[DVec3]) -> f64 {
    let mut heights: Vec<f64> =
        points.iter().map(|p| head.signed_distance().value(*p).abs()).collect();
    let half = heights.len() / 2;
    *heights.select_nth_unstable_by(half, f64::total_cmp).1
}

/// What a guess takes the groom for, and the lines that place it.
fn place_hint(file: Option<&GroomFile>, placement: &Placement) -> String {
    let metres = file.and_then(|file| {
        let format = Format::of(&file.path).ok().filter(|format| !format.states_unit());
        file.frame.metres.or(format.map(|format| format.frame().metres))
    });
    format!(
        "{}; it would lie on the head with these lines in `[groom]` of a scene:\n{}",
        words(placement, metres),
        lines(placement)
    )
}

/// Factors with which a groom is read again whose size no hair has. Chosen: steps of less than the ratio of the largest
/// size of hair to its smallest, so that one of them makes a head of hair of it.
const READ_AGAIN: [f64; 6] = [1e-2, 1e2, 1e-4, 1e4, 1e-6, 1e6];

/// The error of a groom that cannot be read; where another scale mends it, with the place on the head that it then has.
fn with_place(
    error: SceneError,
    scene: &Scene,
    file: &GroomFile,
    head: &Head,
    files: &Files,
) -> SceneError {
    let is_of_size = || read_groom(file, 1.0, files).is_err_and(|e| e.may_be_of_unit());
    if file.placement != Placement::default() || !is_of_size() {
        return error;
    }
    let again = |&factor: &f64| Some((read_groom(file, factor, files).ok()?, factor));
    let place = READ_AGAIN.iter().filter_map(again).find_map(|(groom, factor)| {
        let of = if groom.guides.is_empty() { &groom.hairs } else { &groom.guides };
        let root = |strand: Strand<'_>| strand.points[0].as_dvec3() / factor;
        let roots: Vec<DVec3> = evenly(of, file.guides).iter().map(root).collect();
        guess(head, &roots)
    });
    match (place, error.diagnostic()) {
        (Some(place), Some(found)) => {
            scene.error_at("groom.file", found.message(), place_hint(Some(file), &place))
        }
        _ => error,
    }
}

/// A number with at most four decimals, or as a fraction.
fn short(x: f64) -> String {
    if x < 1.0 {
        format!("1/{:.3}", 1.0 / x).trim_end_matches('0').trim_end_matches('.').into()
    } else {
        format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').into()
    }
}

/// At most `most` of the strands, at equal intervals.
fn evenly(strands: &Strands, most: usize) -> Strands {
    let count = strands.len().min(most);
    let mut chosen = Strands::new();
    for k in 0..count {
        let strand = strands.strand(k * strands.len() / count);
        chosen.push(strand.points, strand.radii);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of roots (m, as read) on a head, where the scene has these lines in `[groom]`.
    fn told(head: &Head, roots: &[DVec3], lines: &str) -> Option<(String, String)> {
        let text = format!("[groom]\nfile = \"a.hair\"\n{lines}\n");
        let scene = Scene::parse("a", text, "".as_ref()).unwrap();
        let mut guides = Strands::new();
        for root in roots {
            let points = [root.as_vec3(), root.as_vec3() + glam::Vec3::Z];
            guides.push(&points, &[1e-5; 2]);
        }
        let error = check_roots(&scene, head, &guides).err()?;
        let found = error.diagnostic().unwrap();
        Some((found.message(), found.hint.clone()))
    }

    fn scalp(head: &Head) -> Vec<DVec3> {
        let all = head.surface().positions().iter().zip(head.scalp());
        all.filter(|(_, weight)| **weight > 0.5).map(|(p, _)| *p).collect()
    }

    #[test]
    fn an_axis_that_the_scene_names_is_not_suggested_again() {
        let head = Head::mannequin();
        // A person of 1.7 m in inches, y up, read as centimetres, z up.
        let read = |p: &DVec3| {
            let p = *p + 1.52 * DVec3::Z;
            0.01 / 0.0254 * DVec3::new(p.x, p.z, -p.y)
        };
        let roots: Vec<DVec3> = scalp(&head).iter().map(read).collect();
        for lines in ["up = \"z\"", "up = \"z\"\nunit = \"cm\"", ""] {
            let (problem, hint) = told(&head, &roots, lines).unwrap();
            assert!(!problem.contains("they fit"), "{lines}: {problem}");
            assert!(hint.contains("scale = 2.54\nturn = [90, 0, 0]"), "{lines}: {hint}");
        }
    }

    #[test]
    fn the_other_axis_is_suggested_where_it_brings_roots_onto_the_skin() {
        let head = Head::mannequin();
        let roots: Vec<DVec3> = scalp(&head).iter().map(|p| DVec3::new(p.x, p.z, -p.y)).collect();
        for lines in ["", "up = \"z\""] {
            let (problem, _) = told(&head, &roots, lines).unwrap();
            assert!(problem.ends_with("but with y up they fit"), "{problem}");
        }
        assert_eq!(told(&head, &scalp(&head), "up = \"z\""), None);
    }
}
