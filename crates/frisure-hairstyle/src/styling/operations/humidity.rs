//! Damp and dry air.

use crate::hairstyle::{Hairstyle, Styling};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::settle::Act;
use super::apply::Apply;

/// Leaves all hair that is not wet in air of some humidity.
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
        act.with(Styling { humidity: self.relative, ..act.before.styling.clone() })
    }
}
