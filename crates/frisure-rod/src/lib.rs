//! One clamped–free Kirchhoff rod: numbers in, equilibrium shape out.

mod chain;
mod element;
mod equilibrium;
mod error;
mod material;
pub mod minimise;
pub mod potential;
mod resolution;
mod rod;
mod rotation;
mod section;
mod strain;
mod stumpff;

pub use chain::{Chain, Shape};
pub use equilibrium::{Branch, Certificate, Equilibrium, Options, equilibrium, equilibrium_from};
pub use error::InvalidQuantity;
pub use material::Material;
pub use minimise::{Energy, Stability};
pub use resolution::{ElementKind, MAX_ELEMENTS, Resolution};
pub use rod::{Rod, RodSpec, Root};
pub use section::{Section, TorsionConstant};
pub use strain::{NaturalStrain, StrainProfile};
