//! The keys of a history: steps, and the text of the scene that they begin from.

use serde::Deserialize;

use super::{Step, operations};
use crate::error::{Fault, SceneError};
use crate::key::{Count, Key, Text};
use crate::source::Source;
use crate::{schema, shape};
use frisure_hairstyle::styling::Operation;

/// A history as it stands in a file.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct File {
    history: Key<Count>,
    done: Key<Count>,
    steps: Key<Count>,
    scene: Key<Text>,
    step: Vec<Step>,
}

/// A history as it is read; nothing is checked against each other.
pub(crate) struct Record {
    /// How many steps are done.
    pub(crate) done: usize,
    /// How many steps it says that it has.
    pub(crate) promised: usize,
    /// The text of the scene.
    pub(crate) scene: String,
    /// The steps that it has.
    pub(crate) steps: Vec<Operation>,
}

/// Understands the text of a history; `name` is what errors call it.
pub(crate) fn parse_record(name: &str, text: &str) -> Result<Record, SceneError> {
    let source = Source { name: name.to_owned(), text: text.to_owned() };
    let keys = serde_json::json!({ "properties": {
        "history": {}, "done": {}, "steps": {}, "scene": {},
        "step": schema()["properties"]["step"],
    }});
    shape::check(&source, source.document()?.get_ref(), &keys)?;
    let deserializer = toml::Deserializer::parse(&source.text).map_err(|e| source.syntax(&e))?;
    let file = File::deserialize(deserializer).map_err(|e| source.syntax(&e))?;
    let missing = |key: &str| Fault::new(format!("`{key}` is missing")).key(key).at(&source, 0..0);
    Ok(Record {
        done: file.done.get(&source)?.ok_or_else(|| missing("done"))?,
        promised: file.steps.get(&source)?.ok_or_else(|| missing("steps"))?,
        scene: file.scene.get(&source)?.ok_or_else(|| missing("scene"))?,
        steps: operations(&file.step, &source)?,
    })
}
