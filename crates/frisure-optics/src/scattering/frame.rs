//! Directions in the frame of a fibre.

use glam::Vec3;

/// The material frame of a fibre where a ray meets it; right-handed, d1 × d2 = t.
///
/// In local coordinates x is along d1 (semi-axis a), y along d2 (semi-axis b) and z along the
/// tangent, from root to tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FibreFrame {
    /// First principal axis of the section.
    pub d1: Vec3,
    /// Second principal axis of the section.
    pub d2: Vec3,
    /// Tangent.
    pub t: Vec3,
}

impl FibreFrame {
    /// The frame of unit `tangent` whose d1 is nearest to `d1`.
    ///
    /// Where `d1` is along the tangent, or not finite, some d1 across it is taken.
    #[must_use]
    pub fn new(tangent: Vec3, d1: Vec3) -> Self {
        let across = d1 - tangent * tangent.dot(d1);
        let d1 = across.try_normalize().unwrap_or_else(|| tangent.any_orthonormal_vector());
        Self { d1, d2: tangent.cross(d1), t: tangent }
    }

    /// A direction of the world in local coordinates.
    #[must_use]
    pub fn to_local(&self, world: Vec3) -> Vec3 {
        Vec3::new(self.d1.dot(world), self.d2.dot(world), self.t.dot(world))
    }

    /// A local direction in the world.
    #[must_use]
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        self.d1 * local.x + self.d2 * local.y + self.t * local.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let f = FibreFrame::new(Vec3::new(1.0, 2.0, -0.5).normalize(), Vec3::new(0.1, 0.3, 0.9));
        let w = Vec3::new(-0.4, 0.2, 0.7);
        assert!((f.to_world(f.to_local(w)) - w).length() < 1e-6);
        assert!((f.d1.cross(f.d2) - f.t).length() < 1e-6);
    }

    #[test]
    fn a_useless_axis_is_replaced() {
        for d1 in [Vec3::Z, Vec3::ZERO, Vec3::NAN] {
            let f = FibreFrame::new(Vec3::Z, d1);
            assert!(f.d1.is_normalized() && f.d1.z.abs() < 1e-6);
        }
    }
}
