//! The studio floor.

use glam::Vec3;

use crate::accel::Ray;

/// A level plane without end that fades into the background far from its centre.
pub(super) struct Floor {
    centre: Vec3,
    radius: f32,
    colour: Vec3,
}

impl Floor {
    pub(super) fn new(look: &frisure_look::Floor) -> Self {
        Self { centre: look.centre.as_vec3(), radius: look.radius as f32, colour: look.colour }
    }

    /// Diffuse reflectance.
    pub(super) fn colour(&self) -> Vec3 {
        self.colour
    }

    /// Intersects a ray from above: distance and point (m).
    pub(super) fn intersect(&self, ray: &Ray) -> Option<(f32, Vec3)> {
        let t = (self.centre.z - ray.origin().z) / ray.direction().z;
        // A ray that starts on the floor leaves upwards; t of a level ray is not finite.
        (ray.direction().z < 0.0 && t > 0.0 && t.is_finite())
            .then(|| (t, ray.at(t).with_z(self.centre.z)))
    }

    /// Share of the background that shows through at a point of the floor: a smoothstep from half the radius.
    pub(super) fn background_share(&self, point: Vec3) -> f32 {
        let x = (2.0 * (point - self.centre).length() / self.radius - 1.0).clamp(0.0, 1.0);
        x * x * (3.0 - 2.0 * x)
    }
}
