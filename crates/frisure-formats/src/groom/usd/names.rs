//! Names of attributes in a stage.

use super::super::attributes as inside;

/// The prefix of attributes that only we know: physical quantities, in SI units whatever the unit of the stage.
pub(super) const OURS: &str = "primvars:frisure:";

/// Name inside, primvar, type of one value. Where several primvars have one name inside, readers take the first that
/// is there.
pub(super) const PRIMVARS: [(&str, &str, &str); 12] = [
    (inside::GUIDE, "primvars:guide_curve_index", "int"),
    (inside::CLOSEST_GUIDES, "primvars:groom_closest_guides", "int3"),
    (inside::GUIDE_WEIGHTS, "primvars:groom_guide_weights", "float3"),
    (inside::ID, "primvars:groom_id", "int"),
    (inside::GROUP, "primvars:groom_group_id", "int"),
    // A number and no name, as Alembic has it: Blender warns of primvars that are strings.
    (inside::GROUP, "primvars:groom_group_cards_id", "int"),
    (inside::CLUMP, "primvars:groom_clumpid", "int"),
    // What Blender keeps where hair sits on a mesh, and what Unreal does.
    (inside::ROOT_UV, "primvars:surface_uv_coordinate", "texCoord2f"),
    (inside::ROOT_UV, "primvars:groom_root_uv", "float2"),
    (inside::COLOUR, "primvars:groom_color", "float3"),
    (inside::COLOUR, "primvars:displayColor", "color3f"),
    // A direction, which turns with the stage.
    (inside::DIRECTOR, "primvars:frisure:d1", "vector3f"),
];

/// Name inside of three values, and the primvars of one value each that repeat them, ending in 0, 1, 2: Blender 5.0
/// reads zeros where an integer primvar has an `elementSize`, and its nodes have no attribute of three integers.
pub(super) const SINGLES: [(&str, &str); 2] = [
    (inside::CLOSEST_GUIDES, "primvars:groom_closest_guide_"),
    (inside::GUIDE_WEIGHTS, "primvars:groom_guide_weight_"),
];

/// 1 on guides, 0 on hairs.
pub(super) const IS_GUIDE: &str = "primvars:groom_guide";

/// Pigments of all hair; their unit is that of the scene's `look`.
pub(super) const PIGMENTS: [&str; 2] =
    ["primvars:frisure:eumelanin", "primvars:frisure:pheomelanin"];

/// Texture coordinates of the head, at the corners of its faces.
pub(super) const TEXTURE: &str = "primvars:st";

/// Positions of the head's vertices before anything moves them.
pub(super) const REST_POSITION: &str = "primvars:rest_position";
