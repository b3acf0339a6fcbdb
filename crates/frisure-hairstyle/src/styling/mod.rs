//! What can be done to a hairstyle: wet, dry, cut, grow, comb, hold.
//!
//! An [`Operation`] is data; [`style`] maps a hairstyle to another one. What
//! styling has made of each wisp is a [`WispState`], and the guide that the wisp has now follows from
//! it and from the guide that was planned (`apply_state`; what water does is in `wet_law`). So drying is the exact inverse of wetting,
//! whatever has been rounded on the way.

mod apply;
mod apply_state;
mod braiding;
mod ends;
mod error;
mod gather;
mod height;
mod mirror;
mod operations;
mod selection;
mod settle;
mod taut;
mod wet_law;

pub use apply::{Draft, StyleOptions, selected, style};
pub use error::StyleError;
pub use height::Height;
pub use operations::*;
pub use selection::{Lasso, Selection, Spot, View};

pub use crate::hairstyle::WispState;
