//! Light scattering by one hair fibre, as pure functions of angles and of absorption.
//!
//! [`scattering`] holds the hair BSDF of the final picture ([`scattering::HairBsdf`]), for a fibre of elliptical
//! section. The rest is for previews: [`fibre_energy`] is the energy that a fibre reflects (R), transmits (TT) and
//! returns after one internal reflection (TRT); [`Angles`] measures directions from the fibre, [`lobes`] gives the
//! angular distribution of the three, and [`kajiya_kay`] the diffuse term.
//!
//! Colours are linear sRGB in `f32` ([`glam::Vec3`]); directions are unit vectors that point *away*
//! from the fibre, towards the light and towards the eye; tangents point from root to tip. Nothing
//! here knows of strands or of pictures.

#![forbid(unsafe_code)]

mod fibre;
pub mod kajiya_kay;
mod lobes;
pub mod scattering;

pub use fibre::{FibreEnergy, HAIR_INDEX, fibre_energy, fresnel};
pub use lobes::{Angles, LobeShape, Lobes, lobes};
