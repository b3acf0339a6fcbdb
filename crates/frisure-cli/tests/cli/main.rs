//! Tests of the real program: one binary, so that it is linked once.

#[cfg(feature = "batch")]
mod batch;
mod cards;
mod convert;
mod fit;
mod hair;
mod help;
mod measure;
mod predict;
mod room;
mod style;
mod transfer;
#[cfg(feature = "validate")]
mod validate;
mod wrong;
