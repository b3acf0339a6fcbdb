//! Setting attributes of strands.

use frisure_strands::{Attribute, AttributeValues, Domain, Strands};

/// Sets an attribute that the strands do not have yet.
///
/// # Panics
/// If they have it, or it has another number of values.
pub(super) fn put(strands: &mut Strands, domain: Domain, name: &str, values: AttributeValues) {
    let attribute = Attribute { name: name.into(), domain, values };
    strands.set_attribute(attribute).expect("one value each, set once");
}
