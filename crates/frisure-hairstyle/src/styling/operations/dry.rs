//! Drying.

use frisure_rod::{InvalidQuantity, NaturalStrain};

use super::apply::Apply;
use crate::hairstyle::Hairstyle;
use crate::hairstyle::strain_of;
use crate::parallel;
use crate::presets::Moisture;
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// Dries hair: the inverse of wetting, except that hair held in a shape keeps part of it.
/// \[paper\] §3.2
#[derive(Clone, Debug, PartialEq)]
pub struct Dry {
    /// Which wisps.
    pub selection: Selection,
    /// How much of the shape in which wet hair is held while it dries it keeps until it is wet
    /// again, 0 to 1.
    pub keep: f64,
}

impl Default for Dry {
    fn default() -> Self {
        // Chosen; a water set has been measured to keep 0.58 for half an hour, 0.52 for eight. docs/styling.md, "Water"
        Self { selection: Selection::Everything, keep: 0.6 }
    }
}

impl Dry {
    /// Range of [`Self::keep`].
    pub const KEEP: Range = Range::new("dry.keep", 0.0, 1.0, "between 0 and 1");
}

impl Apply for Dry {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::KEEP.check(self.keep)
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let chosen = act.selected(&self.selection)?;
        let kept = shapes_kept(act.before, &chosen)?;
        // What damp air keeps open does not close.
        let closes = 1.0 - Moisture::in_air(act.before.styling.humidity).open();
        act.with(act.before.styling.changed(&chosen, |index, wisp| {
            let closed = wisp.wetness * closes;
            wisp.wet(0.0);
            // Only the bonds that water had opened close in the new shape.
            if let Some(held) = &kept[index] {
                let keep = wisp.product.map_or(self.keep, |product| product.keep(self.keep));
                wisp.keep(held.clone(), keep * closed);
            }
        }))
    }
}

/// The strain of each chosen wisp that is wet and held.
fn shapes_kept(
    hair: &Hairstyle,
    chosen: &[bool],
) -> Result<Vec<Option<NaturalStrain>>, InvalidQuantity> {
    parallel::try_map(hair.styling.wisps.len(), |index| {
        let wisp = &hair.styling.wisps[index];
        let setting = chosen[index] && wisp.wetness > 0.0 && wisp.is_held();
        let stretch = hair.guides[index].rod.length() / wisp.length;
        setting.then(|| strain_of(&hair.rest.guides[index], stretch)).transpose()
    })
}
