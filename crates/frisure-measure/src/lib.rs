//! From a photo of one hanging lock to the radius and pitch of its curl, with error bars: pixels in, numbers out.
//!
//! A helix seen from the side is a wave, x(z) = R cos(2πz/P + φ). This crate separates the lock from a plain background ([`Photo`]), follows its middle
//! line and its ridge lines, and fits a wave whose length and height change slowly ([`measure`](fn@measure)). Weight has stretched a lock that hangs: inverse statics
//! with [`frisure_rod`] finds the natural curl that hangs so. Where the photo does not tell, the result is an [`Abstention`] with its reason.
//! docs/photo.md has the equations, the assumptions and the measured errors.
//!
//! The files in the order of the computation: `photo` (pixels), `scale`, `contrast` (background), `lock` (its pixels and its line), `ridges`, `search`
//! and `wave` (the fit), `cues` (amplitudes of ridges), `spring` and `statics` (the natural curl), `measure`, `overlay` and `report`.

#![forbid(unsafe_code)]

mod abstain;
mod contrast;
mod cues;
mod dense;
mod estimate;
mod filter;
mod lock;
mod measure;
mod overlay;
mod photo;
mod report;
mod ridges;
mod scale;
mod search;
mod spring;
mod statics;
mod wave;

pub use abstain::Abstention;
pub use cues::Cues;
pub use estimate::Estimate;
pub use measure::{Drawing, Hang, Measurement, Options, Outcome, measure};
pub use overlay::draw;
pub use photo::{Crop, LEAST_SIDE, Photo, PhotoError};
pub use report::{GivenFibre, scene, table};
pub use scale::{Scale, ScaleError};
pub use spring::natural_of_hanging;
pub use statics::Fibre;
