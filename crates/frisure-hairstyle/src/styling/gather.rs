//! Hair gathered to one place: each wisp tight around the head to its place in a round bundle.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::error::StyleError;
use super::settle::{Act, DraftRest};
use super::taut::taut_length;
use crate::equilibrium::Effort;
use crate::hairstyle::{Fastener, Grip, Hairstyle, Styling};
use crate::head::Head;
use crate::parallel;

/// Fraction of the cross section in a bundle that is hair. Chosen: hexagonal packing of round fibres has 0.91, a tie does not
/// order them.
pub(super) const PACKING: f64 = 0.7;

/// Hair that is longer than the tight way to the bundle by this share lies on the head without being stretched. Chosen.
const SLACK: f64 = 0.004;

/// Height (m) at which gathered hair passes over the skin. Chosen.
const LYING: f64 = 2e-3;

/// Shortest tail (m) beyond the bundle that is held. Chosen: the width of an elastic.
const SHORTEST_TAIL: f64 = 0.01;

/// Farthest (m) that hair may be from its place in the bundle. Chosen: within the bundle.
const REACHED: f64 = 0.01;

/// Shortest hair (m) between a root and the bundle: what is rooted beneath it is bent no sharper. Chosen.
const SHORTEST: f64 = 0.015;

/// Where hair is gathered.
pub(super) struct Gathering<'a> {
    /// The middle (m) of a bundle of a radius (m), and the direction (unit) of its axis.
    pub(super) bundle: &'a dyn Fn(f64) -> (DVec3, DVec3),
    /// Where (m) hair is held before it goes to a bundle with this axis: off the head, so that none hangs on an ear or before the neck.
    pub(super) lifted: &'a dyn Fn(DVec3) -> DVec3,
    /// What holds a bundle with this middle (m) and axis (unit).
    pub(super) by: fn(DVec3, DVec3) -> Fastener,
    /// Whether the hand goes on with it before wisps make way for each other.
    pub(super) in_hand: bool,
}

/// Where a ray from far outside towards the middle of the cranium meets the skin (m).
pub(super) fn onto_skin(head: &Head, direction: DVec3) -> DVec3 {
    const MOST: usize = 200;
    let centre = head.landmarks().cranium_centre;
    let mut reach = 2.0 * head.landmarks().cranium_radii.max_element();
    for _ in 0..MOST {
        // Sphere tracing: no skin is nearer than the distance.
        let distance = head.signed_distance().value(centre + direction * reach);
        reach -= distance;
        if distance.abs() < 1e-5 {
            break;
        }
    }
    centre + direction * reach
}

/// Points (m) of a round bundle, about evenly spread: the nearest roots inside, each on the side that it comes from.
struct Bundle {
    middle: DVec3,
    axes: [DVec3; 2],
    radius: f64,
}

impl Bundle {
    fn point(&self, rank: usize, count: usize, root: DVec3) -> DVec3 {
        let reach = self.radius * ((rank as f64 + 0.5) / count as f64).sqrt();
        let [x, y] = self.axes.map(|axis| axis.dot(root - self.middle));
        let angle =
            if x == 0.0 && y == 0.0 { TAU * rank as f64 / count as f64 } else { y.atan2(x) };
        self.middle + (self.axes[0] * angle.cos() + self.axes[1] * angle.sin()) * reach
    }
}

impl Styling {
    /// The same with what holds some wisps taken off.
    fn loosened(&self, wisps: &[usize]) -> Self {
        let mut styling = self.clone();
        for &i in wisps {
            let wisp = &mut styling.wisps[i];
            if wisp.grip.take().is_some() {
                wisp.moved += 1;
            }
        }
        styling
    }

    /// The same with a place of some wisps held by a fastener: their indices, the points (m), and the places along them.
    fn held_at(&self, by: Fastener, places: impl Iterator<Item = (usize, DVec3, f64)>) -> Self {
        let mut styling = self.clone();
        for (i, to, at) in places {
            let wisp = &mut styling.wisps[i];
            wisp.moved += 1;
            wisp.grip = Some(Grip::Clip { at, to, by });
        }
        styling
    }
}

