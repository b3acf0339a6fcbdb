//! What operations have in common.

use glam::DVec3;

use crate::hairstyle::{Grip, Hairstyle, Styling, WispState};
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

/// A vector with a length.
pub(super) fn check_direction(field: &'static str, d: DVec3) -> Result<(), InvalidSpec> {
    let allowed = "a direction, which has a length between 1e-9 and 1e9";
    Range::new(field, 1e-9, 1e9, allowed).check(d.length())
}
