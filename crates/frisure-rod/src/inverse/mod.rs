//! Inverse statics: the natural strain with which a fibre hangs in a given shape.
//!
//! A groom is modelled as it hangs. Simulated from there it falls a second time, unless its natural shape is the one
//! that gravity bends into it. For a given shape that natural shape follows from the balance of moments,
//!
//! ```text
//! u⁰ = u − K⁻¹ Rᵀ M,
//! ```
//!
//! with u the strain of the shape, R its material frames, M the moment of everything beyond (Derouet-Jourdan,
//! Bertails-Descoubes & Thollot 2010, *Stable inverse dynamic curves*, §5, for the super-helix; docs/theory.md, "Inverse
//! statics"). Whether that equilibrium is a minimum is a separate question: a soft hair cannot stand upright, whatever
//! its curl.
//!
//! ```
//! use frisure_rod::{
//!     Material, NaturalStrain, Options, Resolution, RodSpec, Load, Root, Section, TorsionConstant, inverse,
//! };
//! use glam::DVec3;
//!
//! // A quarter of a circle with a radius of 5 cm, bent downwards.
//! let line: Vec<DVec3> = (0..=20)
//!     .map(|i| (f64::from(i) / 20.0 * std::f64::consts::FRAC_PI_2).sin_cos())
//!     .map(|(sin, cos)| DVec3::new(sin, 0.0, cos - 1.0) * 0.05)
//!     .collect();
//! let fibre = RodSpec {
//!     length: 1.0, // length, natural strain and root are those of the line
//!     section: Section::from_diameter(70e-6, 1.4)?,
//!     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
//!     torsion: TorsionConstant::SaintVenant,
//!     natural: NaturalStrain::STRAIGHT,
//!     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
//!     load: Load::down(9.81),
//! };
//! let options = Options { resolution: Resolution::Elements(32), ..Options::default() };
//! let found = inverse::solve(&line, &fibre, &[], &options)?;
//! assert!(found.error < 1e-4, "it hangs within a tenth of a millimetre of the line");
//! assert_eq!(found.stiffness_needed, 1.0); // and is stable there
//! # Ok::<(), frisure_rod::InvalidQuantity>(())
//! ```

mod curve;
mod solve;
mod support;

pub use solve::{Balance, FittedCurve, InverseSolution, solve};
