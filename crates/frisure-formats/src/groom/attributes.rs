//! The attributes that grooms carry: their names, and values by name.
//!
//! Formats have their own names for some of them (`groom_id`, `primvars:…`); these are the ones inside.

use std::borrow::Cow;

use frisure_files::frame::Frame;
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::Vec3;

pub use frisure_strands::names::*;

/// Names of the parts of the scalp, by their number in [`GROUP`].
pub(super) const GROUPS: [&str; 6] = ["fringe", "top", "crown", "sides", "back", "nape"];

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

/// Whole numbers as values of `width` numbers each, if there is such a kind.
pub(super) fn whole_values(all: Vec<u32>, width: usize) -> Option<AttributeValues> {
    Some(match width {
        1 => AttributeValues::U32(all),
        3 => AttributeValues::U32x3(all.as_chunks().0.to_vec()),
        _ => return None,
    })
}

/// Real numbers as values of `width` numbers each, if there is such a kind.
pub(super) fn real_values(all: Vec<f32>, width: usize) -> Option<AttributeValues> {
    Some(match width {
        1 => AttributeValues::F32(all),
        2 => AttributeValues::F32x2(all.as_chunks().0.to_vec()),
        3 => AttributeValues::F32x3(all.as_chunks().0.to_vec()),
        _ => return None,
    })
}

/// Whether the values of an attribute are of the kind that its name stands for; other names stand for any.
pub(super) fn is_as_named(attribute: &Attribute) -> bool {
    let expected = match &*attribute.name {
        GUIDE | ID | GROUP | CLUMP => (true, 1),
        CLOSEST_GUIDES => (true, 3),
        GUIDE_WEIGHTS | COLOUR | DIRECTOR | NATURAL_STRAIN => (false, 3),
        ROOT_UV => (false, 2),
        WETNESS | AXIS_RATIO => (false, 1),
        _ => return true,
    };
    layout(&attribute.values) == expected
}

/// Turns the values of an attribute, if they are directions.
pub(super) fn turn_directions(attribute: &mut Attribute, turn: impl Fn(Vec3) -> Vec3) {
    if let AttributeValues::F32x3(all) = &mut attribute.values
        && attribute.name == DIRECTOR
    {
        all.iter_mut().for_each(|d| *d = turn(Vec3::from_array(*d)).to_array());
    }
}

/// The attribute with its directions in the axes of a file.
pub(super) fn in_file_axes(attribute: &Attribute, frame: Frame) -> Cow<'_, Attribute> {
    if attribute.name != DIRECTOR {
        return Cow::Borrowed(attribute);
    }
    let mut turned = attribute.clone();
    turn_directions(&mut turned, |d| frame.direction_to_file(d));
    Cow::Owned(turned)
}

/// Whether values are whole numbers, and how many numbers one value has.
pub(super) fn layout(values: &AttributeValues) -> (bool, usize) {
    match values {
        AttributeValues::U32(_) => (true, 1),
        AttributeValues::U32x3(_) => (true, 3),
        AttributeValues::F32(_) => (false, 1),
        AttributeValues::F32x2(_) => (false, 2),
        AttributeValues::F32x3(_) => (false, 3),
    }
}

/// Appends a value as little-endian bytes.
pub(super) fn push_value(out: &mut Vec<u8>, values: &AttributeValues, row: usize) {
    match values {
        AttributeValues::U32(v) => out.extend(v[row].to_le_bytes()),
        AttributeValues::U32x3(v) => out.extend(v[row].map(u32::to_le_bytes).as_flattened()),
        AttributeValues::F32(v) => out.extend(v[row].to_le_bytes()),
        AttributeValues::F32x2(v) => push(out, v[row]),
        AttributeValues::F32x3(v) => push(out, v[row]),
    }
}

/// Appends numbers as little-endian bytes.
pub(super) fn push<const N: usize>(out: &mut Vec<u8>, values: [f32; N]) {
    out.extend_from_slice(values.map(f32::to_le_bytes).as_flattened());
}
