//! Keys that say the same thing in different ways: who sets one takes the others away.

use crate::Scene;
use crate::quantity::LENGTH;

/// Ways to say one thing, each of some keys.
type Ways = &'static [&'static [&'static str]];

/// `[]` stands for the number of an item in a list.
const WAYS: [Ways; 15] = [
    &[
        &["hair.fibre.diameter"],
        &["hair.fibre.mean_radius"],
        &["hair.fibre.semi_axis_a", "hair.fibre.semi_axis_b"],
    ],
    &[
        &["hair.fibre.eccentricity"],
        &["hair.fibre.axis_ratio"],
        &["hair.fibre.semi_axis_a", "hair.fibre.semi_axis_b"],
        &["hair.ellipticity"],
    ],
    &[&["hair.fibre.shear_modulus"], &["hair.fibre.poisson_ratio"]],
    &[
        &["hair.curl.radius", "hair.curl.pitch"],
        &["hair.curl.kappa1", "hair.curl.kappa2", "hair.curl.tau"],
        &["hair.curl.along"],
    ],
    &[&["wisps.density"], &["wisps.hairs"], &["wisps.hairs_per_wisp"]],
    &[&["implantation.parting"], &["implantation.partings"]],
    &[&["implantation.partings[].at"], &["implantation.partings[].line"]],
    &[&["implantation.lift"], &["implantation.lift_scale"]],
    &[&["head.scalp_group"], &["head.scalp_colour"], &["head.scalp_mask"], &["head.scalp_weights"]],
    &[&["head.unit"], &["head.scale"]],
    &[&["region[].length"], &["region[].down_to"]],
    &[&["equilibrium.elements"], &["equilibrium.accuracy"]],
    &[
        &["look.colour", "look.eumelanin", "look.pheomelanin"],
        &["look.reflectance"],
        &["look.absorption"],
    ],
    &[&["light.lamp[].colour"], &["light.lamp[].temperature"]],
    &[
        &["light.lamp[].azimuth", "light.lamp[].elevation", "light.lamp[].distance"],
        &["light.lamp[].position"],
    ],
];

const SUN: [&str; 3] = ["light.sun_azimuth", "light.sun_elevation", "light.turbidity"];
const MAIN_LAMP: [&str; 3] = ["light.azimuth", "light.elevation", "light.size"];
const ENVIRONMENT: [&str; 2] = ["light.environment", "light.rotation"];

/// The keys that have to go where one is given another value, or is taken away. `word` is the value
/// without its quotes; `now` gives the values of keys so far, in the same way.
pub(super) fn rivals(
    key: &str,
    word: Option<&str>,
    now: impl Fn(&str) -> Option<String>,
) -> Vec<String> {
    let (general, index) = without_index(key);
    let mut rivals: Vec<&'static str> = Vec::new();
    if word.is_some() {
        for ways in WAYS {
            let own = |way: &&&[&str]| way.contains(&general.as_str());
            if ways.iter().any(|way| own(&way)) {
                rivals.extend(ways.iter().filter(|way| !own(way)).copied().flatten());
            }
        }
    }
    rivals.extend(said_by(&general, word, &now));
    rivals.into_iter().map(|rival| rival.replace("[]", &index)).collect()
}

/// A path with empty brackets for the number in it, and that number in brackets.
fn without_index(key: &str) -> (String, String) {
    let brackets = key.find('[').zip(key.find(']')).filter(|(start, end)| start < end);
    match brackets {
        Some((start, end)) => {
            (format!("{}[]{}", &key[..start], &key[end + 1..]), key[start..=end].to_owned())
        }
        None => (key.to_owned(), String::new()),
    }
}

/// What goes for what the value itself says.
fn said_by(
    key: &str,
    word: Option<&str>,
    now: &impl Fn(&str) -> Option<String>,
) -> Vec<&'static str> {
    let parted = || now("implantation.flow").is_none_or(|flow| flow == "parted");
    let setup = || now("light.setup");
    match (key, word) {
        ("implantation.parting", Some(_)) if !parted() => vec!["implantation.flow"],
        ("implantation.flow", Some(flow)) if flow != "parted" => vec!["implantation.parting"],
        // A name stands for all of a colour.
        ("look.colour", Some(_)) => vec!["look.eumelanin", "look.pheomelanin", "look.white_share"],
        ("look.dye.colour", None) => vec!["look.dye.strength", "look.dye.regrowth"],
        ("camera.f_number", None) => vec!["camera.focus"],
        ("head.mesh", None) => vec![
            "head.up",
            "head.unit",
            "head.scale",
            "head.scalp_group",
            "head.scalp_colour",
            "head.scalp_mask",
            "head.scalp_weights",
        ],
        ("groom.file", None) => vec!["groom.up", "groom.unit", "groom.guides"],
        ("equilibrium.branch", None | Some("gravity")) => vec!["equilibrium.starts"],
        ("light.environment", None) => vec!["light.rotation"],
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
        ("light.lamp[].angle", Some(_)) => vec![
            "light.lamp[].size",
            "light.lamp[].shown",
            "light.lamp[].distance",
            "light.lamp[].position",
        ],
        ("light.lamp[].size" | "light.lamp[].distance" | "light.lamp[].position", Some(_)) => {
            vec!["light.lamp[].angle"]
        }
        ("light.lamp[].size", None) => vec!["light.lamp[].shown"],
        _ => Vec::new(),
    }
}

/// The keys of lamps, sun and surroundings that a setup does not have.
fn without_lamps(setup: &str) -> Vec<&'static str> {
    match setup {
        "daylight" => [&MAIN_LAMP[..2], &ENVIRONMENT].concat(),
        "overcast" => [&SUN[..], &MAIN_LAMP, &ENVIRONMENT].concat(),
        "dark" => [&SUN[..], &MAIN_LAMP].concat(),
        _ => SUN.to_vec(),
    }
}

/// What is to be said beside a key so that only what it says changes, where the other way to say it said
/// more: the pitch beside a radius that takes the place of strains, the shape of a section beside its
/// size.
pub(super) fn beside(key: &str, scene: &Scene, gone: &[String]) -> Option<(&'static str, String)> {
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
