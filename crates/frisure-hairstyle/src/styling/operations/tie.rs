//! Hair ties.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rayon::prelude::*;

use super::apply::{Apply, check_point};
use crate::equilibrium::Effort;
use crate::hairstyle::{Grip, Hairstyle, Styling};
use crate::head::Head;
use crate::spec::InvalidSpec;
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::{Act, DraftRest};
use crate::styling::taut::taut_length;

/// Gathers hair at a place with a hair tie: a ponytail. What is too short to reach it stays out.
#[derive(Clone, Debug, PartialEq)]
pub struct Tie {
    /// Which wisps.
    pub selection: Selection,
    /// Where the tie is.
    pub to: TiePlace,
}

/// Where a hair tie is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TiePlace {
    /// High at the back, below the crown.
    High,
    /// In the middle of the back of the head.
    Middle,
    /// Low, above the nape.
    Low,
    /// On the head's left side, behind the ear.
    Left,
    /// On the right.
    Right,
    /// At a point (m, head's frame).
    At(DVec3),
}

impl Default for Tie {
    fn default() -> Self {
        Self { selection: Selection::Everything, to: TiePlace::Middle }
    }
}

/// Fraction of the cross section in a tie that is hair. Chosen: hexagonal packing of round fibres has 0.91, a tie does not
/// order them.
const PACKING: f64 = 0.7;

/// Hair that is longer than the tight way to the tie by this share lies on the head without being stretched. Chosen.
const SLACK: f64 = 0.015;

/// Height (m) at which tied hair passes over the skin, and height (m) of the nearest hair in the tie above it. Chosen.
const LYING: f64 = 2e-3;
const CLEAR: f64 = 4e-3;

/// Shortest tail (m) that a tie holds. Chosen: the width of an elastic.
const SHORTEST_TAIL: f64 = 0.01;

/// Farthest (m) that hair may be from its place in the tie. Chosen: within the bundle.
const REACHED: f64 = 0.01;

/// Shortest hair (m) between a root and the tie: what is rooted beneath the tie is bent no sharper. Chosen.
const SHORTEST: f64 = 0.015;

/// Distance (m) from the middle of the cranium at which hair is held before it is tied. Chosen: clear of head and ears.
const LIFTED: f64 = 0.25;

impl TiePlace {
    /// The direction (unit) from the middle of the cranium.
    fn direction(self, head: &Head) -> DVec3 {
        let land = head.landmarks();
        let back = -land.face;
        let left = DVec3::Z.cross(back);
        let direction = match self {
            Self::High => back + DVec3::Z * 0.75,
            Self::Middle => back + DVec3::Z * 0.05,
            Self::Low => back - DVec3::Z * 0.6,
            Self::Left => back * 0.35 - left - DVec3::Z * 0.45,
            Self::Right => back * 0.35 + left - DVec3::Z * 0.45,
            Self::At(p) => p - land.cranium_centre,
        };
        direction.normalize_or(back)
    }

    /// The middle (m) of a bundle of a radius (m) that is tied there, and the direction (unit) in which it leaves the head.
    fn bundle(self, head: &Head, radius: f64) -> (DVec3, DVec3) {
        let direction = self.direction(head);
        match self {
            Self::At(p) => (p, direction),
            _ => {
                let skin = onto_skin(head, direction);
                let (_, normal) = head.signed_distance().value_gradient(skin);
                let normal = normal.normalize_or(direction);
                (skin + normal * (radius + CLEAR), normal)
            }
        }
    }
}

/// Where a ray from far outside towards the middle of the cranium meets the skin (m).
fn onto_skin(head: &Head, direction: DVec3) -> DVec3 {
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
        let angle = if x == 0.0 && y == 0.0 {
            TAU * rank as f64 / count as f64
        } else {
            y.atan2(x)
        };
        self.middle + (self.axes[0] * angle.cos() + self.axes[1] * angle.sin()) * reach
    }
}

impl Styling {
    /// The same with a place of some wisps held: their indices, the points (m), and the places along them.
    fn tied(&self, places: impl Iterator<Item = (usize, DVec3, f64)>) -> Self {
        let mut styling = self.clone();
        for (i, to, at) in places {
            let wisp = &mut styling.wisps[i];
            wisp.moved += 1;
            wisp.grip = Some(Grip::Clip { at, to });
        }
        styling
    }
}

impl Apply for Tie {
    fn check(&self) -> Result<(), InvalidSpec> {
        match self.to {
            TiePlace::At(p) => check_point("tie.to", p),
            _ => Ok(()),
        }
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let chosen = act.selected(&self.selection)?;
        let (before, head) = (act.before, act.head);
        // 1. How much hair each takes to the middle of the tie, tight around the head.
        let hairs = before.grown() / before.guides.len() as f64;
        let area = |i: usize| hairs * before.guides[i].rod.spec().section.area() / PACKING;
        let (middle, _) = self.to.bundle(head, 0.0);
        let mut ways: Vec<(usize, f64)> = (0..chosen.len())
            .into_par_iter()
            .filter(|&i| chosen[i])
            .map(|i| (i, taut_length(head, before.guides[i].root.position, middle, LYING)))
            .collect();
        let long_enough = |&(i, way): &(usize, f64)| {
            before.guides[i].rod.length() >= way * (1.0 + SLACK) + SHORTEST_TAIL
        };
        let nearest = ways.iter().map(|(_, way)| *way).fold(f64::INFINITY, f64::min);
        ways.retain(long_enough);
        if ways.is_empty() {
            let longest = (0..chosen.len()).filter(|&i| chosen[i]);
            let longest = longest.map(|i| before.guides[i].rod.length()).fold(0.0, f64::max);
            return Err(StyleError::NothingTied { needed: nearest + SHORTEST_TAIL, longest });
        }
        // 2. Where in the bundle each lies: the nearest inside.
        ways.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let radius = (ways.iter().map(|(i, _)| area(*i)).sum::<f64>() / PI).sqrt();
        let (middle, axis) = self.to.bundle(head, radius);
        let across = axis.any_orthonormal_vector();
        let bundle = Bundle { middle, axes: [across, axis.cross(across)], radius };
        let places: Vec<(usize, DVec3, f64)> = ways
            .par_iter()
            .enumerate()
            .map(|(rank, &(i, _))| {
                let root = before.guides[i].root.position;
                let to = bundle.point(rank, ways.len(), root);
                let way = taut_length(head, root, to, LYING).max(SHORTEST) * (1.0 + SLACK);
                (i, to, (way / before.guides[i].rod.length()).min(1.0))
            })
            .collect();
        // 3. Lifted off the head first, so that none hangs on an ear or before the neck, then held there.
        let centre = head.landmarks().cranium_centre;
        let lifted = centre + (axis + DVec3::Z).normalize_or(DVec3::Z) * LIFTED;
        let alone = Effort { sweeps: 0, ..Effort::FULL };
        let hand = Act { draft: Some(DraftRest { effort: alone, stride: 1, like: None }), ..*act };
        let up = places.iter().map(|&(i, _, at)| (i, lifted, at));
        let in_hand = hand.with(before.styling.tied(up))?;
        // 4. Hair that catches on an ear or the neck on its way stays out, rather than being held half-way.
        let tried = hand.on(&in_hand).with(before.styling.tied(places.iter().copied()))?;
        let reached = |&(i, to, at): &(usize, DVec3, f64)| {
            let rest = &tried.rest.guides[i];
            rest.at(&rest.chain(), at).0.distance(to) <= REACHED
        };
        act.on(&in_hand).with(before.styling.tied(places.into_iter().filter(reached)))
    }
}
