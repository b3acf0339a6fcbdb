//! Hair cards: textured ribbons that stand for many strands, for programs that cannot draw a hundred thousand curves.
//!
//! In the order of the computation: `clusters` puts strands of similar place and shape together; `ribbon` lays a strip along
//! each cluster that turns with it; `layout` gives each strip a place in a texture; `atlas` draws the strands of each cluster
//! into its place; `compare` measures from six sides how far the cards are from the strands; `level` does all of it for a level
//! of detail, and [`cards`] for all levels.
//!
//! Lengths are metres, z is up. The same input gives the same bytes on any number of threads.

#![forbid(unsafe_code)]

mod atlas;
mod build;
mod clusters;
mod compare;
mod error;
mod layout;
mod level;
mod mesh;
mod raster;
mod ribbon;

pub use atlas::{Atlas, TEXTURES};
pub use build::{Cards, CardsOptions, cards};
pub use compare::{Difference, VIEWS};
pub use error::CardsError;
pub use level::Level;
pub use mesh::CardMesh;
