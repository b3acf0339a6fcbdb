//! One clamped–free Kirchhoff rod: numbers in, equilibrium shape out.
//!
//! A hair is a thin elastic rod, clamped in the scalp at one end and free at the other. It bends
//! about the two axes of its elliptical section, twists about its own, and neither stretches nor
//! shears. Its natural shape may be a curl. Given its length, section, material, natural strain and
//! root, this crate finds the shape in which it hangs, and says how far that answer can be trusted.
//!
//! ```
//! use frisure_rod::{
//!     Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Section, Stability,
//!     TorsionConstant, equilibrium,
//! };
//! use glam::DVec3;
//!
//! // A curl of 15 cm: 5 mm in radius, 1 cm of advance a turn, leaving the scalp sideways.
//! let rod = Rod::new(RodSpec {
//!     length: 0.15,
//!     section: Section::from_diameter(70e-6, 1.4)?, // 70 µm, its axes as 1.4 to 1
//!     material: Material::new(3.9e9, 0.9e9, 1300.0)?, // E and μ (Pa), density (kg/m³)
//!     torsion: TorsionConstant::SaintVenant,
//!     natural: NaturalStrain::helix(0.005, 0.010)?,
//!     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
//!     gravity: 9.81,
//! })?;
//!
//! // The whole centre line within a tenth of a millimetre of the exact equilibrium.
//! let options = Options { resolution: Resolution::Accuracy(1e-4), ..Options::default() };
//! let hair = equilibrium(&rod, &[], &options);
//!
//! // A minimum of the energy, not a saddle; and the error that is left.
//! assert_eq!(hair.certificate.stability, Stability::Stable);
//! assert!(hair.error_estimate.unwrap() < 1e-4);
//!
//! // It hangs: z is up, and the tip is below the root.
//! assert!(hair.tip().z < -0.03);
//! let line = hair.centre_line(200); // 200 points from root to tip, to draw
//! assert_eq!(line.len(), 200);
//! # Ok::<(), frisure_rod::InvalidQuantity>(())
//! ```
//!
//! # The parts, in the order of the computation
//!
//! - [`Section`] and [`Material`] give stiffness and weight; [`NaturalStrain`] the shape at rest;
//!   [`Root`] the clamp. [`Rod`] is all of them, checked: after it, computing cannot fail.
//! - [`equilibrium()`] divides the rod into elements ([`Chain`], [`ElementKind`]), follows the branch
//!   of equilibria while gravity is turned on ([`Branch`]), and refines until the [`Resolution`] is
//!   met. [`equilibrium_from`] starts from the shape of another rod instead: hair that was cut, or
//!   grew, or got wet.
//! - The energy is a sum of [`potential`]s: bending and twist, weight, and whatever the caller
//!   adds, such as contact. They are minimised by [`minimise::Newton`], a Newton method in time
//!   proportional to the number of elements.
//! - [`Equilibrium`] is the shape, its energies, and a [`Certificate`].
//! - [`batch`] brings thousands of rods to rest at once, side by side in the lanes of vectors.
//! - [`inverse`] is the other way round: the fibre that rests in a given shape.
//!
//! SI units, z up, right-handed; frames are `[d1 d2 t]` in columns. Everything is deterministic: no
//! clocks, no threads, no hidden randomness. docs/theory.md has the equations and their sources.
//!
//! # What it does not do
//!
//! - No motion: shapes at rest only. No friction, plasticity or humidity with a memory.
//! - A rod does not touch itself or other rods; contact with anything is a potential that the caller
//!   brings, and must be twice differentiable but for kinks.
//! - The root is clamped and the tip is free; no other ends.
//! - The section is the same all along. The natural strain may vary, linearly between knots.
//! - Where several equilibria exist it follows gravity's branch, or searches from random starts; it
//!   does not enumerate them all, and no method proves the lowest.
//! - Beyond hair (Γ above 1e5, or dozens of turns with one stiffness many times the other) answers
//!   take seconds instead of a millisecond. They still say what they are.

pub mod batch;
mod chain;
mod element;
mod equilibrium;
mod error;
pub mod inverse;
mod line;
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
pub use line::{Node, line};
pub use material::Material;
pub use minimise::{Energy, Stability};
pub use resolution::{ElementKind, MAX_ELEMENTS, Resolution};
pub use rod::{Rod, RodSpec, Root};
pub use section::{Section, TorsionConstant};
pub use strain::{NaturalStrain, StrainProfile};
