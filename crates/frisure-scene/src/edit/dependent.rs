//! Keys that an edit of another key removes or adds.

use crate::declaration::without_index;
use crate::exclusive::others;
use crate::key_groups::{ENVIRONMENT, GROOM, HEAD, MAIN_LAMP, POSE, SUN};
use crate::kind::{Acceleration, ToText, Vector};
use crate::quantity::LENGTH;
use crate::scene::Scene;

/// The keys to remove when a key is set, or removed if `word` is none. `word` is its value without
/// quotes; `now` returns the values of keys before the edit, in the same way.
pub(super) fn dependents(
    key: &str,
    word: Option<&str>,
    now: impl Fn(&str) -> Option<String>,
) -> Vec<String> {
    let (general, index) = without_index(key);
    let exclusive = word.into_iter().flat_map(|_| others(&general));
    let dependent = dependent_on_value(&general, word, &now);
    exclusive.chain(dependent).map(|other| other.replace("[]", &index)).collect()
}

/// The keys that have no effect with a value of another key.
fn dependent_on_value(
    key: &str,
    word: Option<&str>,
    now: &impl Fn(&str) -> Option<String>,
) -> Vec<&'static str> {
    let parted = || now("implantation.flow").is_none_or(|flow| flow == "parted");
    let setup = || now("light.setup");
    match (key, word) {
        ("implantation.parting", Some(_)) if !parted() => vec!["implantation.flow"],
        ("implantation.flow", Some(flow)) if flow != "parted" => vec!["implantation.parting"],
        // A name sets all of a colour.
        ("look.colour", Some(_)) => vec!["look.eumelanin", "look.pheomelanin", "look.white_share"],
        ("look.dye.colour", None) => vec!["look.dye.strength", "look.dye.regrowth"],
        ("camera.f_number", None) => vec!["camera.focus"],
        // The direction of gravity is said once.
        ("gravity", Some(value)) if value.starts_with('[') => POSE.to_vec(),
        ("head.mesh", None) => HEAD[1..].to_vec(),
        ("groom.file", None) => GROOM[1..].to_vec(),
        ("equilibrium.branch", None | Some("gravity")) => vec!["equilibrium.starts"],
        ("light.environment", None) => ENVIRONMENT[1..].to_vec(),
        ("light.environment", Some(_)) => {
            let sky = setup().is_some_and(|s| s == "daylight" || s == "overcast");
            let mut gone = SUN.to_vec();
            gone.extend(sky.then_some("light.setup"));
            // Without a setup there is no lamp.
            gone.extend(if sky || setup().is_none() { &MAIN_LAMP[..] } else { &[] });
            gone
        }
        ("light.setup", Some(setup)) => without_lamps(setup),
        ("light.setup", None) => {
            [&SUN[..], if now(ENVIRONMENT[0]).is_some() { &MAIN_LAMP } else { &[] }].concat()
        }
        (key, Some(_)) if SUN.contains(&key) => {
            let other = setup().is_some_and(|setup| setup != "daylight");
            let setup = other.then_some("light.setup");
            [&MAIN_LAMP[..2], &ENVIRONMENT].concat().into_iter().chain(setup).collect()
        }
        ("light.lamp[].angle", Some(_)) => {
            vec!["light.lamp[].shown", "light.lamp[].distance", "light.lamp[].position"]
        }
        ("light.lamp[].distance" | "light.lamp[].position", Some(_)) => {
            vec!["light.lamp[].angle"]
        }
        ("light.lamp[].size", None) => vec!["light.lamp[].shown"],
        _ => Vec::new(),
    }
}

/// The keys about lamps, sun and environment that a setup does not have.
fn without_lamps(setup: &str) -> Vec<&'static str> {
    match setup {
        "daylight" => [&MAIN_LAMP[..2], &ENVIRONMENT].concat(),
        "overcast" => [&SUN[..], &MAIN_LAMP, &ENVIRONMENT].concat(),
        "dark" => [&SUN[..], &MAIN_LAMP].concat(),
        _ => SUN.to_vec(),
    }
}

/// A key to add beside one that replaces others, so that nothing else changes: the pitch beside a radius
/// that replaces strains, the shape of a section beside its size, the direction of gravity beside its number. `word` and `now` as in
/// [`dependents`].
pub(super) fn supplement(
    key: &str,
    word: &str,
    scene: &Scene,
    gone: &[String],
    now: impl Fn(&str) -> Option<String>,
) -> Option<(&'static str, String)> {
    let is_vector = |value: &str| value.starts_with('[');
    if (key == "gravity" && !is_vector(word) || POSE.contains(&key))
        && now("gravity").as_deref().is_some_and(is_vector)
    {
        let (pose, gravity) = (scene.spec.pose.down(), scene.spec.gravity);
        return Some(match key {
            "gravity" => ("pose.down", Vector::text(&pose)),
            _ => ("gravity", Acceleration::text(&gravity)),
        });
    }
    let was = |key: &str| gone.iter().any(|gone| gone == key);
    let strains = ["hair.curl.kappa1", "hair.curl.kappa2", "hair.curl.tau"].into_iter().any(was);
    let axes = was("hair.fibre.semi_axis_a") || was("hair.fibre.semi_axis_b");
    let section = scene.spec.fibre.section;
    let length = |length: f64| Some(format!("\"{}\"", LENGTH.written(length)));
    let helix = || scene.spec.curl.radius_pitch();
    match key {
        "hair.curl.radius" if strains => {
            Some("hair.curl.pitch").zip(helix().and_then(|(_, pitch)| length(pitch)))
        }
        "hair.curl.pitch" if strains => {
            Some("hair.curl.radius").zip(helix().and_then(|(radius, _)| length(radius)))
        }
        "hair.fibre.diameter" | "hair.fibre.mean_radius" if axes => {
            Some(("hair.fibre.axis_ratio", format!("{:.4}", section.axis_ratio())))
        }
        "hair.fibre.axis_ratio" | "hair.fibre.eccentricity" if axes => {
            Some("hair.fibre.diameter").zip(length(2.0 * section.mean_radius()))
        }
        _ => None,
    }
}
