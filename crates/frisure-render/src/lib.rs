//! Strands to picture, on the CPU.
//!
//! A [`Scene`] holds what a picture shows: strands and, if there is one, the surface they grow on, with a camera,
//! lights and materials ([`frisure_look`]). [`preview::render`] draws it in a few seconds, by projection: every hair
//! is a line of its true width, shaded by one bounce of light and by shadows from density maps. [`trace::render`]
//! path-traces it in minutes; [`accel`] intersects its rays with hair and head. No file is written: an [`Image`]
//! holds scene-linear light, and [`Image::to_srgb8`] converts it for a display.
//!
//! Lengths are metres, angles radians, z is up, the face looks towards −y; colours are linear sRGB.

#![forbid(unsafe_code)]

pub mod accel;
mod complexion;
mod film;
mod hash;
pub mod maps;
mod noise;
mod picture;
mod pigment;
pub mod preview;
mod scene;
pub mod trace;

pub use complexion::{Material, SKIN_ROUGHNESS, accessory_material, material};
pub use film::{Image, MAX_SIZE};
pub use picture::PictureSpec;
pub use pigment::strand_colours;
pub use scene::{Scene, all_hair, facial_hairs, framed_bounds, head_centre};
