//! Files read with a limit and written whole, the unit and axes of the positions in them, and the files of a head.

#![forbid(unsafe_code)]

pub mod frame;
pub mod head;
mod pipe;
mod replace;
mod temporary;
mod whole;

pub use whole::*;
