//! Names by which readers of heads know meshes that hold hair.

/// The primvar of such a mesh in a stage.
#[cfg(feature = "usd")]
pub(crate) const PRIMVAR: &str = "primvars:frisure:accessory";

/// The member of the `extras` of a node in glTF whose meshes are such.
pub(crate) const EXTRA: &str = "frisure:accessories";

/// The beginning of the names of such objects in OBJ.
pub(crate) const OBJECT: &str = "accessories/";
