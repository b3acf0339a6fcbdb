//! From measured hair to the natural strain and the stiffness of its fibres, with error bars.
//!
//! A fibre is clamped at one end and hangs; its line is digitised, once or in several poses. The line follows from the fibre's natural strain and from
//! its stiffness over its weight, which this crate finds by Gauss–Newton with Levenberg's and Marquardt's damping: the rods of many fibres are solved and
//! differentiated side by side ([`frisure_rod::batch`]). The root of each pose is unknown, too, and is fitted along.
//!
//! Error bars are those of the Fisher information with what is known before: the inverse of the Hessian of half the square of the distance, in units of the noise. It
//! also says what one pose cannot tell apart ([`Fit::blind`], [`Fit::statements`]). docs/fit.md, docs/theory.md, "Fits of measured fibres".
//!
//! ```
//! use frisure_fit::{Fibre, Known, Options, Pose, fit};
//! use frisure_rod::{
//!     Load, Material, NaturalStrain, Resolution, Rod, RodSpec, Root, Section, TorsionConstant,
//!     equilibrium,
//! };
//! use glam::DVec3;
//!
//! // A curl of 12 cm, 6 mm in radius and 15 mm in pitch, of 80 µm.
//! let section = Section::circular(40e-6)?;
//! let rod = Rod::new(RodSpec {
//!     length: 0.12,
//!     section,
//!     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
//!     torsion: TorsionConstant::SaintVenant,
//!     natural: NaturalStrain::helix(0.006, 0.015)?,
//!     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
//!     load: Load::down(9.81),
//! })?;
//! let options = frisure_rod::Options { resolution: Resolution::Accuracy(1e-6), ..Default::default() };
//! let line = equilibrium(&rod, &[], &options).centre_line(60);
//! let arc = (0..60).map(|i| 0.12 * f64::from(i) / 59.0).collect();
//!
//! let pose = Pose::new(line, Some(arc), DVec3::NEG_Z * 9.81, 0)?;
//! let fibre = Fibre::new(vec![pose], None)?;
//! let options = Options { noise: Some(1e-5), ..Options::default() };
//! let found = fit(&[fibre], &[Known::default()], &options, &())?.remove(0);
//! assert!((found.curl_radius.value / 0.006 - 1.0).abs() < 0.01);
//! assert!((found.curl_pitch.value / 0.015 - 1.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The files in the order of the computation: `pose` (what was measured), `known` (what is known before), `start` (first numbers from the geometry),
//! `unknowns` (numbers to rods), `observe` (points beside rods), `solve` (the iteration), `fit` (numbers with error bars), `blind` (what is not told),
//! `report` (text, JSON and HTML).

#![forbid(unsafe_code)]

mod blind;
mod dense;
mod fit;
mod known;
mod observe;
mod pose;
mod report;
mod solve;
mod start;
mod table;
mod unknowns;

pub use blind::{Blind, Quantity};
pub use fit::{Fit, FitStatus, fit};
pub use known::{Estimate, Known, KnownError, MOST_KNOTS, Options, STANDARD_GRAVITY};
pub use pose::{FEWEST_POINTS, Fibre, Pose, PoseError};
pub use report::{Entry, html, json};
pub use table::{NamedFibre, TableError, read_table};
