//! The keys that a scene has, and what each takes.

use serde_json::Value;

use crate::quantity::Dimension;
use crate::schema::{alternatives, quantity, schema};
use crate::similar::nearest;

/// What a key takes.
#[derive(Clone, Copy, Debug)]
pub(super) enum ValueType {
    /// A number with a unit.
    Quantity(&'static Dimension),
    /// A whole number.
    Whole,
    /// A word, a flag, a list.
    Other,
}

impl ValueType {
    /// The dimension of its numbers.
    pub(super) fn dimension(self) -> Option<&'static Dimension> {
        match self {
            Self::Quantity(dimension) => Some(dimension),
            Self::Whole | Self::Other => None,
        }
    }
}

/// A path that is no key.
pub(super) struct NoKey {
    pub(super) problem: String,
    pub(super) hint: String,
}

/// What the key at a path takes.
pub(super) fn value_type(path: &str) -> Result<ValueType, NoKey> {
    let mut here = schema();
    let mut so_far = String::new();
    for part in path.split('.') {
        let (name, indices) = part.split_once('[').unwrap_or((part, ""));
        let tables: Vec<_> = alternatives(here)
            .into_iter()
            .filter_map(|schema| schema["properties"].as_object())
            .collect();
        let found = tables.iter().find_map(|keys| keys.get(name));
        let known = tables.iter().flat_map(|keys| keys.keys()).map(String::as_str);
        here = found.ok_or_else(|| match is_list(here) {
            true => a_list(&so_far),
            false => unknown(name, &so_far, known.collect()),
        })?;
        so_far = if so_far.is_empty() { part.to_owned() } else { format!("{so_far}.{part}") };
        for _ in indices.matches(']') {
            let item = alternatives(here).into_iter().find_map(|schema| schema.get("items"));
            here = item.ok_or_else(|| no_list(&so_far))?;
        }
    }
    let schemas = alternatives(here);
    let keys = || schemas.iter().find(|schema| schema.get("properties").is_some());
    if schemas.len() == 1 && keys().is_some() {
        return Err(no_value(path, here));
    }
    if is_list(here) {
        return Err(a_list(path));
    }
    if let Some(quantity) = quantity(schema(), path) {
        return Ok(ValueType::Quantity(quantity.dimension));
    }
    let is_whole = schemas.iter().any(|schema| schema["type"] == "integer");
    Ok(if is_whole { ValueType::Whole } else { ValueType::Other })
}

fn unknown(name: &str, table: &str, known: Vec<&'static str>) -> NoKey {
    let of = if table.is_empty() { "a scene".to_owned() } else { format!("`{table}`") };
    let problem = format!("`{name}` is no key of {of}");
    let elsewhere = || elsewhere(name, schema(), "");
    let hint = match (nearest(name, known.iter().copied()), known.is_empty()) {
        (Some(near), _) => format!("did you mean `{near}`?"),
        (None, true) => format!("{of} has no keys in it"),
        (None, false) => match elsewhere() {
            Some(path) if path == name => format!("`{name}` is a key of the scene itself"),
            Some(path) => format!("there is a `{path}`"),
            None => format!("known keys: {}", known.join(", ")),
        },
    };
    NoKey { problem, hint }
}

/// Where else a key of a name is.
fn elsewhere(name: &str, schema: &'static Value, path: &str) -> Option<String> {
    let keys = schema["properties"].as_object()?;
    let join = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    if keys.contains_key(name) {
        return Some(join(name));
    }
    keys.iter().find_map(|(key, inner)| elsewhere(name, inner, &join(key)))
}

/// Whether something is a list of tables.
fn is_list(schema: &'static Value) -> bool {
    alternatives(schema).iter().any(|schema| schema["items"].get("properties").is_some())
}

fn no_list(path: &str) -> NoKey {
    let name = path.split_once('[').map_or(path, |(name, _)| name);
    NoKey {
        problem: format!("`{name}` is no list"),
        hint: "leave the number in brackets out".into(),
    }
}

fn a_list(path: &str) -> NoKey {
    let hint = format!("`{path}[0]` is the first of them: name a key in it");
    NoKey { problem: format!("`{path}` is a list of tables"), hint }
}

fn no_value(path: &str, table: &Value) -> NoKey {
    let keys = table["properties"].as_object().into_iter().flat_map(|keys| keys.keys());
    let keys = keys.map(String::as_str).collect::<Vec<_>>().join(", ");
    NoKey { problem: format!("`{path}` is a table"), hint: format!("name a key in it: {keys}") }
}
