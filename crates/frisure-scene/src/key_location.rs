//! Errors about quantities and descriptions, at the keys that these come from.

use std::ops::Range;

use frisure_hairstyle::InvalidSpec;
use frisure_rod::InvalidQuantity;

use crate::error::{Diagnostic, SceneError};
use crate::source::Source;

/// The keys that a quantity of the rod comes from, the likeliest first.
fn keys_of(quantity: &str) -> &'static [&'static str] {
    match quantity {
        "length" => &["hair.length"],
        "gravity" => &["gravity"],
        "radius" | "mean radius" | "mean diameter" => {
            &["hair.fibre.diameter", "hair.fibre.mean_radius"]
        }
        "semi-axis a" => &["hair.fibre.semi_axis_a"],
        "semi-axis b" => &["hair.fibre.semi_axis_b"],
        "eccentricity" => &["hair.fibre.eccentricity"],
        "axis ratio" => {
            &["hair.fibre.axis_ratio", "hair.fibre.semi_axis_a", "hair.fibre.semi_axis_b"]
        }
        "Young's modulus" => &["hair.fibre.youngs_modulus"],
        "shear modulus" => &["hair.fibre.shear_modulus"],
        "Poisson's ratio" => &["hair.fibre.poisson_ratio"],
        "density" => &["hair.fibre.density"],
        "curl radius" => &["hair.curl.radius"],
        "curl pitch" => &["hair.curl.pitch"],
        "number of elements" => &["equilibrium.elements"],
        "accuracy" => &["equilibrium.accuracy"],
        q if q.contains("natural strain") => &["hair.curl.along", "hair.curl"],
        q if q.contains("root") => &["hair.root"],
        q if q.contains("stiffness") || q.contains("weight") => &["hair.fibre"],
        _ => &["hair"],
    }
}

/// The first of some keys that is written, its span, and whether it is a single value; or the nearest table around the first of them.
pub(crate) fn locate_any(
    keys: &[&'static str],
    source: &Source,
) -> (&'static str, Range<usize>, bool) {
    let written = |&key: &&'static str| source.find(key).map(|(span, single)| (key, span, single));
    let first = keys.first().copied().unwrap_or("");
    keys.iter().find_map(written).unwrap_or_else(|| (first, source.locate(first), false))
}

/// The error about a quantity that the rod refuses, at the key it comes from.
pub(crate) fn quantity_error(error: &InvalidQuantity, source: &Source) -> SceneError {
    let (key, span, single) = locate_any(keys_of(error.quantity), source);
    let diagnostic = if single {
        Diagnostic::outside(error.allowed).value(source.slice(span.clone()))
    } else {
        // No single key is wrong: the sentence must name the quantity itself.
        Diagnostic { allowed: error.allowed.into(), ..Diagnostic::new(error.to_string()) }
            .value(format!("{} {}", error.value, error.unit).trim())
    };
    diagnostic.key(key).at(source, span)
}

/// The error about a number that a hairstyle refuses, at the key it comes from.
pub(crate) fn spec_error(error: &InvalidSpec, source: &Source) -> SceneError {
    let keys: &[&'static str] = match error.field {
        "hair.curl" => {
            &["hair.curl.radius", "hair.curl.kappa1", "hair.curl.kappa2", "hair.curl.tau"]
        }
        // Whichever of the two makes too many points.
        "wisps.points" => &["wisps.points", "wisps.hairs", "wisps.hairs_per_wisp", "wisps.density"],
        "hair.fibre.diameter" => &[
            "hair.fibre.diameter",
            "hair.fibre.mean_radius",
            "hair.fibre.semi_axis_a",
            "hair.fibre.semi_axis_b",
        ],
        "equilibrium" => &["equilibrium.elements", "equilibrium.accuracy"],
        _ => std::slice::from_ref(&error.field),
    };
    let (key, span, single) = locate_any(keys, source);
    let value = if single { source.slice(span.clone()) } else { &error.value };
    Diagnostic::outside(error.allowed).key(key).value(value).at(source, span)
}
