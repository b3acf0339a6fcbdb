//! Hot plates.

use crate::hairstyle::{Grip, Hairstyle};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::Apply;
use crate::hairstyle::{DRAWN, Mould};

/// Draws hair straight, as between hot plates or under a brush, and holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Straighten {
    /// Which wisps.
    pub selection: Selection,
}

impl Default for Straighten {
    fn default() -> Self {
        Self { selection: Selection::Everything }
    }
}

impl Apply for Straighten {
    /// The hand that draws hair through plates draws it down.
    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        act.held(&self.selection, Grip::Mould { mould: Mould::Straight, tension: DRAWN })
    }
}
