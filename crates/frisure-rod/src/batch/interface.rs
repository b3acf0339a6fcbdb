//! What brings hairs to rest, on whichever machine.

use std::error::Error;

use glam::DVec3;
use thiserror::Error;

use super::{Batch, Batched};
use crate::Rod;

/// What brings many hairs to rest in their own weight: the processor ([`Batch`]), or a device that another crate
/// knows how to use.
///
/// Whoever does it, rest is what [`Batch`] calls so: its tolerance, in double precision, with a positive second
/// variation. Where a hair has several equilibria, another machine may find another.
///
/// ```
/// use frisure_rod::batch::{Batch, Settle};
///
/// let here = Batch { elements: 24, ..Batch::default() };
/// let somewhere: &dyn Settle = &here;
/// assert!(somewhere.settle(&[])?.hairs.is_empty());
/// # Ok::<(), frisure_rod::batch::Unsettled>(())
/// ```
pub trait Settle {
    /// Brings hairs to rest from their natural shapes.
    ///
    /// # Errors
    /// [`Unsettled`] if what was asked for makes no sense, or a device fails; never for a hair: one that does not come
    /// to rest says so itself.
    fn settle(&self, rods: &[Rod]) -> Result<Batched, Unsettled>;

    /// The same, from other shapes: the turn of each joint (rad), those of a hair one after the other. Zero is the
    /// natural shape.
    ///
    /// # Errors
    /// As [`Self::settle`].
    fn settle_from(&self, rods: &[Rod], controls: Vec<DVec3>) -> Result<Batched, Unsettled>;
}

/// Why no hair of a batch was brought to rest.
#[derive(Debug, Error)]
pub enum Unsettled {
    /// Hairs without elements.
    #[error("hairs of 0 elements: each has at least 1")]
    NoElements,
    /// Not as many turns as joints.
    #[error("{given} turns of joints: these hairs have {needed}, one for each element")]
    Turns {
        /// How many were given.
        given: usize,
        /// How many joints there are.
        needed: usize,
    },
    /// The device could not.
    #[error(transparent)]
    Device(Box<dyn Error + Send + Sync>),
}

impl Settle for Batch {
    fn settle(&self, rods: &[Rod]) -> Result<Batched, Unsettled> {
        match self.elements {
            0 => Err(Unsettled::NoElements),
            _ => Ok(self.settle(rods)),
        }
    }

    fn settle_from(&self, rods: &[Rod], controls: Vec<DVec3>) -> Result<Batched, Unsettled> {
        let (given, needed) = (controls.len(), rods.len() * self.elements);
        if self.elements == 0 {
            return Err(Unsettled::NoElements);
        }
        if given != needed {
            return Err(Unsettled::Turns { given, needed });
        }
        Ok(self.settle_from(rods, controls))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nonsense_is_an_error() {
        let none = Batch { elements: 0, ..Batch::default() };
        assert!(matches!(Settle::settle(&none, &[]), Err(Unsettled::NoElements)));
        let turns = Settle::settle_from(&Batch::default(), &[], vec![DVec3::ZERO]);
        assert!(matches!(turns, Err(Unsettled::Turns { given: 1, needed: 0 })));
    }
}
