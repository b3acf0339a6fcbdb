//! The start from the shape of another rod at rest.

use glam::DMat3;

use super::solution::Equilibrium;
use crate::chain::{Chain, Shape};

/// The shape of another rod at rest, taken over at equal arc length; what is longer goes on as it
/// would naturally.
pub(super) fn warm_start(chain: &Chain<'_>, previous: &Equilibrium) -> Shape {
    let old = previous.chain();
    // 1. Frames at equal arc length, as far as the other rod reaches.
    // The tolerance lets a rod of the same length count as covered to its tip in spite of rounding.
    let covered = previous.rod.length() * (1.0 + 1e-12);
    let known = chain.arc().iter().take_while(|&&s| s <= covered).count();
    let mut frames: Vec<DMat3> =
        chain.arc()[..known].iter().map(|&s| old.point(&previous.shape, s).1).collect();
    // 2. Beyond it the natural shape.
    for i in known..=chain.len() {
        let g = chain.geometry(i - 1);
        let last = frames[i - 1];
        frames.push(last * g.motion(g.rest()).rotation());
    }
    // 3. A root that was turned turns the whole shape with it.
    let turn = chain.rod().root().frame() * previous.rod.root().frame().transpose();
    for frame in &mut frames {
        *frame = turn * *frame;
    }
    // 4. An element that is where one was turns about as that did.
    let same = |s: f64, t: f64| (s - t).abs() <= 1e-9 * previous.rod.length();
    let near = |i: usize| {
        let (ours, theirs) = (chain.arc(), old.arc());
        let ends = theirs.get(i).zip(theirs.get(i + 1))?;
        let found = same(ours[i], *ends.0) && same(ours[i + 1], *ends.1);
        found.then(|| previous.shape.controls[i])
    };
    chain.shape_through_near(&frames, near)
}
