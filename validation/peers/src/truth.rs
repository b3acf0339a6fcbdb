//! The true shapes, from Kirchhoff's equations as a boundary-value problem, independent of the timed solver.

use frisure::rod::{ElementKind, Options, Resolution, Rod, equilibrium};
use frisure_evidence::reference::{Hanging, Solution};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The true shape of a hair.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct Truth {
    /// Position of the tip (m), the root at the origin.
    pub(crate) tip: [f64; 3],
    /// Arc lengths over the length of the points of the centre line.
    pub(crate) arc: Vec<f64>,
    /// Points of the centre line (m), from root to tip.
    pub(crate) line: Vec<[f64; 3]>,
    /// The branch of the solution.
    pub(crate) reached: Reached,
    /// Whether it is a minimum by Jacobi's condition.
    pub(crate) stable: bool,
}

/// The branch of a true shape.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) enum Reached {
    /// Gravity's branch, stable all the way.
    Branch,
    /// Gravity's branch ends or loses its stability; this is the solution next to frisure's equilibrium.
    Fallen,
}

/// Number of intervals of a line in the output.
const INTERVALS: usize = 24;

/// The true shape, or `None` if the boundary-value problem has no solution.
pub(crate) fn truth(rod: &Rod) -> Option<Truth> {
    let problem = Hanging::new(rod.spec());
    let (solution, reached) = match problem.solve() {
        Ok(solution) => (solution, Reached::Branch),
        Err(_) => (near_frisure(&problem, rod)?, Reached::Fallen),
    };
    let line = solution.line();
    let length = rod.length();
    let last = line.len() - 1;
    let written = (0..=INTERVALS).map(|k| k * last / INTERVALS);
    Some(Truth {
        tip: solution.tip().to_array(),
        arc: written.clone().map(|i| i as f64 / last as f64).collect(),
        line: written.map(|i| (line[i].0 * length).to_array()).collect(),
        reached,
        stable: solution.is_stable(),
    })
}

fn near_frisure(problem: &Hanging, rod: &Rod) -> Option<Solution> {
    let options = Options {
        resolution: Resolution::Accuracy(1e-6 * rod.length()),
        element: ElementKind::Jointed,
        ..Options::default()
    };
    let found = equilibrium(rod, &[], &options);
    let chain = found.chain();
    problem.solve_near(|s| found.at(&chain, s).1).ok()
}

impl Truth {
    pub(crate) fn tip(&self) -> DVec3 {
        self.tip.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hairs;

    /// `helix_ellipse_ratio1.0_k1` of the reference cases of `frisure-rod`, which two other programs computed.
    #[test]
    fn the_one_hair_is_a_reference_case() {
        let tip = truth(&hairs::the_one().unwrap()).expect("a solution").tip();
        let there = DVec3::new(-0.0042029810873664055, 0.01911343484478593, -0.04789805238290382);
        assert!(tip.distance(there) < 1e-11, "{tip}");
    }

    #[test]
    fn the_true_shapes_are_those_of_the_scalar_solver_when_it_is_asked_for_accuracy() {
        let rods = (0..12).map(|k| hairs::turned(3, k).unwrap());
        for rod in rods.chain([hairs::the_one().unwrap()]) {
            let truth = truth(&rod).expect("a solution");
            assert!(truth.stable);
            let options = Options { resolution: Resolution::Accuracy(1e-6), ..Options::default() };
            let found = equilibrium(&rod, &[], &options);
            assert!(found.tip().distance(truth.tip()) < 2e-6, "{} {truth:?}", found.tip());
            let chain = found.chain();
            for (arc, point) in truth.arc.iter().zip(&truth.line) {
                let (there, here) = (DVec3::from_array(*point), found.at(&chain, *arc).0);
                assert!(there.distance(here) < 2e-6, "{there} {here}");
            }
        }
    }
}
