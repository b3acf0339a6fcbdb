//! What can be done to a hairstyle: wet, dry, cut, grow, comb, hold.
//!
//! An [`Operation`] is data; [`crate::Hairstyle::styled`] maps a hairstyle to another one.

mod error;
mod operation;
mod selection;

pub use error::StyleError;
pub use operation::{
    Comb, Cut, CutLine, Direction, Dry, Grow, Growth, Height, Held, Hold, Holder, Humidity,
    Operation, Part, Release, Wet,
};
pub use selection::{Lasso, Selection, Spot, View};
