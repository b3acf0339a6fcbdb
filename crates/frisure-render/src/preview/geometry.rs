//! Grid cells and frames.

use glam::{UVec3, Vec3};

/// The cell of a grid that a place (in cells, not negative) lies in, and where in it. Casts, since
/// rounding is a call into the C library on processors without SSE 4.1.
pub(super) fn split(place: Vec3) -> (UVec3, Vec3) {
    let cell = place.as_uvec3();
    (cell, place - cell.as_vec3())
}

/// Two unit vectors that make a right-handed frame with the unit vector `w`.
pub(super) fn frame(w: Vec3) -> (Vec3, Vec3) {
    let u = w.any_orthonormal_vector();
    (u, w.cross(u))
}
