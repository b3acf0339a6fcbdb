//! What objects of all kinds have in an Alembic file.

use frisure_ogawa::write::{Pod, Property, Sample};

use super::names::XFORM;

/// The metadata of an object of a schema.
pub(super) fn schema_of_object(schema: &str, base: &str, property: &str) -> String {
    let base = if base.is_empty() { String::new() } else { format!("{base};") };
    format!("schema={schema};{base}schemaObjTitle={schema}:{property}")
}

/// A transform that moves nothing, with some properties more.
pub(super) fn still(more: Vec<Property<'static>>) -> Property<'static> {
    let inherits = Sample::of(Pod::Bool, 1, 1, |out| out.push(1));
    let mut parts = vec![Property::scalar(".inherits", "", inherits)];
    parts.extend(more);
    Property::compound(".xform", &format!("schema={XFORM}"), parts)
}
