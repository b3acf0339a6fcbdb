//! A sphere in place of a head.

use frisure::rod::potential::Field;
use glam::{DMat3, DVec3};

/// A repulsive sphere: ½ k d² per length of hair, d the depth.
pub(super) struct Sphere {
    /// Its centre (m).
    pub(super) middle: DVec3,
    /// Radius (m).
    pub(super) radius: f64,
    /// k (N/m²).
    pub(super) stiffness: f64,
}

impl Field for Sphere {
    fn energy(&self, _: f64, position: DVec3) -> f64 {
        0.5 * self.stiffness * (self.radius - position.distance(self.middle)).max(0.0).powi(2)
    }

    fn derivatives(&self, _: f64, position: DVec3) -> Option<(DVec3, DMat3)> {
        let from = position - self.middle;
        let distance = from.length();
        let depth = self.radius - distance;
        (depth > 0.0).then(|| {
            let n = from / distance;
            let outer = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
            let across = (DMat3::IDENTITY - outer) * (depth / distance);
            (n * (-self.stiffness * depth), (outer - across) * self.stiffness)
        })
    }
}
