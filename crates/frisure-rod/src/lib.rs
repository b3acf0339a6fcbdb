//! One clamped–free Kirchhoff rod: numbers in, equilibrium shape out.

mod error;
mod material;
mod resolution;
mod section;
mod strain;

pub use error::InvalidQuantity;
pub use material::Material;
pub use resolution::{ElementKind, MAX_ELEMENTS, Resolution};
pub use section::{Section, TorsionConstant};
pub use strain::{NaturalStrain, StrainProfile};
