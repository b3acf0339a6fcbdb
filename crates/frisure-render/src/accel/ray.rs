//! A ray.

use glam::Vec3;

/// A half-line: a point (m) and a unit direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    origin: Vec3,
    direction: Vec3,
}

impl Ray {
    /// The ray from `origin` (m) along `direction`, which need not be a unit vector. Without a
    /// direction, or with a coordinate that is not finite, it meets nothing.
    #[must_use]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        let direction = direction.try_normalize().unwrap_or(Vec3::NAN);
        Self { origin, direction }
    }

    /// Origin (m).
    #[must_use]
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// Unit direction.
    #[must_use]
    pub fn direction(&self) -> Vec3 {
        self.direction
    }

    /// The point at distance `t` (m).
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.direction
    }

    pub(super) fn is_finite(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite()
    }
}
