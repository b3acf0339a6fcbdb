//! The JSON Schema of scenes, made from the structs that read them.

use std::sync::LazyLock;

use schemars::generate::SchemaSettings;
use serde_json::Value;

use super::file::File;
use super::step;

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    let mut schema = settings.into_generator().into_root_schema_for::<File>().to_value();
    // A choice of wisps can hold others: the one part that has to be named to be described.
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
