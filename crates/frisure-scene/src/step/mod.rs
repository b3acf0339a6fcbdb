//! The steps of a scene: `[[step]]` to [`Operation`]s and back.

mod blame;
mod declare;
pub(super) mod edit;
mod hint;
mod layout;
mod operations;
mod record;
mod selection;
mod shapes;
mod write;

use std::borrow::Cow;
use std::path::Path;

use frisure_hairstyle::styling::Operation;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::error::{Fault, SceneError};
use super::resolve::Result;
use super::source::Source;
use super::{schema, shape, without_mark};

pub(super) use blame::fault;
pub use declare::Button;
pub(super) use hint::in_full;
pub(super) use operations::meant;
pub(crate) use record::{Record, parse_record};
pub(super) use selection::{WHERE, where_schema};
pub use write::{WriteStepError, write_step};

/// One of `[[step]]`, as it is written.
#[derive(Debug, Deserialize)]
#[serde(transparent)]
pub(super) struct Step(toml::Table);

impl JsonSchema for Step {
    fn schema_name() -> Cow<'static, str> {
        "Step".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let keys =
            operations::ALL.iter().map(|declared| (declared.name, declared.schema().to_value()));
        json_schema!({
            "type": "object", "additionalProperties": false,
            "description": "One of `[[step]]`.",
            "properties": keys.collect::<std::collections::BTreeMap<_, _>>(),
        })
    }
}

/// The operations of the steps of a scene.
pub(super) fn operations(steps: &[Step], source: &Source) -> Result<Vec<Operation>> {
    let read = |(i, step)| operation(step, &format!("step[{i}]"), source);
    steps.iter().enumerate().map(read).collect()
}

/// The buttons for operations on selected hair.
pub fn buttons() -> impl Iterator<Item = &'static Button> {
    operations::ALL.iter().filter_map(|declared| declared.button.as_ref())
}

/// The operation of the step at a path such as `step[1]`, which is empty if the text is one step: exactly
/// one, with every number in range.
fn operation(step: &Step, here: &str, source: &Source) -> Result<Operation> {
    let place = |name: &str| source.locate_key(&blame::join(here, name));
    let mut given: Vec<_> =
        operations::ALL.iter().filter(|declared| step.0.contains_key(declared.name)).collect();
    given.sort_by_key(|declared| place(declared.name).start);
    let declared = match given.as_slice() {
        [] => {
            let problem = match here {
                "" => "this step does nothing".to_owned(),
                here => format!("`{here}` does nothing"),
            };
            let hint = format!("a step has one of {}", Operation::NAMES.join(", "));
            return Err(Fault::new(problem).key(here).hint(hint).at(source, source.locate(here)));
        }
        [declared] => declared,
        [one, other, ..] => {
            let (one, other) = (one.name, other.name);
            let problem = format!("a step does one thing, and this one has `{one}` and `{other}`");
            let hint = "write each as a `[[step]]` of its own";
            let path = blame::join(here, other);
            let (first, span) = (source.locate(&blame::join(here, one)), source.locate(&path));
            let fault = Fault::new(problem).key(path).hint(hint);
            return Err(fault.related(first, "the other").at(source, span));
        }
    };
    let path = blame::join(here, declared.name);
    let operation = declared.read(&step.0[declared.name], &path, source)?;
    operation.check().map_err(|e| blame::out_of_range(&e, here, declared.name, source))?;
    Ok(operation)
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
    operation(&step, "", source)
}

/// The operations of the text of a scene.
fn parse_steps(name: &str, text: &str) -> Result<Vec<Operation>, SceneError> {
    super::Scene::parse(name, text, Path::new("")).map(|scene| scene.steps)
}
