//! Many rods at once, side by side in the lanes of SIMD vectors.
//!
//! The elements are those of [`crate::ElementKind::Jointed`], and so are the energy and its minima. Newton's method
//! starts from the natural shape, without following gravity's branch. A rod that does not converge, or converges to a
//! saddle point, goes to [`crate::equilibrium()`].
//!
//! The result of a rod does not depend on the rods that share its vector. Vectors are as wide as the instruction set
//! has them, with fused multiply-add where it has that; between processors with and without, the last digits differ.
//!
//! ```
//! use frisure_rod::batch::Batch;
//! use frisure_rod::{
//!     Material, NaturalStrain, Rod, RodSpec, Load, Root, Section, Stability, TorsionConstant,
//! };
//! use glam::DVec3;
//!
//! // A hundred curls that leave the scalp in all directions of the horizontal.
//! let rods: Vec<Rod> = (0..100)
//!     .map(|i| {
//!         let (sin, cos) = (0.0628 * f64::from(i)).sin_cos();
//!         Rod::new(RodSpec {
//!             length: 0.15,
//!             section: Section::from_diameter(70e-6, 1.4)?,
//!             material: Material::new(3.9e9, 0.9e9, 1300.0)?,
//!             torsion: TorsionConstant::SaintVenant,
//!             natural: NaturalStrain::helix(0.005, 0.010)?,
//!             root: Root::from_tangent(DVec3::ZERO, DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0))?,
//!             load: Load::down(9.81),
//!         })
//!     })
//!     .collect::<Result<_, _>>()?;
//! let found = Batch { elements: 30, ..Batch::default() }.solve(&rods);
//! assert!(found.rods.iter().all(|rod| rod.stability == Stability::Stable));
//! assert!(found.shape(&rods[0], 0).positions[30].z < -0.03); // the tip hangs
//! # Ok::<(), frisure_rod::InvalidQuantity>(())
//! ```
//!
//! The files in the order of the computation: `solver` (options, precision), `newton` (damping, rods through the lanes),
//! `division` (a rod into joints), `weight_lanes` and `contact_lanes` (rods into lanes), `weight_sweep` and
//! `contact_sweep` (backward and forward over the joints), `elimination` (one joint: energy, gradient, Hessian block),
//! `rotation`, `linear`, `lanes` (the numbers). Errors of the division: `error`. Derivatives: `gradient` (rods into lanes)
//! and `adjoint_sweep`; by directions of the parameters, `tangent` and `tangent_sweep`; `eigenvalue`. The shapes of all: `nodes`. One
//! rod by itself: `joint_chain`, `chain_factor`.

mod adjoint_sweep;
pub mod chain_factor;
mod contact;
mod contact_lanes;
mod contact_sweep;
mod contact_term;
mod division;
mod eigenvalue;
mod elimination;
mod error;
mod gradient;
mod joint_chain;
mod lanes;
mod linear;
mod newton;
mod nodes;
mod rod_lanes;
mod rotation;
mod solution;
mod solver;
mod start;
mod tangent;
mod tangent_sweep;
mod transport;
mod weight_lanes;
mod weight_sweep;

#[cfg(test)]
mod agreement;
#[cfg(test)]
mod contact_tests;

pub use contact::{ConfinementTube, Contact, ContactField};
pub use gradient::{BatchGradient, BatchLoss, RodGradient};
pub use joint_chain::JointChain;
pub use solution::{BatchSolution, RodSolution};
pub use solver::{Batch, Precision};
pub use start::{Frames, InitialShape};
pub use tangent::{BatchTangents, Direction, NodeMotion};
