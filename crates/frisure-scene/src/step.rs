//! Reading steps: `[[step]]` to [`Operation`]s.

use frisure_hairstyle::styling::Operation;
use toml::Table;

use crate::document::Document;
use crate::error::{Diagnostic, Result, SceneError};
use crate::operation::{self, Button, Steps, join};
use crate::schema::schema;
use crate::source::Source;
use crate::{unit_hint, unknown_keys};

/// Most steps of a scene. Chosen: each takes a millisecond or more even where it changes nothing, and a day in the salon has hundreds.
pub(crate) const MOST_STEPS: usize = 10_000;

/// The operations of the steps of a scene.
pub(crate) fn operations(document: &Document<'_>) -> Result<Vec<Operation>> {
    let steps = document.get_or::<Steps>("step", Vec::new())?;
    if steps.len() > MOST_STEPS {
        let problem = format!("there are {} steps; {MOST_STEPS} are possible", steps.len());
        let hint = "leave out steps that change nothing, or write the hair to a groom and go on from that (`[groom]`)";
        return Err(document.error("step", problem, hint));
    }
    let read = |(i, step)| operation(step, &format!("step[{i}]"), document.source);
    steps.iter().enumerate().map(read).collect()
}

/// The buttons for operations on selected hair.
pub fn buttons() -> impl Iterator<Item = &'static Button> {
    operation::ALL.iter().flat_map(|declared| declared.buttons)
}

impl Button {
    /// Returns the operation of its step, on all hair.
    #[must_use]
    pub fn operation(&self) -> Operation {
        parse_step(self.label, self.step).expect("the declared steps are tested")
    }
}

/// The operation of the step at a path such as `step[1]`, which is empty if the text is one step: exactly
/// one, with every number in range.
fn operation(step: &Table, here: &str, source: &Source) -> Result<Operation> {
    let place = |name: &str| source.locate_key(&join(here, name));
    let mut given: Vec<_> =
        operation::ALL.iter().filter(|declared| step.contains_key(declared.name)).collect();
    given.sort_by_key(|declared| place(declared.name).start);
    let declared = match given.as_slice() {
        [] => {
            let problem = match here {
                "" => "this step does nothing".to_owned(),
                here => format!("`{here}` does nothing"),
            };
            let hint = format!("a step has one of {}", Operation::NAMES.join(", "));
            return Err(Diagnostic::new(problem)
                .key(here)
                .hint(hint)
                .at(source, source.locate(here)));
        }
        [declared] => declared,
        [one, other, ..] => {
            let (one, other) = (one.name, other.name);
            let problem = format!("a step does one thing, and this one has `{one}` and `{other}`");
            let hint = "write each as a `[[step]]` of its own";
            let path = join(here, other);
            let (first, span) = (source.locate(&join(here, one)), source.locate(&path));
            let diagnostic = Diagnostic::new(problem).key(path).hint(hint);
            return Err(diagnostic.related(first, "the other").at(source, span));
        }
    };
    let path = join(here, declared.name);
    let read = declared.read(&step[declared.name], &path, source)?;
    read.check().map_err(|e| operation::spec_error(&e, here, declared.name, source))?;
    Ok(read)
}

/// Reads the text of one step, such as `cut = { below = "brows" }`; errors call it `name`.
///
/// # Errors
/// [`SceneError`].
pub fn parse_step(name: &str, text: impl Into<String>) -> Result<Operation, SceneError> {
    let source = Source::new(name, text);
    one_step(&source).map_err(|error| operation::of_one_step(unit_hint::add(error), &source))
}

fn one_step(source: &Source) -> Result<Operation> {
    let schema = &schema()["properties"]["step"]["items"];
    unknown_keys::check(source, source.document()?.get_ref(), schema)?;
    operation(&source.text.parse().map_err(|e| source.syntax(&e))?, "", source)
}
