//! Hair cards: textured ribbons that stand for many strands, for programs that cannot draw a hundred thousand curves.
//!
//! In the order of the computation: `clusters` puts strands of similar place and shape together; `ribbon` lays a strip along
//! each cluster that turns with it; `layout` gives each strip a place in a texture; `atlas` draws the strands of each cluster
//! into its place; `compare` measures from six sides how far the cards are from the strands. [`cards`] does all of it, for
//! each level of detail.
//!
//! Lengths are metres, z is up. The same input gives the same bytes on any number of threads.

#![forbid(unsafe_code)]

mod atlas;
mod build;
mod clusters;
mod compare;
mod layout;
mod mesh;
mod raster;
mod ribbon;

pub use atlas::{Atlas, TEXTURES};
pub use build::{Cards, CardsError, CardsOptions, Level, cards};
pub use compare::{Difference, VIEWS};
pub use mesh::CardMesh;
