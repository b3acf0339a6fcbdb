//! Clips.

use glam::DVec3;

use super::apply::{Apply, check_outside, check_point};
use crate::guides::Guide;
use crate::hairstyle::{Fastener, Grip, Hairstyle};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::mirror::mirrored;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// How much (m) hair may be missing to a clip that holds it: it holds a bundle, not a point. Chosen.
const REACHED: f64 = 0.01;

/// Holds a place of each wisp at a point. What is too short to reach it even on a straight way stays as it is.
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
        let chosen = act.selected(&self.selection)?;
        let before = act.before;
        // How much hair is missing (m) on the straight way to the clip, which no way around the head is shorter than.
        let missing = |guide: &Guide| {
            guide.root.position.distance(self.to) - self.at * guide.rod.length()
        };
        let missing: Vec<f64> = before.guides.iter().map(missing).collect();
        let chosen_ones = (0..missing.len()).filter(|&i| chosen[i]);
        let nearest = chosen_ones.min_by(|&a, &b| missing[a].total_cmp(&missing[b]));
        if let Some(nearest) = nearest.filter(|&i| missing[i] > REACHED) {
            let length = self.at * before.guides[nearest].rod.length();
            return Err(StyleError::NothingGathered { needed: length + missing[nearest], length });
        }
        let reaching: Vec<bool> =
            chosen.iter().zip(&missing).map(|(&is, missing)| is && *missing <= REACHED).collect();
        act.with(before.styling.changed(&reaching, |_, wisp| {
            wisp.moved += 1;
            wisp.grip = Some(Grip::Clip { at: self.at, to: self.to, by: Fastener::Clip });
        }))
    }
}
