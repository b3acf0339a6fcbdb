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
