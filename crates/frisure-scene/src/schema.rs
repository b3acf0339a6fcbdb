//! The JSON Schema of scenes, made from the declarations of their keys.

use std::sync::LazyLock;

use schemars::Schema;
use serde_json::{Value, json};

use crate::declaration::{Declaration, ValueKind, add_range};
use crate::keys::KEYS;
use crate::operation::{WHERE, where_schema};
use crate::quantity::Dimension;

const DESCRIPTION: &str = "A scene: hair, the head it grows on, and how to look at it.\n\n\
    Every key has a default. Quantities are texts with a unit (\"25 cm\", \"70 um\", \"2.5 GPa\",\n\
    \"80 deg\") or bare numbers in SI units.";

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let mut schema = table(DESCRIPTION);
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    schema["title"] = "Scene".into();
    for declared in KEYS.iter() {
        insert(&mut schema, declared);
    }
    // A selection of wisps can hold others: the one part that needs a name.
    schema["$defs"][WHERE] = where_schema().to_value();
    schema
});

/// The JSON Schema of a scene: every key with its description, unit (`x-unit`), range and keywords.
///
/// Ranges are of bare numbers in SI units; texts with units are checked when a scene is read.
#[must_use]
pub fn schema() -> &'static Value {
    &SCHEMA
}

fn table(description: &str) -> Value {
    json!({
        "type": "object", "additionalProperties": false, "description": description,
        "properties": {},
    })
}

/// Adds a key to the table that it is in.
fn insert(root: &mut Value, declared: &Declaration) {
    let (tables, name) = declared.path.rsplit_once('.').unwrap_or(("", declared.path));
    let parts = tables.split('.').filter(|part| !part.is_empty());
    let parent = parts.fold(root, |table, part| match part.strip_suffix("[]") {
        Some(list) => &mut table["properties"][list]["items"],
        None => &mut table["properties"][part],
    });
    let (name, schema) = match name.strip_suffix("[]") {
        Some(list) => {
            let items = table(&format!("One of `[[{}]]`.", declared.path.replace("[]", "")));
            (list, json!({ "type": "array", "description": declared.doc, "items": items }))
        }
        None => (name, of_value(declared)),
    };
    parent["properties"][name] = schema;
}

fn of_value(declared: &Declaration) -> Value {
    let described = |mut schema: Schema| {
        schema.insert("description".into(), declared.doc.as_str().into());
        schema
    };
    match &declared.value {
        ValueKind::Table => table(&declared.doc),
        ValueKind::Other(schema, _) => described(schema()).to_value(),
        ValueKind::Number(number) => {
            let mut schema = described((number.schema)());
            if let Some((range, _)) = number.range {
                add_range(&mut schema, range);
            }
            schema.to_value()
        }
    }
}

/// What the schema says about a key that takes a quantity.
pub(crate) struct Quantity {
    pub(crate) dimension: &'static Dimension,
    pub(crate) min: Option<f64>,
    pub(crate) max: Option<f64>,
}

/// The quantity that the key at a path takes, if it takes one; `root` is the schema of the path's first table.
pub(crate) fn quantity(root: &'static Value, path: &str) -> Option<Quantity> {
    let key = path.split('.').try_fold(root, inside)?;
    // A list of quantities has their unit.
    let single = |schema: &Value| schema["type"] != "array";
    let of = alternatives(key).into_iter().filter(|schema| single(schema));
    let (unit, example) = of
        .into_iter()
        .find_map(|schema| Some((schema["x-unit"].as_str()?, &schema["examples"][0])))?;
    let unit = if unit == "a pure number" { "" } else { unit };
    let bound = |name: &str| key[name].as_f64();
    let (min, max) = (bound("minimum"), bound("maximum"));
    Some(Quantity { dimension: Dimension::of_si(unit, example.as_str())?, min, max })
}

/// The schema of a part of a path such as `plane` or `any[1]`.
fn inside(schema: &'static Value, part: &str) -> Option<&'static Value> {
    let (name, indices) = part.split_once('[').unwrap_or((part, ""));
    let key = alternatives(schema).into_iter().find_map(|one| one["properties"].get(name))?;
    let item =
        |list: &'static Value| alternatives(list).into_iter().find_map(|one| one.get("items"));
    indices.matches(']').try_fold(key, |list, _| item(list))
}

/// A schema, or each of those that it is any of.
pub(crate) fn alternatives(schema: &'static Value) -> Vec<&'static Value> {
    if let Some(name) = schema["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
        return alternatives(&self::schema()["$defs"][name]);
    }
    match schema["anyOf"].as_array() {
        Some(any) => any.iter().flat_map(alternatives).collect(),
        None => vec![schema],
    }
}

/// The keywords of a key with their titles.
pub fn options(declared: &Declaration) -> Vec<(&'static str, &'static str)> {
    let parts = declared.path.split('.');
    let Some(key) = parts.clone().try_fold(schema(), inside) else { return Vec::new() };
    let words = alternatives(key).into_iter().filter_map(|schema| schema["oneOf"].as_array());
    let option = |word: &'static Value| Some((word["const"].as_str()?, word["title"].as_str()?));
    words.flatten().filter_map(option).collect()
}
