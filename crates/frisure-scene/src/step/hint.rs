//! What to try where a step is not said in the way of steps.

use toml::de::DeTable;

use super::declare::Declaration;
use super::operations::{find, meant};
use super::parse_step;
use crate::error::{Fault, SceneError};
use crate::source::Source;

/// How an operation is written, of which a value was given where its table belongs; with the value,
/// if that says something there.
pub(crate) fn in_full(operation: &str, value: &str) -> Option<String> {
    let Declaration { name, main, example, .. } = find(operation)?;
    let short = value.len() <= 40 && !value.contains('\n');
    let with = |key| format!("{name} = {{ {key} = {value} }}");
    let said = |text: &String| short && parse_step("", text.as_str()).is_ok();
    let text = main.iter().copied().chain(["where"]).map(with).find(said);
    Some(format!("write `{}`", text.unwrap_or_else(|| (*example).into())))
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
        let example = |name| find(name).map(|declared| declared.example);
        return Some(format!("write `{}`", meant(text).and_then(example)?));
    }
    let (first, second) = source.text.split_at_checked(fault.span.start)?;
    let second = second.trim_start_matches([',', ';', ' ']);
    let is_step = |text: &str| DeTable::parse(text).is_ok_and(|table| !table.get_ref().is_empty());
    (is_step(first) && is_step(second)).then_some(one_each)
}
