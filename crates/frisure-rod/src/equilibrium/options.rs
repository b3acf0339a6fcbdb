//! How an equilibrium is searched for.

use crate::resolution::{ElementKind, MAX_ELEMENTS, Resolution};

/// The choice among several equilibria.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Branch {
    /// The one reached from the natural shape as gravity is turned on slowly. Where that branch
    /// loses stability the rod falls off it, as a hair would.
    #[default]
    Gravity,
    /// The lowest of that one and of those found from random shapes.
    Lowest {
        /// Number of random starts.
        starts: u32,
        /// Seed of the random starts.
        seed: u64,
    },
}

/// Options of the search for an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Number of elements, or accuracy.
    pub resolution: Resolution,
    /// Most elements to meet an accuracy with, at least 1 and at most [`MAX_ELEMENTS`].
    pub max_elements: usize,
    /// Curve of the elements.
    pub element: ElementKind,
    /// Which equilibrium.
    pub branch: Branch,
    /// Relative gradient at which a shape is an equilibrium, see [`crate::minimise::Problem::gradient_norm`].
    pub tolerance: f64,
    /// Most iterations at each division of the rod; a quarter of it at each step of gravity.
    pub max_iterations: usize,
    /// Farthest (m) that a node moves in an iteration, see [`crate::minimise::Newton::longest_step`]; infinite by default.
    pub longest_step: f64,
    /// Whether to estimate the error for a given number of elements, by doubling them.
    pub estimate_error: bool,
    /// Whether to compute the smallest eigenvalue of the second variation. Stability is known
    /// without it.
    pub eigenvalue: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            // 0.1 mm, about the diameter of a hair (m). Chosen.
            resolution: Resolution::Accuracy(1e-4),
            max_elements: MAX_ELEMENTS,
            element: ElementKind::Auto,
            branch: Branch::Gravity,
            // Chosen: Newton's method converges quadratically there, so a looser tolerance saves little.
            tolerance: 1e-10,
            // Chosen: far above what hair takes; a bound for rods far outside of it.
            max_iterations: 500,
            longest_step: f64::INFINITY,
            estimate_error: true,
            eigenvalue: true,
        }
    }
}
