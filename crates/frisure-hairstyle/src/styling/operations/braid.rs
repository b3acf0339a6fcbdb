//! Braids.

use crate::hairstyle::{Grip, Hairstyle};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::Apply;
use crate::hairstyle::{DRAWN, Mould};

/// Braids hair in three, and holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Braid {
    /// Which wisps.
    pub selection: Selection,
    /// Width of the braid (m).
    pub width: f64,
    /// Length in which a part comes back to its place (m).
    pub pitch: f64,
}

impl Default for Braid {
    fn default() -> Self {
        Self { selection: Selection::Everything, width: 0.02, pitch: 0.04 }
    }
}

impl Braid {
    /// Range of [`Self::width`].
    pub const WIDTH: Range = Range::new("braid.width", 1e-3, 0.1, "between 1 mm and 10 cm");
    /// Range of [`Self::pitch`].
    pub const PITCH: Range = Range::new("braid.pitch", 5e-3, 0.5, "between 5 mm and 50 cm");
}

impl Apply for Braid {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::WIDTH.check(self.width)?;
        Self::PITCH.check(self.pitch)
    }

    /// The hand that braids draws the hair down.
    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let mould = Mould::Braid { width: self.width, pitch: self.pitch };
        act.held(&self.selection, Grip::Mould { mould, tension: DRAWN })
    }
}
