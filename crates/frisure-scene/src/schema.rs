//! The JSON Schema of scenes, made from the structs that read them.

use std::sync::LazyLock;

use frisure_hairstyle::{Range, range_of};
use schemars::generate::SchemaSettings;
use serde_json::Value;

use super::file::File;
use super::{bare, step};
use crate::quantity::Dimension;

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    let mut schema = settings.into_generator().into_root_schema_for::<File>().to_value();
    // A choice of wisps can hold others: the one part that has to be named to be described.
    add_ranges(&mut schema, "");
    schema["$defs"][step::WHERE] = step::where_schema().to_value();
    schema
});

/// The JSON Schema of a scene: every key with its description, unit (`x-unit`), range and words.
///
/// Ranges are of bare numbers in SI units; texts with units are checked when a scene is read.
#[must_use]
pub fn schema() -> &'static Value {
    &SCHEMA
}

/// Adds the ranges of what a hairstyle checks, and puts them into the descriptions.
fn add_ranges(schema: &mut Value, path: &str) {
    let keys = schema.get_mut("properties").and_then(Value::as_object_mut);
    for (key, inner) in keys.into_iter().flatten() {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        if let Some(range) = range_of(&path) {
            write_range(inner, range);
        }
        match inner.get_mut("items") {
            Some(items) => add_ranges(items, &path),
            None => add_ranges(inner, &path),
        }
    }
}

/// Adds a range to the schema of a number that has none of its own.
fn write_range(schema: &mut Value, range: &Range) {
    let allowed = range.allowed.replace('²', "^2");
    let (_, between) = allowed.split_once("between ").unwrap_or(("", &allowed));
    if let Some(doc) = schema["description"].as_str() {
        schema["description"] = doc.replace("{}", &between.replacen(" and ", " to ", 1)).into();
    }
    let whole = schema["type"] == "integer";
    if schema["type"].is_null() || schema["type"] == "array" || schema.get("maximum").is_some() {
        return;
    }
    let bound = |x: f64| if whole { Value::from(x as i64) } else { Value::from(x) };
    schema["minimum"] = bound(range.min);
    schema["maximum"] = bound(range.max);
}

/// A key of a scene that takes a number, as programs offer it.
#[derive(Debug)]
pub struct NumberKey {
    /// What it means.
    pub doc: &'static str,
    /// The dimension of the number; none if it is a whole number.
    pub dimension: Option<&'static Dimension>,
    /// The range (SI units), where it has one.
    pub range: Option<[f64; 2]>,
}

/// The key with a path, such as `wisps.clumping`, if it takes a number.
#[must_use]
pub fn number_key(path: &str) -> Option<NumberKey> {
    let key = path.split('.').try_fold(schema(), |table, name| table["properties"].get(name))?;
    let dimension = bare::quantity(schema(), path).map(|quantity| quantity.dimension);
    let bound = |name: &str| key[name].as_f64();
    let range = bound("minimum").zip(bound("maximum")).map(|(least, most)| [least, most]);
    let is_number = dimension.is_some() || key["type"] == "integer";
    is_number.then_some(NumberKey { doc: key["description"].as_str()?, dimension, range })
}
