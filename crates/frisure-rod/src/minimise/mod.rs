//! Minimisers of a rod's energy behind one interface.
//!
//! [`Newton`] is the one to use: Newton's method with damping and a line search, in time proportional to the number
//! of elements. [`Lbfgs`] uses no second derivative and is slow: it is the reference solver of the tests.
//!
//! The files in the order of the computation: `problem` (the energy), `linearise` (gradient and Hessian blocks of each
//! element), `riccati` (backward sweep: the Hessian factorised), `rollout` (forward: the step applied), `newton`
//! (damping, line search, saddle points), `certificate` (gradient norm, smallest eigenvalue). [`SecondVariation`] keeps the
//! Hessian as an operator for callers with many right-hand sides.

mod block;
mod certificate;
mod lbfgs;
mod linearise;
mod minimiser;
mod newton;
mod problem;
mod riccati;
mod rollout;
mod second_variation;

pub use lbfgs::Lbfgs;
pub use minimiser::{CLEAR_EIGENVALUE, Minimiser, Minimum, Stability, StoppingCriteria};
pub use newton::{Newton, NewtonStep};
pub use problem::{Energy, Problem};
#[cfg(test)]
pub(crate) use rollout::damped_step;
pub use second_variation::{NodeChanges, SecondVariation, SecondVariationFactor};
