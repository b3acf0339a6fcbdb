//! Ray intersection with hair and head: bounding volume hierarchies (BVH) over curves and triangles.
//!
//! A [`SceneBvh`] is built once from strands and the surface they grow on; [`SceneBvh::closest_hit`] and
//! [`SceneBvh::occluded`] then answer for any [`Ray`], from any thread.
//!
//! Strands are smooth: Catmull–Rom splines through their points (`curves`), cut into straight pieces
//! of a few millimetres with the true radius of the hair, a few tens of micrometres: nothing is made
//! wider than it is. The pieces, and the triangles of the head, each lie in an 8-wide `bvh`: nodes of eight
//! axis-aligned bounding boxes (`aabb`) and leaves of up to eight primitives, built by the surface-area heuristic
//! (`build`) and intersected eight at a time (`simd`, `hair`, `skin`).
//!
//! # What was measured
//!
//! `docs/performance-render.md` has the rates. What was tried, with a wig of 100 000 curly strands of
//! 16 points, as ratios of primary / bounce / shadow rays per second in one run:
//!
//! - Strands cut finer than some 3 mm are no faster; 100 µm beside the curve need 116 pieces per
//!   strand, 50 µm 161. Pieces with their ends outside the curve need a fifth fewer.
//! - Leaves on a 16-bit grid are 208 instead of 320 bytes. Decoded for every test they cost a tenth of
//!   the rate; that is won back by a first test without divisions, which is all that most leaves
//!   need.
//! - Splits from 32 bins, against 16: 1.06 / 1.07 / 1.07. With at most 64 primitives, 16 bins do.
//! - An area heuristic that counts pieces instead of leaves: 0.92 / 0.79 / 0.89. Leaves of 4 pieces:
//!   0.80 / 0.72 / 0.76. Leaves of 4 strips of two pieces, which share their joints and take a
//!   third less memory: 0.72 / 0.67 / 0.84.
//! - Without AVX2 and FMA, in plain Rust: about half. With the vectors of `fearless_simd`, 1.3 times the rate of our own
//!   AVX2, on a machine with AVX-512; triangles with SSE2 only: 0.9 of that.
//!
//! Untried: nodes on a grid, oriented boxes, sorted bounces.

mod aabb;
mod build;
mod bvh;
mod curves;
mod error;
mod hair;
mod hit;
mod node;
mod ray;
mod scene;
mod simd;
mod skin;
#[cfg(test)]
mod tests;

pub use curves::CurveOptions;
pub use error::AccelError;
pub use hit::{HairHit, Hit, SkinHit};
pub use ray::Ray;
pub use scene::SceneBvh;
