//! Keys that do not exist, with the most similar that does, and values where tables belong.

use std::ops::Range;

use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{Diagnostic, LONGEST_QUOTE, SceneError, shortened};
use crate::operation;
use crate::similar::near;
use crate::source::Source;

/// Refuses the first key that the schema does not know, and the first value that is not a table
/// where the schema has one.
pub(crate) fn check(
    source: &Source,
    document: &DeTable<'_>,
    schema: &Value,
) -> Result<(), SceneError> {
    let mut walk = Walk { source, root: schema, first: None };
    walk.table(document, schema, "");
    let Some(Fault { span, path, kind }) = &walk.first else { return Ok(()) };
    let diagnostic = match kind {
        FaultKind::Unknown { name, schema } => walk.unknown(name, path, schema),
        FaultKind::Not { allowed } => walk.not(span.clone(), path, allowed),
    };
    Err(diagnostic.at(source, span.clone()))
}

struct Walk<'a> {
    source: &'a Source,
    root: &'a Value,
    /// The first in the text: the one to mend first. Tables are sorted by name.
    first: Option<Fault<'a>>,
}

/// A mistake that is found; its error is made for the first alone, because hints take time.
struct Fault<'a> {
    span: Range<usize>,
    path: String,
    kind: FaultKind<'a>,
}

enum FaultKind<'a> {
    /// A key that the table at the path does not have.
    Unknown { name: String, schema: &'a Value },
    /// The value at the path is none of these.
    Not { allowed: &'static str },
}

impl<'a> Walk<'a> {
    /// Keeps a mistake, if it is before those that were found.
    fn found(&mut self, span: Range<usize>, fault: impl FnOnce() -> (String, FaultKind<'a>)) {
        if self.first.as_ref().is_none_or(|first| span.start < first.span.start) {
            let (path, kind) = fault();
            self.first = Some(Fault { span, path, kind });
        }
    }

    fn table(&mut self, table: &DeTable<'_>, schema: &'a Value, path: &str) {
        for (key, value) in table {
            let name: &str = key.get_ref();
            if let Some(inner) = schema["properties"].get(name) {
                self.value(value, inner, &join(path, name));
            } else {
                let kind = || FaultKind::Unknown { name: name.to_owned(), schema };
                self.found(key.span(), || (path.to_owned(), kind()));
            }
        }
    }

    fn value(&mut self, value: &Spanned<DeValue<'_>>, schema: &'a Value, path: &str) {
        let items = &schema["items"];
        let mut not = |allowed| {
            self.found(value.span(), || (path.to_owned(), FaultKind::Not { allowed }));
        };
        match value.get_ref() {
            DeValue::Table(table) if has_keys(schema) => self.table(table, schema, path),
            DeValue::Array(array) if has_keys(items) => {
                for (i, item) in array.iter().enumerate() {
                    self.value(item, items, &format!("{path}[{i}]"));
                }
            }
            _ if has_keys(schema) => not("a table of keys"),
            _ if has_keys(items) => not("a list of tables"),
            _ => {}
        }
    }

    fn not(&self, span: Range<usize>, path: &str, allowed: &str) -> Diagnostic {
        let written = self.source.slice(span);
        let hint = self.operation(path).and_then(|name| operation::in_full(name, written));
        let diagnostic = Diagnostic::outside(allowed).key(path).value(written);
        diagnostic.hint(hint.unwrap_or_default())
    }

    /// The key of a step at a path, if it is one.
    fn operation<'p>(&self, path: &'p str) -> Option<&'p str> {
        let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
        self.is_step(table).then_some(name)
    }

    /// Whether the table at a path is a step.
    fn is_step(&self, path: &str) -> bool {
        match path {
            "" => self.root["properties"].get("release").is_some(),
            path => path.starts_with("step[") && path.ends_with(']'),
        }
    }

    /// Whether the table at a path is within a step.
    fn is_in_step(&self, path: &str) -> bool {
        self.is_step("") || path.starts_with("step[")
    }

    fn unknown(&self, name: &str, path: &str, schema: &Value) -> Diagnostic {
        let place = if path.is_empty() { String::new() } else { format!(" in `[{path}]`") };
        let quoted = shortened(name.to_owned(), LONGEST_QUOTE);
        let diagnostic =
            Diagnostic::new(format!("unknown key `{quoted}`{place}")).key(join(path, name));
        diagnostic.hint(self.instead(name, path, schema))
    }

    /// What to try instead of a key that does not exist.
    fn instead(&self, name: &str, path: &str, schema: &Value) -> String {
        if self.operation(path) == Some("part") && name == "where" {
            return "a parting is about the whole head: leave `where` out".into();
        }
        let known = || schema["properties"].as_object().into_iter().flat_map(|p| p.keys());
        // `head` where there are `head_model` and `head_mesh`.
        let longer: Vec<String> = known()
            .filter(|key| key.strip_prefix(name).is_some_and(|rest| rest.starts_with('_')))
            .map(|key| format!("`{key}`"))
            .collect();
        if !longer.is_empty() {
            return format!("did you mean {}?", longer.join(" or "));
        }
        let is_step = self.is_step(path);
        let here = near(name, known().map(String::as_str));
        let here = here.filter(|(distance, _)| !is_step || *distance < 2);
        // The right key in the wrong table, if it is nearer than those of this one.
        let elsewhere = || match is_step {
            true => elsewhere(name, schema, here),
            // What an operation takes is in its own table.
            false if self.is_in_step(path) => None,
            false => elsewhere(name, self.root, here),
        };
        if let Some(places) = elsewhere() {
            return places;
        }
        match here.map(|(_, near)| near).or_else(|| operation::suggestion(name).filter(|_| is_step))
        {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("known keys: {}", known().cloned().collect::<Vec<_>>().join(", ")),
        }
    }
}

/// What to say of keys in other tables that are called as a key, or nearly so and nearer than one
/// that is known here.
fn elsewhere(name: &str, root: &Value, here: Option<(usize, &str)>) -> Option<String> {
    let mut paths = Vec::new();
    below(root, "", &mut paths);
    let own = |path: &String| path.rsplit('.').next().unwrap_or("").to_owned();
    let names: Vec<_> = paths.iter().map(own).collect();
    let (distance, near) = near(name, names.iter().map(String::as_str))?;
    let of_that_name = paths.iter().zip(&names).filter(|(_, own)| *own == near);
    let found: Vec<_> = of_that_name.map(|(path, _)| format!("`{path}`")).collect();
    match (distance, here) {
        (_, Some((known, _))) if known <= distance => None,
        // Many tables have such a key, or one is a little like it.
        _ if found.len() > 3 => None,
        (0, _) if paths.iter().any(|path| path == near) => {
            Some(format!("`{near}` is a key of the scene itself: write it above the first table"))
        }
        (0, _) => Some(format!("there is a {}", found.join(", a "))),
        // Two letters wrong in another table is another word.
        (2.., _) => None,
        _ => Some(format!("did you mean {}?", found.join(" or "))),
    }
}

/// Paths of all keys of tables in a schema.
fn below(schema: &Value, path: &str, out: &mut Vec<String>) {
    for (key, inner) in schema["properties"].as_object().into_iter().flatten() {
        let path = join(path, key);
        below(inner, &path, out);
        out.push(path);
    }
}

fn has_keys(schema: &Value) -> bool {
    schema.get("properties").is_some()
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}
