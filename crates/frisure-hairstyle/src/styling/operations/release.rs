//! Letting go.

use crate::hairstyle::Hairstyle;
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::Apply;

/// Lets go of held hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Release {
    /// Which wisps.
    pub selection: Selection,
}

impl Default for Release {
    fn default() -> Self {
        Self { selection: Selection::Everything }
    }
}

impl Apply for Release {
    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let chosen = act.selected(&self.selection)?;
        act.with(act.before.styling.changed(&chosen, |_, wisp| wisp.grip = None))
    }
}
