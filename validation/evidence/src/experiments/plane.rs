//! Thresholds at which a rod leaves the plane of its symmetric shape.

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

/// Whether the planar equilibrium is unstable if the natural strain increases on the hanging rod; true where that
/// branch has ended.
pub(super) fn hook_leaves(bar: &Bar) -> Result<bool, Stopped> {
    Ok(Hanging::new(&bar.spec()?).solve_curled().map_or(true, |hook| hook.index() > 0))
}

/// Whether frisure's equilibrium is out of the plane with that normal.
pub(super) fn frisure_leaves(bar: &Bar, normal: DVec3, count: usize) -> Result<bool, Stopped> {
    let found = equilibrium(&bar.rod()?, &[], &elements(count, ElementKind::Helix));
    let away = largest(found.shape.positions.iter().map(|p| p.dot(normal).abs()));
    match away.is_nan() {
        true => Err(Stopped::Other(format!("no shape of {bar:?}"))),
        false => Ok(away > 1e-4 * LENGTH),
    }
}

/// The threshold between `low`, where the answer is no, and `high`, where it is yes.
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

/// The smallest value, in steps of a factor, at which the answer is yes, refined by `halvings` bisections; `None` if
/// there is none up to `most`.
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

/// frisure's threshold, extrapolated from `count` and twice as many elements; the search covers 6 % around a
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
        // If the answer is the same at both ends, there is no threshold between them.
        if leaves(low)? || !leaves(high)? {
            return Ok(f64::NAN);
        }
        bisect(low, high, 20, leaves)
    };
    let (coarse, fine): (f64, f64) = (at(count)?, at(2 * count)?);
    Ok((4.0 * fine - coarse) / 3.0)
}
