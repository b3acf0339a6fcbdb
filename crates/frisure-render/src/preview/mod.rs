//! A picture of hair in seconds, by projection.
//!
//! In the order of the computation: `curves` makes each strand smooth on the screen; `density` and
//! `ambient` measure how much hair lies between any point and each lamp or the environment, and `shadow` whether
//! the head does; `tiles` sorts the pieces of hair into small squares of the picture, and `composite`
//! lays them over the rasterised `head` from front to back; `shading` computes only hair that is visible.
//! A lamp at a finite distance becomes a distant light in its direction from the middle of the head, and an environment
//! light becomes its brightest spots and the mean of the rest by direction. Shading follows
//! Kajiya & Kay 1989 with the lobes of Marschner et al. 2003; self-shadowing is the light-oriented density map of
//! Bertails, Ménier & Cani 2005.
//!
//! What it does not do: light that bounces between hairs is a colour, not a computation; a hair's
//! section is round; and hairs that cross within one short piece may be seen in the wrong order.

mod ambient;
mod area;
mod cache;
mod composite;
pub mod constants;
mod curves;
mod density;
mod directional;
mod directions;
mod geometry;
mod head;
mod lumps;
mod material;
mod projection;
mod raster;
mod render;
mod shading;
mod shadow;
mod tiles;
mod wetness;

pub use ambient::{AmbientLight, Occluder};
pub use curves::smooth;
pub use directional::DirectionalLights;
pub use directions::DIRECTION_COUNT;
pub use material::{Material, Materials, glitter};
pub use render::{PreviewError, PreviewOptions, chosen_width, render};
pub use wetness::Wetness;
