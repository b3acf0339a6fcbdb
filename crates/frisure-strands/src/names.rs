//! The names of the attributes that strands can have, each with its domain and its kind.

/// Index of the guide that a hair follows most; strand, u32. On guides: their own index.
pub const GUIDE: &str = "guide";
/// Indices of the three guides that a hair follows most, the first first; strand, 3 × u32.
pub const CLOSEST_GUIDES: &str = "closest_guides";
/// How much it follows each of [`CLOSEST_GUIDES`]: together 1; strand, 3 × f32.
pub const GUIDE_WEIGHTS: &str = "guide_weights";
/// Number of the hair in the whole head, from 0; strand, u32.
pub const ID: &str = "id";
/// Part of the scalp: 0 fringe, 1 top, 2 crown, 3 sides, 4 back, 5 nape; strand, u32.
pub const GROUP: &str = "group";
/// Number of its wisp (clump), from 0; strand, u32.
pub const CLUMP: &str = "clump";
/// Texture coordinates of the head beneath its root; strand, 2 × f32.
pub const ROOT_UV: &str = "root_uv";
/// Colour (linear, primaries of sRGB); strand or point, 3 × f32.
pub const COLOUR: &str = "color";
/// Water, from 0 (dry) to 1 (soaked); point, f32.
pub const WETNESS: &str = "wetness";
/// Semi-axis a of the section over semi-axis b; strand, f32.
pub const AXIS_RATIO: &str = "axis_ratio";
/// Director along semi-axis a, a unit vector; point, 3 × f32.
pub const DIRECTOR: &str = "d1";
/// Natural curvatures about d1 and d2 and natural twist (rad/m); point, 3 × f32.
pub const NATURAL_STRAIN: &str = "natural_strain";
