//! The attributes that grooms carry: their names, and values by name.
//!
//! Formats have their own names for some of them (`groom_id`, `primvars:…`); these are the ones inside.

use frisure_strands::{Attribute, AttributeValues, Domain, Strands};

pub use frisure_strands::names::*;

/// An attribute with one value for each strand.
#[must_use]
pub fn of_strands(name: &str, values: AttributeValues) -> Attribute {
    Attribute { name: name.into(), domain: Domain::Strand, values }
}

/// An attribute with one value for each point.
#[must_use]
pub fn of_points(name: &str, values: AttributeValues) -> Attribute {
    Attribute { name: name.into(), domain: Domain::Point, values }
}

/// A number for each strand, if there is such an attribute.
#[must_use]
pub fn indices<'a>(strands: &'a Strands, name: &str) -> Option<&'a [u32]> {
    match strands.attribute(name) {
        Some(Attribute { domain: Domain::Strand, values: AttributeValues::U32(v), .. }) => Some(v),
        _ => None,
    }
}
