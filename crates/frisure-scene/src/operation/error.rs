//! Errors about steps, at the keys that they come from.

use frisure_hairstyle::InvalidSpec;
use frisure_hairstyle::styling::StyleError;

use super::declare::join;
use super::operations::find;
use crate::error::{Diagnostic, SceneError};
use crate::source::Source;

/// The error about a number that an operation refuses, at the key that gives it in the step at `here`.
pub(crate) fn spec_error(
    error: &InvalidSpec,
    here: &str,
    operation: &str,
    source: &Source,
) -> SceneError {
    let written = |key: &str| {
        let path = join(here, key);
        source.find(&path).map(|(span, single)| (path, span, single))
    };
    // The field may be written by another key that excludes its own.
    let (_, field) = error.field.split_once('.').unwrap_or_default();
    let groups = find(operation).map_or(&[][..], |declared| declared.groups);
    let group = groups.iter().find(|group| group.keys.contains(&field));
    let instead = group.into_iter().flat_map(|group| group.keys);
    let instead = instead.map(|key| join(operation, key));
    let mut keys = std::iter::once(error.field.to_owned()).chain(instead);
    // A part of a selection does not say in which of several it is.
    let inside = keys.find_map(|key| written(&key)).unwrap_or_else(|| {
        let path = match error.field.starts_with("where") {
            true => join(&join(here, operation), "where"),
            false => join(here, operation),
        };
        (path.clone(), source.locate(&path), false)
    });
    let (key, span, single) = inside;
    let value = if single { source.slice(span.clone()) } else { &error.value };
    Diagnostic::outside(error.allowed).key(key).value(value).at(source, span)
}

/// The error about a step that cannot be done, at the step or at the key in it that is wrong.
pub(crate) fn step_error(
    index: usize,
    operation: &str,
    error: &StyleError,
    source: &Source,
) -> SceneError {
    let here = format!("step[{index}]");
    if let StyleError::Invalid(error) = error {
        return spec_error(error, &here, operation, source);
    }
    let step = join(&here, operation);
    let place = join(&step, "where");
    let chosen = source.find(&place).map(|(span, _)| source.slice(span));
    let written = |place: &str| source.find(place).map(|(span, _)| source.slice(span));
    // A raised level has no keyword.
    let raised = written(&join(&step, "raise")).is_some();
    let below = written(&join(&step, "below")).filter(|_| !raised);
    let around = ["off_skin", "sphere"].iter().any(|key| written(&join(&step, key)).is_some());
    let how = if around { "cut farther from the head" } else { "cut lower" };
    let hint = hint(error, chosen, below, how);
    let key = match error {
        StyleError::NothingSelected | StyleError::NoSuchWisp { .. } => place,
        _ => step,
    };
    let span = source.locate(&key);
    // The key is only named if it is written.
    let key = if source.find(&key).is_some() { key } else { here };
    Diagnostic::new(error.to_string()).key(key).hint(hint).at(source, span)
}

/// What to try; `chosen` is the value of `where` in the step, `below` that of the height that it cuts at, `how` the cut that would leave
/// hair.
fn hint(error: &StyleError, chosen: Option<&str>, below: Option<&str>, how: &str) -> String {
    match error {
        StyleError::NothingSelected => {
            "choose a larger part with `where`, or leave `where` out for all hair".into()
        }
        StyleError::NoSuchWisp { .. } => {
            "wisps are numbered from 0; `wisps.count` says how many there are".into()
        }
        StyleError::AboveRoot { .. } if below.is_some() => {
            let above = format!("{{ above = {} }}", below.unwrap_or(""));
            let rest = match chosen {
                None => above,
                Some(list) if list.starts_with('[') => {
                    format!("{{ all = [{{ any = {list} }}, {above}] }}")
                }
                Some(one) => format!("{{ all = [{one}, {above}] }}"),
            };
            format!("{how}, or leave out what is rooted lower: `where = {rest}`")
        }
        StyleError::AboveRoot { wisps, .. } => match without(wisps, chosen) {
            Some(rest) => format!("{how}, or leave them out: `where = {rest}`"),
            None => format!("{how}, or choose fewer wisps with `where`"),
        },
        StyleError::NothingBeforeEar => {
            "choose hair of the sides, the fringe or the top with `where`".into()
        }
        StyleError::NothingGathered { .. } => {
            "let the hair grow first, or hold it nearer to its roots".into()
        }
        StyleError::NothingReached { .. } => {
            "put the tie where hair gets to it around the head, such as `\"middle\"`".into()
        }
        StyleError::InsideHead { .. } => "put the point on the skin or outside of it".into(),
        StyleError::TooShortToBraid { .. } => {
            "let the hair grow first, tie it lower, or leave out `braided`".into()
        }
        StyleError::TooLong { .. } => "let it grow less, or cut it first".into(),
        StyleError::Parting(_) => "move the parting so that it lies on the scalp".into(),
        _ => String::new(),
    }
}

/// A choice without some wisps, if it is short enough to be shown.
fn without(wisps: &[usize], chosen: Option<&str>) -> Option<String> {
    const SHOWN: usize = 12;
    let chosen = chosen.unwrap_or("");
    if wisps.len() > SHOWN || chosen.len() > 40 || chosen.contains('\n') {
        return None;
    }
    let wisps: Vec<_> = wisps.iter().map(ToString::to_string).collect();
    let others = format!("{{ not = {{ wisps = [{}] }} }}", wisps.join(", "));
    Some(match chosen {
        "" => others,
        list if list.starts_with('[') => format!("{{ all = [{{ any = {list} }}, {others}] }}"),
        one => format!("{{ all = [{one}, {others}] }}"),
    })
}
