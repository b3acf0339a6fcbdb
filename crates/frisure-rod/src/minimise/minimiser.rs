//! The interface of a minimiser: when it stops and what it returns.

use super::problem::Problem;
use crate::chain::Shape;

/// When a minimiser stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoppingCriteria {
    /// Relative gradient ([`Problem::gradient_norm`]) to reach.
    pub tolerance: f64,
    /// Most iterations.
    pub max_iterations: usize,
}

/// Whether a shape is a minimum of the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stability {
    /// A minimum: the gradient vanishes and the second variation is positive, or zero but for rounding where the rod
    /// may turn freely.
    Stable,
    /// A saddle point: the gradient vanishes, but the second variation has a negative eigenvalue.
    Saddle,
    /// The gradient vanishes, but the smallest eigenvalue is zero within its error: the divisions of the rod that were
    /// computed cannot tell a minimum from a saddle point. Only [`crate::equilibrium()`] says so, which compares divisions.
    Undecided,
    /// The gradient does not vanish.
    NotConverged,
}

/// The result of a minimiser.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The shape.
    pub shape: Shape,
    /// Relative gradient there.
    pub gradient_norm: f64,
    /// Iterations taken.
    pub iterations: usize,
    /// Whether the shape is a minimum.
    pub stability: Stability,
    /// Whether the pivots show that the smallest eigenvalue ([`Problem::min_eigenvalue`]) is above [`CLEAR_EIGENVALUE`],
    /// so far from zero that a finer division has the same stability.
    pub clear: bool,
    /// Whether the second variation was not positive at the start, or at a saddle on the way down: the start may be on a ridge between two
    /// minima. `false` from a minimiser that does not look.
    pub crossed: bool,
}

/// An eigenvalue above which stability is beyond doubt, on the scale of [`Problem::min_eigenvalue`]. On 400 random hairs
/// the last two divisions of an accuracy of 1e-3 of the length differ by 0.05 at most, and four have an eigenvalue below it.
pub const CLEAR_EIGENVALUE: f64 = 0.1;

/// Finds a minimum of an energy from a given shape. Every accepted step lowers the energy.
pub trait Minimiser {
    /// Minimises the energy from `start`.
    fn minimise(&self, problem: &Problem<'_>, start: Shape, stopping: StoppingCriteria) -> Minimum;
}
