//! Rollers.

use crate::hairstyle::{Grip, Hairstyle};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::Apply;
use crate::hairstyle::Mould;

/// Winds each wisp on a roller, and holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Roll {
    /// Which wisps.
    pub selection: Selection,
    /// Radius of the roller (m).
    pub radius: f64,
    /// Advance per turn along the roller (m).
    pub pitch: f64,
}

impl Default for Roll {
    /// A roller of 2.4 cm; the pitch is the width of a strand.
    fn default() -> Self {
        Self { selection: Selection::Everything, radius: 0.012, pitch: 5e-3 }
    }
}

impl Roll {
    /// Range of [`Self::radius`].
    pub const RADIUS: Range = Range::new("roll.radius", 1e-3, 0.1, "between 1 mm and 10 cm");
    /// Range of [`Self::pitch`].
    pub const PITCH: Range = Range::new("roll.pitch", 0.0, 0.1, "between 0 and 10 cm");
}

impl Apply for Roll {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::RADIUS.check(self.radius)?;
        Self::PITCH.check(self.pitch)
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let mould = Mould::Roller { radius: self.radius, pitch: self.pitch };
        act.held(&self.selection, Grip::Mould { mould, tension: 0.0 })
    }
}
