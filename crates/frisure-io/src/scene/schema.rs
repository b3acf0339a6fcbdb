//! The JSON Schema of scenes, made from the structs that read them.

use std::sync::LazyLock;

use schemars::generate::SchemaSettings;
use serde_json::Value;

use super::file::File;

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    settings.into_generator().into_root_schema_for::<File>().to_value()
});

/// The JSON Schema of a scene: every key with its description, unit (`x-unit`), range and words.
///
/// Ranges are of bare numbers in SI units; texts with units are checked when a scene is read.
#[must_use]
pub fn schema() -> &'static Value {
    &SCHEMA
}
