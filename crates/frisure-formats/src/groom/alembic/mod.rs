//! Alembic `.abc` (Ogawa), laid out as Unreal's "Alembic for Grooms Specification" 1.5 asks for.
//!
//! No crate writes Alembic, and the library is C++; the container and the few properties of curves are little.
//! Alembic says nothing about unit and axes: centimetres, y up, unless the caller says otherwise, as programs that write
//! for Unreal have it. What is written says so in properties of our own, which the reader believes.
//!
//! Sources of the layout: the Alembic library 1.8.12 (<https://github.com/alembic/alembic>), whose files the
//! tests compare with; Epic's "Using Alembic for Grooms".

mod curves;
mod meshes;
mod names;
mod objects;
mod part;
mod read;
mod write;

use super::checked::check_curves;
use super::format::Declaration;

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["abc"],
    title: "Alembic curves for Unreal, Blender, Houdini and Maya",
    frame: names::FRAME,
    holds_guides: true,
    usual_points: None,
    most_hairs: None,
    check: check_curves,
    write: write::encode,
    moves: true,
    read: Some(read::decode),
};
