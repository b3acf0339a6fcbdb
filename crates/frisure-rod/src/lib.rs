//! One clamped–free Kirchhoff rod: numbers in, equilibrium shape out.
//!
//! A hair is a thin elastic rod, clamped in the scalp at one end and free at the other. It bends
//! about the two axes of its elliptical section, twists about its own, and neither stretches nor
//! shears. Its natural shape may be a curl. Given its length, section, material, natural strain and
//! root, this crate computes the shape in which it hangs, a certificate of its stability and an estimate of its error.
//!
//! ```
//! use frisure_rod::{
//!     Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Load, Root, Section, Stability,
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
//!     load: Load::down(9.81),
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
//! - The energy is a sum of [`potential`]s: elastic energy, weight, and those of the caller, such as
//!   contact, each with its gradient and Hessian. [`minimise::Newton`] minimises it: Newton's method
//!   with damping and a line search, in time proportional to the number of elements.
//! - [`Equilibrium`] is the shape, its energies, and a [`Certificate`].
//! - [`batch`] solves thousands of rods at once, side by side in the lanes of SIMD vectors.
//! - [`derivatives`] has the derivatives of an equilibrium by fibre, load and clamp.
//! - [`inverse`] solves the inverse problem: the natural strain of a fibre that hangs in a given shape.
//!
//! | to find | look in |
//! | --- | --- |
//! | elastic energy, its gradient and Hessian | `potential/elastic.rs`; in lanes `batch/elimination.rs` |
//! | a lock whose fibres stick and slip (Huber on the strain) | `potential/yielding.rs` |
//! | gradient of the whole energy (adjoint sweep) | `minimise/linearise.rs` |
//! | Hessian, its factorisation (Riccati sweep, LDLᵀ) | `minimise/riccati.rs`, `minimise/block.rs` |
//! | damping (Levenberg–Marquardt), line search, saddle points | `minimise/newton.rs`; in lanes `batch/newton.rs` |
//! | Hessian as an operator: products, solutions | `minimise/second_variation.rs` |
//! | stability, smallest eigenvalue | `minimise/certificate.rs` |
//! | gravity's branch, refinement, Richardson extrapolation | `equilibrium/` |
//! | contact of rods in a batch | `batch/contact.rs`, `batch/contact_sweep.rs` |
//!
//! SI units, z up, right-handed; frames are `[d1 d2 t]` in columns. Everything is deterministic: no
//! clocks, no threads, no hidden randomness. docs/theory.md has the equations and their sources.
//!
//! # What it does not do
//!
//! - No motion: shapes at rest only. No plasticity of the fibre, no hysteresis of humidity; friction inside a lock of fibres is a
//!   [`potential::Yielding`], other friction a potential of the caller.
//! - A rod has no contact with itself or other rods; any contact is a potential of the caller, twice
//!   differentiable except at kinks.
//! - The root is clamped and the tip is free; no other ends.
//! - The section is the same all along. The natural strain may vary, linearly between knots.
//! - Where several equilibria exist it follows gravity's branch, or searches from random starts; it
//!   does not enumerate them all, and no method proves the lowest.
//! - Beyond hair (Γ above 1e5, or dozens of turns with one stiffness many times the other) an
//!   equilibrium takes seconds instead of a millisecond. Its certificate is still valid.

#![forbid(unsafe_code)]

pub mod batch;
mod bishop;
mod centre_line;
mod chain;
pub mod derivatives;
mod element;
mod equilibrium;
mod error;
pub mod inverse;
mod load;
mod material;
pub mod minimise;
pub mod potential;
mod random;
mod resolution;
mod rod;
mod rotation;
mod section;
mod strain;
mod stumpff;
mod unresolved;

pub use bishop::{bending, twist_free_frames};
pub use centre_line::{Node, centre_line};
pub use chain::{Chain, Shape};
pub use equilibrium::{
    AccuracyStatus, Branch, Certificate, Equilibrium, Options, equilibrium, equilibrium_from,
};
pub use error::InvalidQuantity;
pub use load::Load;
pub use material::Material;
pub use minimise::{Energy, Stability};
pub use random::SplitMix64;
pub use resolution::{ElementKind, MAX_ELEMENTS, Resolution};
pub use rod::{Rod, RodSpec, Root};
pub use section::{Section, TorsionConstant};
pub use strain::{NaturalStrain, StrainProfile};
