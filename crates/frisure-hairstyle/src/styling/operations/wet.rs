//! Wetting.

use crate::hairstyle::Hairstyle;
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::Apply;

/// Wets hair. \[paper\] §3.2
#[derive(Clone, Debug, PartialEq)]
pub struct Wet {
    /// Which wisps.
    pub selection: Selection,
    /// How wet they are then: 0 (dry) to 1.
    pub to: f64,
    /// Mass of the water in fully wet hair, as a fraction of the dry hair's, 0 to 0.4; the paper
    /// counts none.
    pub water: f64,
}

impl Default for Wet {
    fn default() -> Self {
        Self { selection: Selection::Everything, to: 1.0, water: 0.0 }
    }
}

impl Wet {
    /// Range of [`Self::to`].
    pub const TO: Range = Range::new("wet.to", 0.0, 1.0, "between 0 and 1");
    /// Range of [`Self::water`].
    pub const WATER: Range = Range::new("wet.water", 0.0, 0.4, "between 0 and 0.4");
}

impl Apply for Wet {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::TO.check(self.to)?;
        Self::WATER.check(self.water)
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let chosen = act.selected(&self.selection)?;
        let mut styling = act.before.styling.changed(&chosen, |_, wisp| {
            wisp.wet(self.to);
            wisp.water = if self.to > 0.0 { self.water } else { 0.0 };
        });
        styling.lay = Some(act.lay());
        act.with(styling)
    }
}
