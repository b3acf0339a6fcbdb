//! Two-strand twists.

use crate::hairstyle::{Grip, Hairstyle};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::Apply;
use crate::hairstyle::Mould;

/// Winds two locks round each other, and holds them: each wisp is one of the two. Dried so and released,
/// the hair keeps waves (a twist-out).
///
/// The twist is as wide as two round locks beside each other, of half its width each, so the centre line of
/// either is a helix of a quarter of its width. `docs/styling.md`, "Twist".
#[derive(Clone, Debug, PartialEq)]
pub struct Twist {
    /// Which wisps.
    pub selection: Selection,
    /// Width of the twist (m).
    pub width: f64,
    /// Length of the twist in which a lock comes back to its side (m).
    pub pitch: f64,
}

impl Default for Twist {
    /// A twist of 12 mm that turns once in 3 cm: a lock leans by 32 degrees, as in a rope. Chosen, not
    /// measured.
    fn default() -> Self {
        Self { selection: Selection::Everything, width: 0.012, pitch: 0.03 }
    }
}

/// Tension of a lock in a twist, in its weights: its end hangs free, and the other lock keeps it from
/// stretching, so it is drawn less than a braid. Chosen by trial, not measured further.
const TENSION: f64 = 2.0;

impl Twist {
    /// Range of [`Self::width`].
    pub const WIDTH: Range = Range::new("twist.width", 1e-3, 0.1, "between 1 mm and 10 cm");
    /// Range of [`Self::pitch`].
    pub const PITCH: Range = Range::new("twist.pitch", 5e-3, 0.5, "between 5 mm and 50 cm");
}

impl Apply for Twist {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::WIDTH.check(self.width)?;
        Self::PITCH.check(self.pitch)
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let mould = Mould::Twist { radius: 0.25 * self.width, pitch: self.pitch };
        act.held(&self.selection, Grip::Mould { mould, tension: TENSION })
    }
}
