//! Names that Alembic, Unreal and frisure use in a file.

use frisure_files::frame::Frame;

use super::super::attributes;

/// Unit and axes where the file has none: those of programs that write for Unreal.
pub(super) const FRAME: Frame = Frame::CENTIMETRES_Y;
/// Beginning of the names of Unreal's properties.
pub(super) const UNREAL: &str = "groom_";
/// Beginning of the names of ours.
pub(super) const OURS: &str = "frisure_";

/// Attributes that Unreal reads: our name, and its own without [`UNREAL`].
pub(super) const KNOWN: [(&str, &str); 7] = [
    (attributes::ID, "id"),
    (attributes::GROUP, "group_id"),
    (attributes::ROOT_UV, "root_uv"),
    (attributes::COLOUR, "color"),
    (attributes::CLOSEST_GUIDES, "closest_guides"),
    (attributes::GUIDE_WEIGHTS, "guide_weights"),
    (attributes::CLUMP, "clumpid"),
];

/// Schemas of curves, of polygon meshes and of transforms.
pub(super) const CURVES: &str = "AbcGeom_Curve_v2";
pub(super) const MESH: &str = "AbcGeom_PolyMesh_v1";
pub(super) const XFORM: &str = "AbcGeom_Xform_v3";
