//! Hair as a volume: wisps press on each other where there is more hair than has room.
//!
//! Each wisp spreads the volume that its hairs take over a smooth kernel, wider than wisps are apart. Where these volumes add
//! up to more than space has, hair is compressed. docs/theory.md, "Density"

mod arrival;
mod field;
mod hair;
mod kernel;
mod lanes;
mod site;
mod variation;

pub(crate) use arrival::{Arrival, Departure};
pub(crate) use hair::{Density, Strand};
pub(crate) use variation::DensityVariation;
