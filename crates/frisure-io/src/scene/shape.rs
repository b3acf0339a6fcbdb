//! The shape of a scene: keys that do not exist (and the nearest that does), and values where
//! tables belong.

use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Fault, SceneError};
use super::key::nearest;
use super::source::Source;

/// Refuses the first key that the schema does not know, and the first value that is not a table
/// where the schema has one.
pub(super) fn check(
    source: &Source,
    document: &DeTable<'_>,
    schema: &Value,
) -> Result<(), SceneError> {
    let mut walk = Walk { source, root: schema, faults: Vec::new() };
    walk.table(document, schema, "");
    // Tables are sorted by name; the first in the text is the one to mend first.
    let first = walk.faults.into_iter().min_by_key(|f| f.span.start);
    first.map_or(Ok(()), |fault| {
        let span = fault.span.clone();
        Err(fault.at(source, span))
    })
}

struct Walk<'a> {
    source: &'a Source,
    root: &'a Value,
    faults: Vec<Fault>,
}

impl Walk<'_> {
    fn table(&mut self, table: &DeTable<'_>, schema: &Value, path: &str) {
        for (key, value) in table {
            let name: &str = key.get_ref();
            if let Some(inner) = schema["properties"].get(name) {
                self.value(value, inner, &join(path, name));
            } else {
                let fault = self.unknown(name, path, schema);
                self.faults.push(Fault { span: key.span(), ..fault });
            }
        }
    }

    fn value(&mut self, value: &Spanned<DeValue<'_>>, schema: &Value, path: &str) {
        let items = &schema["items"];
        match value.get_ref() {
            DeValue::Table(table) if has_keys(schema) => self.table(table, schema, path),
            DeValue::Array(array) if has_keys(items) => {
                for (i, item) in array.iter().enumerate() {
                    self.value(item, items, &format!("{path}[{i}]"));
                }
            }
            _ if has_keys(schema) => self.not(value, path, "a table of keys"),
            _ if has_keys(items) => self.not(value, path, "a list of tables"),
            _ => {}
        }
    }

    fn not(&mut self, value: &Spanned<DeValue<'_>>, path: &str, allowed: &str) {
        let fault = Fault::outside(allowed).key(path).value(self.source.slice(value.span()));
        self.faults.push(Fault { span: value.span(), ..fault });
    }

    fn unknown(&self, name: &str, path: &str, schema: &Value) -> Fault {
        let known = || schema["properties"].as_object().into_iter().flat_map(|p| p.keys());
        let hint = if let Some(near) = nearest(name, known().map(String::as_str)) {
            format!("did you mean `{near}`?")
        } else if let [elsewhere] = find(name, self.root, "").as_slice() {
            // The right key in the wrong table.
            format!("there is a `{elsewhere}`")
        } else {
            format!("known keys: {}", known().map(String::as_str).collect::<Vec<_>>().join(", "))
        };
        let place = if path.is_empty() { String::new() } else { format!(" in `[{path}]`") };
        Fault::new(format!("unknown key `{name}`{place}")).key(join(path, name)).hint(hint)
    }
}

fn has_keys(schema: &Value) -> bool {
    schema.get("properties").is_some()
}

/// Paths of the keys of that name anywhere in the schema.
fn find(name: &str, schema: &Value, path: &str) -> Vec<String> {
    let Some(properties) = schema["properties"].as_object() else { return Vec::new() };
    if properties.contains_key(name) {
        return vec![join(path, name)];
    }
    properties.iter().flat_map(|(key, inner)| find(name, inner, &join(path, key))).collect()
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}
