//! Hair against the body, as a penalty energy that plugs into the rod's minimisation.
//!
//! A node of a guide that is closer to the body than its wisp is thick pays `½ k d²` per length,
//! d the depth (\[paper\] §3.1). The stiffness is per length of hair, so that the energy does not
//! depend on how finely the guide is divided.

mod body;
mod envelope;

pub use body::BodyContact;
pub use envelope::Clearance;

use glam::{DMat3, DVec3};

/// `a bᵀ`.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
