//! Many single rods at once, as arrays; `python/frisure/rods.py` has the shapes and units.

mod clamp;
mod fibres;
mod gradient;
mod inverse;
mod kept;
mod limits;
mod motion;
mod settle;

pub(crate) use gradient::RodsAtRest;
pub(crate) use inverse::inverse_rods;
pub(crate) use settle::{check_rods, settle_rods};
