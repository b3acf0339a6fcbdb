//! The vocabulary that every crate of frisure shares: [`Strands`], the curves of a groom with their
//! radii and attributes, and [`Surface`], the triangle mesh they grow on.
//!
//! Lengths are metres, the frame is right-handed with z up; the face of a head looks towards −y and
//! its left is +x. Bulk data are `f32`: at arm's length from the origin that is 30 nm, a thousandth
//! of a hair's diameter. Nothing here knows where strands come from or where they go.

#![forbid(unsafe_code)]

mod accessory;
mod accessory_material;
mod features;
pub mod names;
mod near;
mod resample;
mod simplify;
mod strands;
mod surface;
mod thin;

pub use accessory::AccessoryMesh;
pub use accessory_material::AccessoryMaterial;
pub use features::{Eye, Features, Tint};
pub use resample::Resampled;
pub use strands::{Attribute, AttributeError, AttributeValues, Domain, Strand, Strands};
pub use surface::{Surface, SurfaceError};
pub use thin::Thinned;
