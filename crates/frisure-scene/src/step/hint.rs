//! What to try where a step is not said in the way of steps.

use toml::de::DeTable;

use super::parse_step;
use crate::error::{Fault, SceneError};
use crate::key::nearest;
use crate::source::Source;

/// Each operation with the key that it is mostly about, and an example.
const OPERATIONS: [(&str, &str, &str); 12] = [
    ("wet", "to", "wet = {}"),
    ("dry", "keep", "dry = {}"),
    ("humidity", "", "humidity = 0.9"),
    ("cut", "below", "cut = { below = \"chin\" }"),
    ("grow", "by", "grow = { by = \"2 cm\" }"),
    ("comb", "to", "comb = { to = \"left\" }"),
    ("part", "at", "part = { at = \"middle\" }"),
    ("roll", "radius", "roll = { radius = \"1 cm\" }"),
    ("braid", "width", "braid = { width = \"2 cm\", pitch = \"4 cm\" }"),
    ("straighten", "where", "straighten = {}"),
    ("clip", "to", "clip = { at = 0.5, to = [0, \"-10 cm\", \"12 cm\"] }"),
    ("release", "where", "release = {}"),
];

/// Words of other people for operations.
const SYNONYMS: [(&str, &str); 20] = [
    ("shampoo", "wet"),
    ("wash", "wet"),
    ("soak", "wet"),
    ("blow_dry", "dry"),
    ("snip", "cut"),
    ("trim", "cut"),
    ("shorten", "cut"),
    ("lengthen", "grow"),
    ("brush", "comb"),
    ("parting", "part"),
    ("curl", "roll"),
    ("roller", "roll"),
    ("perm", "roll"),
    ("plait", "braid"),
    ("iron", "straighten"),
    ("ponytail", "clip"),
    ("bun", "clip"),
    ("pin", "clip"),
    ("undo", "release"),
    ("loosen", "release"),
];

/// The operation that a person may mean by a word that is none.
pub(crate) fn meant(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase().replace('-', "_");
    let synonym = SYNONYMS.iter().find(|(other, _)| *other == word).map(|s| s.1);
    synonym.or_else(|| nearest(&word, OPERATIONS.iter().map(|o| o.0)))
}

/// How an operation is written, of which a value was given where its table belongs; with the value,
/// if that says something there.
pub(crate) fn in_full(operation: &str, value: &str) -> Option<String> {
    let (name, key, example) = OPERATIONS.into_iter().find(|o| o.0 == operation)?;
    let short = value.len() <= 40 && !value.contains('\n');
    let with = |key| format!("{name} = {{ {key} = {value} }}");
    let said = |text: &String| short && parse_step("", text.as_str()).is_ok();
    let text = [with(key), with("where")].into_iter().find(said);
    Some(format!("write `{}`", text.unwrap_or_else(|| example.into())))
}

/// An error in the text of a single step, with what to try if the text is not that of one step.
pub(super) fn of_one_step(error: SceneError, source: &Source) -> SceneError {
    let SceneError::Fault(fault) = error else { return error };
    let hint = not_one_step(&fault, source);
    SceneError::Fault(Box::new(Fault { hint: hint.unwrap_or(fault.hint.clone()), ..*fault }))
}

fn not_one_step(fault: &Fault, source: &Source) -> Option<String> {
    let text = source.text.trim();
    if text.starts_with("[[step]]") || text.starts_with("[step]") {
        return Some("leave out `[[step]]`, and write what follows it".into());
    }
    let one_each = format!("`{0}` takes one step: give each a `{0}` of its own", source.name);
    if !fault.related.is_empty() && fault.problem.starts_with("a step does one thing") {
        return Some(one_each);
    }
    // The rest is about texts that are no TOML.
    source.document().err()?;
    if text.chars().all(|c| c.is_alphabetic() || c == '_') {
        let example = |name| OPERATIONS.into_iter().find(|o| o.0 == name).map(|o| o.2);
        return Some(format!("write `{}`", meant(text).and_then(example)?));
    }
    let (first, second) = source.text.split_at_checked(fault.span.start)?;
    let second = second.trim_start_matches([',', ';', ' ']);
    let is_step = |text: &str| DeTable::parse(text).is_ok_and(|table| !table.get_ref().is_empty());
    (is_step(first) && is_step(second)).then_some(one_each)
}
