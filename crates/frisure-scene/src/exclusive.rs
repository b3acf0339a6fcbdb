//! Keys that exclude each other: reading refuses two of them, and editing removes the others.

use std::ops::Range;

use crate::error::{Diagnostic, SceneError};
use crate::source::Source;

/// Alternatives, each of some keys: keys of different alternatives exclude each other.
type Group = &'static [&'static [&'static str]];

/// All groups; `[]` stands for the index of an item in a list.
pub(crate) const GROUPS: [Group; 19] = [
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
    &[&["pose.pitch", "pose.roll"], &["pose.down"]],
    &[&["head.scalp_group"], &["head.scalp_colour"], &["head.scalp_mask"], &["head.scalp_weights"]],
    &[&["head.unit"], &["head.scale"]],
    &[&["head.model", "head.face"], &["head.mesh"]],
    &[&["groom.head_model"], &["groom.head_mesh"]],
    &[&["region[].length"], &["region[].down_to"]],
    &[&["equilibrium.elements"], &["equilibrium.accuracy"]],
    &[
        &["look.colour", "look.eumelanin", "look.pheomelanin"],
        &["look.reflectance"],
        &["look.absorption"],
    ],
    &[&["light.lamp[].colour"], &["light.lamp[].temperature"]],
    &[&["light.lamp[].angle"], &["light.lamp[].size"]],
    &[
        &["light.lamp[].azimuth", "light.lamp[].elevation", "light.lamp[].distance"],
        &["light.lamp[].position"],
    ],
];

/// The other alternatives' keys of every group that a key is in, without indices.
pub(crate) fn others(key: &str) -> impl Iterator<Item = &'static str> {
    let has = move |keys: &[&str]| keys.contains(&key);
    let groups = GROUPS.iter().filter(move |group| group.iter().any(|keys| has(keys)));
    groups
        .flat_map(move |group| group.iter().filter(move |keys| !has(keys)).copied().flatten())
        .copied()
}

/// Refuses more than one alternative; `given` are the keys of each that are given.
pub(crate) fn check_given(source: &Source, given: &[Vec<String>]) -> Result<(), SceneError> {
    if given.len() < 2 {
        return Ok(());
    }
    let first = |paths: &Vec<String>| -> Option<(Range<usize>, String)> {
        let places = paths.iter().map(|path| (source.locate(path), path.clone()));
        places.min_by_key(|(span, _)| span.start)
    };
    let mut first: Vec<_> = given.iter().filter_map(first).collect();
    first.sort_by_key(|(span, _)| span.start);
    let [(one, a), (other, b), ..] = first.as_slice() else { return Ok(()) };
    let (line, _) = source.position(one.start);
    let problem = format!("`{b}` says again what `{a}` says on line {line}");
    Err(Diagnostic::new(problem)
        .key(b.as_str())
        .value(source.slice(other.clone()))
        .hint("keep one of the two")
        .related(one.clone(), "said here")
        .at(source, other.clone()))
}
