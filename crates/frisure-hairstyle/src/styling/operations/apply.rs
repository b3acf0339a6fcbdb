//! What operations have in common.

use glam::DVec3;

use crate::hairstyle::{Grip, Hairstyle, Styling, WispState};
use crate::head::Head;
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// What an operation checks and does.
pub(crate) trait Apply {
    /// Checks each number against its range.
    fn check(&self) -> Result<(), InvalidSpec> {
        Ok(())
    }

    /// Puts its own places and directions, but for the selected wisps, on the other side of the head.
    fn mirror(&mut self) {}

    /// The hairstyle that it makes.
    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError>;

    /// The hairstyles that it makes one after the other, the result last; at least one.
    fn stages(&self, act: &Act<'_>) -> Result<Vec<Hairstyle>, StyleError> {
        Ok(vec![self.apply(act)?])
    }
}

impl Act<'_> {
    /// The hairstyle with the selected wisps moved by hand and held.
    pub(super) fn held(&self, selection: &Selection, grip: Grip) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(selection)?;
        self.with(self.before.styling.changed(&chosen, |_, wisp| {
            wisp.moved += 1;
            wisp.grip = Some(grip);
        }))
    }
}

impl Styling {
    /// The same with chosen wisps changed.
    pub(super) fn changed(
        &self,
        chosen: &[bool],
        mut change: impl FnMut(usize, &mut WispState),
    ) -> Self {
        let mut styling = self.clone();
        for (index, wisp) in styling.wisps.iter_mut().enumerate() {
            if chosen[index] {
                change(index, wisp);
            }
        }
        styling
    }
}

/// Farthest (m) from the origin that a line or a point may be; chosen: beyond it a unit was mistaken.
pub(super) const FARTHEST: f64 = 100.0;

/// A point near the head.
pub(super) fn check_point(field: &'static str, p: DVec3) -> Result<(), InvalidSpec> {
    let far =
        p.to_array().into_iter().fold(0.0, |far: f64, x| if x.abs() <= far { far } else { x });
    let allowed = "three numbers within 100 m of the origin";
    Range::new(field, -FARTHEST, FARTHEST, allowed).check(far)
}

/// How deep (m) in the head a point may be where hair is held: what is pinned to the skin may be a little below it. Chosen: above the thickness of what is
/// pinned, and the error of a coarse mesh.
const MOST_DEPTH: f64 = 5e-3;

/// Steps from a point inside the head to the skin. Chosen: the distance is exact near the skin, so that the last ones are short.
const TO_THE_SKIN: usize = 20;

/// Refuses a point at which hair is held inside the head, where no hair gets.
pub(super) fn check_outside(head: &Head, p: DVec3) -> Result<(), StyleError> {
    let depth = -head.signed_distance().value(p);
    if depth <= MOST_DEPTH {
        return Ok(());
    }
    // Deep inside the gradient does not point to the nearest skin; some steps of its own length get to skin that is near.
    let mut skin = p;
    for _ in 0..TO_THE_SKIN {
        let (distance, gradient) = head.signed_distance().value_gradient(skin);
        skin -= gradient.normalize_or(DVec3::Z) * distance;
    }
    Err(StyleError::InsideHead { depth, skin })
}

/// A vector with a length.
pub(super) fn check_direction(field: &'static str, d: DVec3) -> Result<(), InvalidSpec> {
    let allowed = "a direction, which has a length between 1e-9 and 1e9";
    Range::new(field, 1e-9, 1e9, allowed).check(d.length())
}
