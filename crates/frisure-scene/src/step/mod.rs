//! The steps of a scene: `[[step]]` to [`Operation`]s and back.

mod blame;
mod chosen;
pub(super) mod edit;
mod hint;
mod keys;
mod layout;
mod read;
mod record;
mod shapes;
mod write;

use std::path::Path;

use frisure_hairstyle::styling::Operation;
use serde::Deserialize;

use super::error::SceneError;
use super::resolve::Result;
use super::source::Source;
use super::{schema, shape, without_mark};

pub(super) use blame::fault;
pub(super) use chosen::{WHERE, where_schema};
pub(super) use hint::{in_full, meant};
pub(super) use keys::Step;
pub(crate) use record::{Record, parse_record};
pub use write::{WriteStepError, write_step};

/// The operations of the steps of a scene.
pub(super) fn operations(steps: &[Step], source: &Source) -> Result<Vec<Operation>> {
    let read = |(i, step)| read::operation(step, &format!("step[{i}]"), source);
    steps.iter().enumerate().map(read).collect()
}

/// Understands the text of one step, such as `cut = { below = "brows" }`; `name` is what errors call
/// the text.
///
/// # Errors
/// [`SceneError`].
pub fn parse_step(name: &str, text: impl Into<String>) -> Result<Operation, SceneError> {
    let source = Source { name: name.to_owned(), text: without_mark(text.into()) };
    one_step(&source).map_err(|error| hint::of_one_step(error, &source))
}

fn one_step(source: &Source) -> Result<Operation> {
    let schema = &schema()["properties"]["step"]["items"];
    shape::check(source, source.document()?.get_ref(), schema)?;
    let deserializer = toml::Deserializer::parse(&source.text).map_err(|e| source.syntax(&e))?;
    let step = Step::deserialize(deserializer).map_err(|e| source.syntax(&e))?;
    read::operation(&step, "", source)
}

/// The operations of the text of a scene.
fn parse_steps(name: &str, text: &str) -> Result<Vec<Operation>, SceneError> {
    super::Scene::parse(name, text, Path::new("")).map(|scene| scene.steps)
}
