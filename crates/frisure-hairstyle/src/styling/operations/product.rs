//! Styling products.

use super::apply::Apply;
use crate::hairstyle::Hairstyle;
use crate::product::Applied;
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// Puts a styling product on hair, in place of one that was there.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    /// Which wisps.
    pub selection: Selection,
    /// Which product.
    pub kind: crate::product::Product,
    /// How much, 0 (none) to 1 (the usual amount).
    pub amount: f64,
}

impl Default for Product {
    fn default() -> Self {
        Self {
            selection: Selection::Everything,
            kind: crate::product::Product::Gel,
            amount: 1.0,
        }
    }
}

impl Product {
    /// Range of [`Self::amount`].
    pub const AMOUNT: Range = Range::new("product.amount", 0.0, 1.0, "between 0 and 1");
}

impl Apply for Product {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::AMOUNT.check(self.amount)
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let chosen = act.selected(&self.selection)?;
        let applied = Applied { product: self.kind, amount: self.amount };
        act.with(act.before.styling.changed(&chosen, |_, wisp| {
            wisp.product = applied.washed(1.0);
        }))
    }
}
