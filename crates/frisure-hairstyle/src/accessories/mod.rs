//! What holds hair, as objects to look at: rollers, hair ties, the elastics of braids and twists, pins and clips.
//!
//! They follow from what holds each wisp and from where the guides rest, and nothing depends on them: an object is there as long as hair
//! is held, and lies where that hair is.

mod accessory;
mod elastics;
mod find;
mod kind;
mod mesh;
mod pins;
mod place;
mod rollers;
mod ties;
mod winding;

pub use accessory::{Accessory, accessory_meshes};
pub use find::accessories;
pub use kind::AccessoryKind;
