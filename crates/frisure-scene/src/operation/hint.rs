//! Hints about texts that are no steps.

use toml::de::DeTable;

use super::declare::Declaration;
use super::operations::{find, suggestion};
use crate::error::{Diagnostic, SceneError};
use crate::source::Source;

/// How an operation is written that was given a value instead of its table; with the value, if one of its keys takes it.
pub(crate) fn in_full(operation: &str, value: &str) -> Option<String> {
    let declared = find(operation)?;
    let Declaration { name, main, example, .. } = declared;
    let short = value.len() <= 40 && !value.contains('\n');
    let with = |key| format!("{name} = {{ {key} = {value} }}");
    let is_step = |text: &String| short && is_written(declared, text);
    let text = main.iter().copied().chain(["where"]).map(with).find(is_step);
    Some(format!("write `{}`", text.unwrap_or_else(|| (*example).into())))
}

/// Whether a text is a step with an operation.
fn is_written(declared: &Declaration, text: &str) -> bool {
    let source = Source::new("", text);
    let Ok(step) = text.parse::<toml::Table>() else { return false };
    let value = &step[declared.name];
    let known = |key: &String| declared.keys.iter().any(|known| known.name == key);
    value.as_table().is_some_and(|table| table.keys().all(known))
        && declared.read(value, declared.name, &source).is_ok_and(|read| read.check().is_ok())
}

/// An error in the text of a single step, with what to try if the text is not that of one step.
pub(crate) fn of_one_step(error: SceneError, source: &Source) -> SceneError {
    let SceneError::Invalid(diagnostic) = error else { return error };
    let hint = not_one_step(&diagnostic, source);
    SceneError::Invalid(Box::new(Diagnostic {
        hint: hint.unwrap_or(diagnostic.hint.clone()),
        ..*diagnostic
    }))
}

fn not_one_step(diagnostic: &Diagnostic, source: &Source) -> Option<String> {
    let text = source.text.trim();
    if text.starts_with("[[step]]") || text.starts_with("[step]") {
        return Some("leave out `[[step]]`, and write what follows it".into());
    }
    let one_each = format!("`{0}` takes one step: give each a `{0}` of its own", source.name);
    if !diagnostic.related.is_empty() && diagnostic.problem.starts_with("a step does one thing") {
        return Some(one_each);
    }
    // The rest is about texts that are no TOML.
    source.document().err()?;
    if text.chars().all(|c| c.is_alphabetic() || c == '_') {
        let example = |name| find(name).map(|declared| declared.example);
        return Some(format!("write `{}`", suggestion(text).and_then(example)?));
    }
    let (first, second) = source.text.split_at_checked(diagnostic.span.start)?;
    let second = second.trim_start_matches([',', ';', ' ']);
    let is_step = |text: &str| DeTable::parse(text).is_ok_and(|table| !table.get_ref().is_empty());
    (is_step(first) && is_step(second)).then_some(one_each)
}
