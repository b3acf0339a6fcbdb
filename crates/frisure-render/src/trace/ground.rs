//! The floor of the studio.

use glam::Vec3;

use crate::accel::Ray;
use crate::look;

/// A level floor that reaches to the horizon, and is lost in the background far from its middle.
pub(super) struct Ground {
    middle: Vec3,
    reach: f32,
    colour: Vec3,
}

impl Ground {
    pub(super) fn new(look: &look::Ground) -> Self {
        Self { middle: look.middle.as_vec3(), reach: look.reach as f32, colour: look.colour }
    }

    /// Diffuse reflectance.
    pub(super) fn colour(&self) -> Vec3 {
        self.colour
    }

    /// Where a ray from above meets it: the distance and the point (m).
    pub(super) fn meets(&self, ray: &Ray) -> Option<(f32, Vec3)> {
        let t = (self.middle.z - ray.origin().z) / ray.direction().z;
        // From on it, rays leave upwards; a level one has no distance.
        (ray.direction().z < 0.0 && t > 0.0 && t.is_finite())
            .then(|| (t, ray.at(t).with_z(self.middle.z)))
    }

    /// Share of the background that is seen at a point of it.
    pub(super) fn faded(&self, point: Vec3) -> f32 {
        let x = (2.0 * (point - self.middle).length() / self.reach - 1.0).clamp(0.0, 1.0);
        x * x * (3.0 - 2.0 * x)
    }
}
