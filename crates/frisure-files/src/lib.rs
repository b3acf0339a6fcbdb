//! Files read with a limit and written whole, and the unit and axes of the positions in them.

pub mod frame;
mod whole;

pub use whole::*;
