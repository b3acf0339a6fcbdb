//! Where rays meet hair and head.
//!
//! A [`Scene`] is made once from strands and the surface they grow on; [`Scene::closest_hit`] and
//! [`Scene::occluded`] then answer for any [`Ray`], from any thread.
//!
//! Strands are smooth: Catmull–Rom splines through their points (`curves`), cut into straight pieces
//! of a few millimetres with the true radius of the hair, a few tens of micrometres: nothing is made
//! wider than it is. The pieces, and the triangles of the head, each lie in a `hierarchy` of boxes
//! with eight children to a node and up to eight things to a leaf (`build`), which are tested eight
//! at a time (`simd`, `hair`, `skin`).
//!
//! # What was measured
//!
//! A wig of 100 000 curly strands of 16 points (`benches/accel.rs`), one thread, best of eight turns
//! taken in one run, millions of rays per CPU second (primary / bounce / shadow):
//!
//! | cut | pieces and kB per strand | rates |
//! | --- | --- | --- |
//! | 3 mm | 101, 5.4 | 2.26 / 0.67 / 1.14 |
//! | 5 mm | 63, 3.5 | 2.19 / 0.62 / 1.13 |
//! | 8 mm | 43, 2.5 | 1.93 / 0.54 / 1.04 |
//! | 4 mm, 200 µm beside the curve | 102, 5.5 | 2.34 / 0.68 / 1.14 |
//! | 4 mm, 100 µm | 141, 7.4 | 2.34 / 0.68 / 1.13 |
//! | 4 mm, 50 µm (the default) | 195, 10.2 | 2.27 / 0.64 / 1.02 |
//! | the same without AVX2 and FMA | 195, 10.2 | 1.19 / 0.37 / 0.49 |
//!
//! Strands cut finer than 3 mm are no faster; the default takes 4 mm, and 50 µm for the shape of
//! curls. At 4 mm and 200 µm, programs run one after the other, as ratios to 16 bins: 32 bins 1.06 / 1.07 / 1.07
//! (kept); leaves of 4 pieces 0.80 / 0.72 / 0.76, and nearly twice the memory; an area heuristic that
//! counts pieces instead of leaves 0.92 / 0.79 / 0.89. Leaves on a 16-bit grid need 0.69 of the memory
//! but run at 0.87 / 0.81 / 0.89. Untried: nodes on a grid, oriented boxes, sorted bounces.

mod bounds;
mod build;
mod curves;
mod error;
mod hair;
mod hierarchy;
mod hit;
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
pub use scene::Scene;
