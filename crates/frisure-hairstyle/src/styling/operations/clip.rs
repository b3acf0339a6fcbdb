//! Clips.

use glam::DVec3;

use super::apply::{Apply, check_outside, check_point};
use crate::hairstyle::{Fastener, Grip, Hairstyle};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::mirror::mirrored;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// Holds a place of each wisp at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Which wisps.
    pub selection: Selection,
    /// Which place: 0 (root) to 1 (tip).
    pub at: f64,
    /// The point (m).
    pub to: DVec3,
}

impl Default for Clip {
    fn default() -> Self {
        Self { selection: Selection::Everything, at: 0.5, to: DVec3::new(0.0, 0.1, 0.12) }
    }
}

impl Clip {
    /// Range of [`Self::at`].
    pub const AT: Range = Range::new("clip.at", 0.05, 1.0, "between 0.05 and 1");
}

impl Apply for Clip {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::AT.check(self.at)?;
        check_point("clip.to", self.to)
    }

    fn mirror(&mut self) {
        self.to = mirrored(self.to);
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        check_outside(act.head, self.to)?;
        act.held(&self.selection, Grip::Clip { at: self.at, to: self.to, by: Fastener::Clip })
    }
}
