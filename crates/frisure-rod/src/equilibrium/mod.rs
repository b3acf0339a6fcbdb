//! The equilibrium of a rod: a minimum of its energy, with a certificate.
//!
//! The files in the order of the computation: `options`, `search` (gravity's branch, refinement), `fork` (the side to which the branch goes on), `warm_start` (from the
//! shape of another rod), `richardson` (extrapolation and the estimate of the error), `solution`.

mod fork;
mod free_turn;
mod options;
mod richardson;
mod search;
mod solution;
mod stability;
mod warm_start;

pub use options::{Branch, Options};
pub use search::{equilibrium, equilibrium_from};
pub use solution::{AccuracyStatus, Certificate, Equilibrium};
