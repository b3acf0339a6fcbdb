//! The directions in which the environment light is sampled: Lebedev's 14-point rule, exact to degree 5.

use glam::{IVec3, Vec3};

/// Directions from which the environment light is known.
pub const DIRECTION_COUNT: usize = 14;

/// Steps on a grid of the fourteen directions, and the weight of each.
pub(super) const DIRECTIONS: [([i32; 3], f32); DIRECTION_COUNT] = {
    const FACE: f32 = 1.0 / 15.0;
    const CORNER: f32 = 3.0 / 40.0;
    [
        ([1, 0, 0], FACE),
        ([-1, 0, 0], FACE),
        ([0, 1, 0], FACE),
        ([0, -1, 0], FACE),
        ([0, 0, 1], FACE),
        ([0, 0, -1], FACE),
        ([1, 1, 1], CORNER),
        ([-1, 1, 1], CORNER),
        ([1, -1, 1], CORNER),
        ([-1, -1, 1], CORNER),
        ([1, 1, -1], CORNER),
        ([-1, 1, -1], CORNER),
        ([1, -1, -1], CORNER),
        ([-1, -1, -1], CORNER),
    ]
};

/// The unit directions and their weights.
pub(super) fn directions() -> [(Vec3, f32); DIRECTION_COUNT] {
    DIRECTIONS.map(|(step, weight)| (direction(step), weight))
}

/// The unit direction of a step.
pub(super) fn direction(step: [i32; 3]) -> Vec3 {
    IVec3::from_array(step).as_vec3().normalize()
}
