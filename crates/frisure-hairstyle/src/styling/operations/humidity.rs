//! Damp and dry air.

use crate::hairstyle::{Hairstyle, Styling};
use crate::spec::{InvalidSpec, Range};
use crate::presets::Moisture;
use crate::styling::error::StyleError;
use crate::styling::settle::Act;
use super::apply::Apply;

/// Leaves all hair in air of some humidity. Damp air opens the bonds that hold a set, as water does but not all of them: what it takes
/// of a set does not come back when the air is dry again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Humidity {
    /// Relative humidity, 0 to 1; every hairstyle begins at 0.6.
    pub relative: f64,
}

impl Default for Humidity {
    fn default() -> Self {
        Self { relative: crate::hairstyle::ROOM }
    }
}

impl Humidity {
    /// Range of [`Self::relative`].
    pub const RELATIVE: Range = Range::new("humidity", 0.0, 1.0, "between 0 and 1");
}

impl Apply for Humidity {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::RELATIVE.check(self.relative)
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let mut styling = Styling { humidity: self.relative, ..act.before.styling.clone() };
        // As wetting from the wetness w to w′ leaves (1 − w′)/(1 − w) of a set, and of what is wet at once as much.
        let [before, after] =
            [act.before.styling.humidity, self.relative].map(|h| Moisture::in_air(h).open());
        if after > before {
            let left = (1.0 - after) / (1.0 - before);
            styling.wisps.iter_mut().for_each(|wisp| wisp.leave_of_sets(left));
        }
        act.with(styling)
    }
}