/// Gathers the chosen wisps that are long enough, and holds them there. What catches on an ear or the neck on its way stays out, and hangs
/// free: whatever held it before is taken off.
///
/// # Errors
/// [`StyleError::NothingGathered`], if no wisp is long enough, and [`StyleError::NothingReached`], if each catches on its way.
pub(super) fn gathered(
    act: &Act<'_>,
    chosen: &[bool],
    to: &Gathering<'_>,
) -> Result<Hairstyle, StyleError> {
    let (before, head) = (act.before, act.head);
    // 1. How much hair each takes to the middle of the bundle, tight around the head.
    let hairs = before.grown() / before.guides.len() as f64;
    let area = |i: usize| hairs * before.guides[i].rod.spec().section.area() / PACKING;
    let (middle, _) = (to.bundle)(0.0);
    let chosen: Vec<usize> = (0..chosen.len()).filter(|&i| chosen[i]).collect();
    let loose = before.styling.loosened(&chosen);
    let mut ways: Vec<(usize, f64)> = parallel::map_slice(&chosen, |&i| {
        (i, taut_length(head, before.guides[i].root.position, middle, LYING))
    });
    let needed_and_has = |&(i, way): &(usize, f64)| {
        (way * (1.0 + SLACK) + SHORTEST_TAIL, before.guides[i].rod.length())
    };
    let missing = |(needed, has): (f64, f64)| needed - has;
    let lengths = ways.iter().map(needed_and_has);
    let nearest = lengths.min_by(|a, b| missing(*a).total_cmp(&missing(*b)));
    ways.retain(|way| missing(needed_and_has(way)) <= 0.0);
    if ways.is_empty() {
        let (needed, length) = nearest.unwrap_or_default();
        return Err(StyleError::NothingGathered { needed, length });
    }
    // 2. Where in the bundle each lies: the nearest inside.
    ways.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let radius = (ways.iter().map(|(i, _)| area(*i)).sum::<f64>() / PI).sqrt();
    let (middle, axis) = (to.bundle)(radius);
    let across = axis.any_orthonormal_vector();
    let bundle = Bundle { middle, axes: [across, axis.cross(across)], radius };
    let places: Vec<(usize, DVec3, f64)> = parallel::map(ways.len(), |rank| {
        let (i, _) = ways[rank];
        let root = before.guides[i].root.position;
        let to = bundle.point(rank, ways.len(), root);
        let way = taut_length(head, root, to, LYING).max(SHORTEST) * (1.0 + SLACK);
        (i, to, (way / before.guides[i].rod.length()).min(1.0))
    });
    // 3. Lifted off the head first, then held there.
    let (lifted, by) = ((to.lifted)(axis), (to.by)(middle, axis));
    let alone = Effort { sweeps: 0, ..Effort::FULL };
    let hand = Act { draft: Some(DraftRest { effort: alone, stride: 1, like: None }), ..*act };
    let up = places.iter().map(|&(i, _, at)| (i, lifted, at));
    let in_hand = hand.with(loose.held_at(by, up))?;
    // 4. Hair that catches on its way stays out, rather than being held half-way.
    let tried = hand.on(&in_hand).with(loose.held_at(by, places.iter().copied()))?;
    let reached = |&(i, to, at): &(usize, DVec3, f64)| {
        let rest = &tried.rest.guides[i];
        rest.at(&rest.chain(), at).0.distance(to) <= REACHED
    };
    let long_enough = places.len();
    let (places, caught): (Vec<_>, Vec<_>) = places.into_iter().partition(reached);
    if places.is_empty() {
        return Err(StyleError::NothingReached { long_enough });
    }
    if to.in_hand && caught.is_empty() {
        return Ok(tried);
    }
    // 5. The rest stays held while wisps make way for each other; what is caught is let go from where it was lifted.
    let mut held = tried;
    for &(i, ..) in &caught {
        held.take_wisp(i, &in_hand);
    }
    let mut styling = held.styling.held_at(by, places.into_iter());
    for (i, ..) in caught {
        styling.wisps[i].clone_from(&loose.wisps[i]);
    }
    let last = if to.in_hand { &hand } else { act };
    last.on(&held).with(styling)
}
