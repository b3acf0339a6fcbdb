//! The keys of a history: steps, and the text of the scene that they begin from.

use frisure_hairstyle::styling::Operation;

use crate::document::Document;
use crate::error::SceneError;
use crate::kind::{Count, Kind, Text};
use crate::schema::schema;
use crate::source::Source;
use crate::{step, unit_hint, unknown_keys};

/// The contents of a history; nothing is checked against each other.
pub(crate) struct Record {
    /// How many steps are done.
    pub(crate) done: usize,
    /// How many steps it has, as it counts.
    pub(crate) promised: usize,
    /// The text of the scene.
    pub(crate) scene: String,
    /// The steps that it has.
    pub(crate) steps: Vec<Operation>,
}

/// Reads the text of a history; errors call it `name`.
pub(crate) fn parse_record(name: &str, text: &str) -> Result<Record, SceneError> {
    let source = Source { name: name.to_owned(), text: text.to_owned() };
    record(&source).map_err(unit_hint::add)
}

fn record(source: &Source) -> Result<Record, SceneError> {
    let keys = serde_json::json!({ "properties": {
        "history": {}, "done": {}, "steps": {}, "scene": {},
        "step": schema()["properties"]["step"],
    }});
    unknown_keys::check(source, source.document()?.get_ref(), &keys)?;
    let document = Document::parse(source)?;
    Ok(Record {
        done: needed::<Count>(&document, "done")?,
        promised: needed::<Count>(&document, "steps")?,
        scene: needed::<Text>(&document, "scene")?,
        steps: step::operations(&document)?,
    })
}

fn needed<K: Kind>(document: &Document<'_>, key: &str) -> Result<K::Value, SceneError> {
    let missing = || document.error(key, format!("`{key}` is missing"), "");
    document.get::<K>(key)?.ok_or_else(missing)
}
