//! Solutions of the boundary-value problem.

use glam::{DMat3, DVec3};

use super::hanging::{Hanging, NoSolution, Nodes, POINTS};
use super::{morse, shooting};
use crate::extremes::largest;

impl Hanging {
    /// The stable equilibrium reached from the natural shape as the weight increases.
    ///
    /// # Errors
    /// [`NoSolution`], where that branch ends, loses its stability, or cannot be followed.
    pub fn solve(&self) -> Result<Solution, NoSolution> {
        shooting::follow(self, true).map(|nodes| Solution { rod: self.clone(), nodes })
    }

    /// The equilibrium reached in the same way, stable or not; a mirror-symmetric rod stays symmetric.
    ///
    /// # Errors
    /// [`NoSolution`], where that branch ends or cannot be followed.
    pub fn solve_symmetric(&self) -> Result<Solution, NoSolution> {
        shooting::follow(self, false).map(|nodes| Solution { rod: self.clone(), nodes })
    }

    /// The solution reached from a straight rod that hangs from a root that points straight down, as its natural strain
    /// increases.
    ///
    /// # Errors
    /// [`NoSolution`], where that branch ends or cannot be followed.
    pub fn solve_curled(&self) -> Result<Solution, NoSolution> {
        shooting::curl(self).map(|nodes| Solution { rod: self.clone(), nodes })
    }

    /// The solution next to a given line, a function from arc length over length to the
    /// frame: Newton's method on the equations, which do not depend on the start.
    ///
    /// # Errors
    /// [`NoSolution`], where Newton's method finds none from there.
    pub fn solve_near(&self, frame: impl Fn(f64) -> DMat3) -> Result<Solution, NoSolution> {
        let start = shooting::of_frames(self, frame);
        shooting::near(self, start).map(|nodes| Solution { rod: self.clone(), nodes })
    }
}

/// A solution of the boundary-value problem.
#[derive(Clone, Debug)]
pub struct Solution {
    pub(super) rod: Hanging,
    pub(super) nodes: Nodes,
}

impl Solution {
    /// Position over the length, relative to the root, and frame at evenly spaced arc lengths, the root's first:
    /// at more than [`POINTS`].
    #[must_use]
    pub fn line(&self) -> Vec<(DVec3, DMat3)> {
        let pieces = self.nodes.len() - 1;
        shooting::line(&self.rod, &self.nodes, POINTS.div_ceil(pieces))
    }

    /// Position of the tip relative to the root (m).
    #[must_use]
    pub fn tip(&self) -> DVec3 {
        self.line().last().map_or(DVec3::ZERO, |p| p.0 * self.rod.length)
    }

    /// Largest distance (in lengths) of a line, given as a function of arc length over length to a position
    /// relative to the root in lengths.
    #[must_use]
    pub fn distance(&self, line: impl Fn(f64) -> DVec3) -> f64 {
        let points = self.line();
        let last = (points.len() - 1) as f64;
        let gap = |(i, p): (usize, &(DVec3, DMat3))| p.0.distance(line(i as f64 / last));
        largest(points.iter().enumerate().map(gap))
    }

    /// The number of independent directions in which the energy decreases: 0 for a minimum.
    #[must_use]
    pub fn index(&self) -> usize {
        morse::index(&self.rod, &self.nodes)
    }

    /// Whether the solution is a minimum of the energy.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.index() == 0
    }
}
