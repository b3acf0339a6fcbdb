//! Alembic `.abc` (Ogawa), laid out as Unreal's "Alembic for Grooms Specification" 1.5 asks for.
//!
//! No crate writes Alembic, and the library is C++; the container and the few properties of curves are little.
//! Alembic says nothing about unit and axes: centimetres, y up, unless told otherwise, as programs that write
//! for Unreal have it. What is written says so in properties of our own, which the reader believes.
//!
//! Sources of the layout: the Alembic library 1.8.12 (<https://github.com/alembic/alembic>), whose files the
//! tests compare with; Epic's "Using Alembic for Grooms".

mod curves;
mod part;
mod read;
mod write;

use super::attributes as names;

pub(super) use read::decode;
pub(super) use write::{check, encode};

/// Beginning of the names of Unreal's properties.
const UNREAL: &str = "groom_";
/// Beginning of the names of ours.
const OURS: &str = "frisure_";

/// Attributes that Unreal knows: our name, and its, without [`UNREAL`].
const KNOWN: [(&str, &str); 6] = [
    (names::ID, "id"),
    (names::GROUP, "group_id"),
    (names::ROOT_UV, "root_uv"),
    (names::COLOUR, "color"),
    (names::CLOSEST_GUIDES, "closest_guides"),
    (names::GUIDE_WEIGHTS, "guide_weights"),
];

/// Names of the parts of the scalp, by their number.
const GROUPS: [&str; 6] = ["fringe", "top", "crown", "sides", "back", "nape"];

/// What marks curves and transforms among objects.
const CURVES: &str = "AbcGeom_Curve_v2";
const XFORM: &str = "AbcGeom_Xform_v3";
