//! Where gravity's branch forks: docs/theory.md, "Which equilibrium".

use super::free_turn::turns_freely;
use super::richardson::largest_gap;
use crate::chain::{Chain, Shape};
use crate::minimise::{Minimum, Newton, Problem, Stability};

/// Distance of two lines over the length, below which they are on the same side of a fork. Chosen: just beyond a fork the two sides are
/// near each other.
const SAME_SIDE: f64 = 1e-4;

/// Relative difference below which two energies are alike. Chosen: above rounding.
const SAME_ENERGY: f64 = 1e-9;

/// Part by which the sides of a fork are not as far from where it forks. Chosen: forks of curls that are turned out of their plane by up to
/// 0.01 rad differ by less than a hundredth, minima of another kind by a fifth and more.
const AS_FAR: f64 = 0.1;

/// Whether the second variation at a shape is not positive at a part of the weight: on a ridge between two minima.
pub(super) fn on_ridge(chain: &Chain<'_>, load: f64, shape: &Shape) -> bool {
    let problem = Problem::with_load(chain, &[], load);
    !Newton::default().newton_step(&problem, shape).positive_definite
}

/// The minimum on the other side of where the way to one began, if there is another. `settle` brings a shape to rest, exactly if asked.
pub(super) fn other_side(
    chain: &Chain<'_>,
    from: &Shape,
    found: &Minimum,
    settle: impl Fn(Shape, bool) -> Minimum,
) -> Option<Minimum> {
    // What turns about its root at no cost has all sides alike.
    if turns_freely(&Problem::new(chain, &[]), &found.shape) {
        return None;
    }
    let (start, end) = (&from.controls, &found.shape.controls);
    let mirrored = start.iter().zip(end).map(|(a, b)| *a * 2.0 - *b).collect();
    let mut other = settle(chain.shape(mirrored), false);
    let same = |a: &Minimum, b: &Minimum| {
        let gap = largest_gap(&a.shape.positions, &b.shape.positions);
        gap <= SAME_SIDE * chain.rod().length()
    };
    // A minimum that is farther off than the one that was found, or nearer, is no other side of a fork.
    let alike = |a: &Minimum, b: &Minimum| {
        let [near, far] = [a, b].map(|m| largest_gap(&m.shape.positions, &from.positions));
        (near - far).abs() <= AS_FAR * near
    };
    let stable = other.stability == Stability::Stable;
    if same(&other, found) || !stable || !alike(found, &other) {
        return None;
    }
    // What is far from exact may differ and be the same.
    let iterations = other.iterations;
    other = settle(other.shape, true);
    other.iterations += iterations;
    let exact = settle(found.shape.clone(), true);
    (!same(&other, &exact) && alike(&exact, &other)).then_some(other)
}

/// The lower one of the two sides of a fork: a small imperfection makes the side lower to which the branch goes on. Of two alike, the
/// one whose tip is farther along the root's directors.
pub(super) fn lower_side(chain: &Chain<'_>, load: f64, found: Minimum, other: Minimum) -> Minimum {
    let problem = Problem::with_load(chain, &[], load);
    let [here, there] = [&found, &other].map(|m| problem.energy(&m.shape).total());
    let alike = (here - there).abs() <= SAME_ENERGY * here.abs();
    let better =
        if alike { side(chain, &other.shape) > side(chain, &found.shape) } else { there < here };
    if better { other } else { found }
}

/// Where the tip of a shape is (m) along the first director of the root and half of the second: mirror images are told apart by it.
fn side(chain: &Chain<'_>, shape: &Shape) -> f64 {
    let root = chain.rod().root();
    let frame = root.frame();
    let tip = shape.positions[shape.positions.len() - 1] - root.position();
    tip.dot(frame.x_axis) + 0.5 * tip.dot(frame.y_axis)
}
