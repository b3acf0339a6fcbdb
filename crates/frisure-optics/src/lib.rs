//! Light and one fibre: what a hair does to a ray, as pure functions of angles and of melanin.
//!
//! In the order of understanding: [`absorption`] turns melanin into a coefficient, [`fibre_energy`]
//! says how much of the light that meets a clean cylinder leaves by reflection, straight through,
//! or after one internal reflection; [`Angles`] measures directions from the fibre, [`lobes`] says
//! where those three shares go, and [`kajiya_kay`] is the older and simpler model that still gives
//! the best *diffuse* light of a preview. [`scattering`] is the model of the final picture, for a fibre of
//! elliptical section.
//!
//! Colours are linear sRGB in `f32` ([`glam::Vec3`]); directions are unit vectors that point *away*
//! from the fibre, towards the light and towards the eye; tangents point from root to tip. Nothing
//! here knows of strands or of pictures.

mod absorption;
mod fibre;
pub mod kajiya_kay;
mod lobes;
pub mod scattering;
mod shade;

pub use absorption::{Melanin, absorption, absorption_of_colour, apparent_colour};
pub use fibre::{FibreEnergy, HAIR_INDEX, fibre_energy, fresnel};
pub use lobes::{Angles, LobeShape, Lobes, lobes};
pub use shade::{SHADES, Shade};
