//! Keys that exclude each other.

use std::ops::Range;

use super::error::{Fault, SceneError};
use super::source::Source;

/// Refuses keys of more than one group: groups are different ways to say the same thing.
pub(super) fn one_way(source: &Source, groups: &[&[String]]) -> Result<(), SceneError> {
    if groups.len() < 2 {
        return Ok(());
    }
    let mut given: Vec<(Range<usize>, &str)> = Vec::new();
    for group in groups {
        let places = group.iter().filter_map(|path| Some((source.find(path)?.0, path.as_str())));
        given.extend(places.min_by_key(|(span, _)| span.start));
    }
    given.sort_by_key(|(span, _)| span.start);
    let [(one, a), (other, b), ..] = given.as_slice() else { return Ok(()) };
    let (line, _) = source.position(one.start);
    let problem = format!("`{b}` says again what `{a}` says on line {line}");
    Err(Fault::new(problem)
        .key(*b)
        .value(source.slice(other.clone()))
        .hint("keep one of the two")
        .related(one.clone(), "said here")
        .at(source, other.clone()))
}
