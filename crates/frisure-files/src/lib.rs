//! Files read with a limit and written whole, and the unit and axes of the positions in them.

#![forbid(unsafe_code)]

pub mod frame;
mod whole;

pub use whole::*;
