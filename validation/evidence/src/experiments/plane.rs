//! Where a rod that could stay in a plane leaves it.

use frisure::rod::{ElementKind, equilibrium};
use glam::DVec3;

use crate::Stopped;
use crate::extremes::largest;
use crate::reference::Hanging;
use crate::rods::{Bar, LENGTH, elements};

/// Whether the equilibrium in the plane is unstable, by the boundary-value problem.
pub(super) fn reference_leaves(bar: &Bar) -> Result<bool, Stopped> {
    Ok(Hanging::new(&bar.spec()?).solve_symmetric()?.index() > 0)
}

/// The same of a rod that was given its natural strain as it hung; where that branch has ended, it has been
/// left.
pub(super) fn hook_leaves(bar: &Bar) -> Result<bool, Stopped> {
    Ok(Hanging::new(&bar.spec()?).solve_curled().map_or(true, |hook| hook.index() > 0))
}

/// Whether frisure finds it out of the plane with that normal.
pub(super) fn frisure_leaves(bar: &Bar, normal: DVec3, count: usize) -> Result<bool, Stopped> {
    let found = equilibrium(&bar.rod()?, &[], &elements(count, ElementKind::Helix));
    let away = largest(found.shape.positions.iter().map(|p| p.dot(normal).abs()));
    match away.is_nan() {
        true => Err(Stopped::Other(format!("no shape of {bar:?}"))),
        false => Ok(away > 1e-4 * LENGTH),
    }
}

/// Where a question's answer turns from no, at `low`, to yes, at `high`.
pub(super) fn bisect(
    mut low: f64,
    mut high: f64,
    steps: usize,
    yes: impl Fn(f64) -> Result<bool, Stopped>,
) -> Result<f64, Stopped> {
    for _ in 0..steps {
        let middle = 0.5 * (low + high);
        if yes(middle)? {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(0.5 * (low + high))
}

/// The first place, in steps of a factor, where the answer is yes, made exact by so many halvings; none before
/// `most`.
pub(super) fn first(
    from: f64,
    factor: f64,
    (most, halvings): (f64, usize),
    yes: impl Fn(f64) -> Result<bool, Stopped>,
) -> Result<Option<f64>, Stopped> {
    let mut low = from;
    while low < most {
        if yes(factor * low)? {
            return bisect(low, factor * low, halvings, yes).map(Some);
        }
        low *= factor;
    }
    Ok(None)
}

/// Where frisure's answer turns, extrapolated from `count` and twice as many elements: sought within 6 % of a
/// guess.
pub(super) fn frisure_threshold(
    guess: f64,
    normal: DVec3,
    count: usize,
    bar: impl Fn(f64) -> Bar,
) -> Result<f64, Stopped> {
    let at = |count| {
        let leaves = |x: f64| frisure_leaves(&bar(x), normal, count);
        let (low, high) = (0.94 * guess, 1.06 * guess);
        // An answer that is the same at both ends is no threshold.
        if leaves(low)? || !leaves(high)? {
            return Ok(f64::NAN);
        }
        bisect(low, high, 20, leaves)
    };
    let (coarse, fine): (f64, f64) = (at(count)?, at(2 * count)?);
    Ok((4.0 * fine - coarse) / 3.0)
}
