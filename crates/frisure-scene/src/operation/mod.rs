//! The operations of steps: one declaration each, from which reading, writing, hints and the schema follow.

mod declare;
mod error;
mod hint;
mod operations;
mod selection;
mod shapes;
mod tables;

use schemars::{Schema, json_schema};
use toml::{Table, Value};

use crate::error::ValueError;
use crate::kind::Kind;

pub use declare::Button;
pub(crate) use declare::join;
pub(crate) use error::{spec_error, step_error};
pub(crate) use hint::{in_full, of_one_step};
pub(crate) use operations::{ALL, declaration, suggestion};
pub(crate) use selection::{WHERE, Where, where_schema};

/// The steps of a scene, as they are written.
pub(crate) struct Steps;

impl Kind for Steps {
    type Value = Vec<Table>;

    fn read(value: &Value) -> Result<Vec<Table>, ValueError> {
        let tables = value.as_array().and_then(|steps| steps.iter().map(Value::as_table).collect());
        let tables: Option<Vec<&Table>> = tables;
        let tables = tables.ok_or_else(|| ValueError::new("a list of tables"))?;
        Ok(tables.into_iter().cloned().collect())
    }

    fn schema() -> Schema {
        let keys = ALL.iter().map(|declared| (declared.name, declared.schema().to_value()));
        let step = json_schema!({
            "type": "object", "additionalProperties": false,
            "description": "One of `[[step]]`.",
            "properties": keys.collect::<std::collections::BTreeMap<_, _>>(),
        });
        json_schema!({ "type": "array", "items": step })
    }
}
