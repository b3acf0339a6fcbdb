//! Hairs in a batch.

use frisure::rod::batch::Batch;
use frisure::rod::{ElementKind, Rod, Stability, equilibrium};
use rayon::prelude::*;

use crate::extremes::largest;
use crate::random;
use crate::rods::elements;
use crate::{Effort, Finding, Limit, Stopped};

/// Compares hairs in a batch, which starts at the natural shape under the whole weight, with the same hairs one by one
/// along gravity's branch, with the same elements.
pub(super) fn add(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let count = effort.pick(300, 4000);
    let spec = |i| random::realistic(&mut random::stream(75, i)).and_then(Rod::new);
    let rods: Vec<Rod> = (0..count).map(spec).collect::<Result<_, _>>()?;
    let batch = Batch { elements: 60, ..Batch::default() };
    let batches = rods.par_chunks(200).map(|rods| (rods, batch.solve(rods)));
    let gaps = batches.flat_map_iter(|(rods, rest)| {
        let each = move |(k, rod): (usize, &Rod)| {
            let alone = equilibrium(rod, &[], &elements(60, ElementKind::Jointed));
            let tip = rest.shape(rod, k).positions[60];
            let stable = rest.rods[k].stability == Stability::Stable;
            (stable, tip.distance(alone.shape.positions[60]) / rod.length())
        };
        rods.iter().enumerate().map(each).collect::<Vec<_>>()
    });
    let gaps: Vec<(bool, f64)> = gaps.collect();
    let stable = gaps.iter().filter(|g| g.0).count();
    let same: Vec<f64> = gaps.iter().map(|g| g.1).filter(|g| *g <= 1e-3).collect();
    let other = count - same.len();
    let worst = largest(same);
    finding.text(format!(
        "In a batch, from the natural shape under the whole weight (60 jointed elements), {stable} of {count} realistic hairs \
         converge to a minimum; {other} of these minima are not on gravity's branch. The tips of the others are within \
         {worst:.0e} of the length."
    ));
    finding.check(
        "share of hairs that converge to a minimum in a batch",
        stable as f64 / count as f64,
        Limit::AtLeast(1.0),
    );
    finding.check(
        "share of hairs that a batch brings to another minimum than that of gravity's branch",
        other as f64 / count as f64,
        Limit::AtMost(0.01),
    );
    Ok(())
}
