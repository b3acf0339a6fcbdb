//! The description of a hairstyle: everything that [`crate::Hairstyle`] is computed from.
//!
//! A scene file is one way to write it down.

mod check;
mod description;
mod load;
mod numbers;
mod ranges;

pub use crate::head::Hairline;
pub use description::{
    Body, Comb, Contact, Flow, HairContact, HairModel, Hairs, HairstyleSpec, HeadMethod,
    Implantation, Length, Level, Lift, Parting, Place, RegionLength, RegionStyle, Settling,
    StrandContact, Turn, Whorls, Wisps,
};
pub use load::{Pose, Wind};
pub use numbers::{Number, Scalar, number};
pub(crate) use ranges::range;
pub use ranges::{InvalidSpec, Range};
