//! Axis-aligned bounding boxes (AABB).

use glam::Vec3A;

/// An axis-aligned bounding box: smallest and largest corner (m); inverted where it is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Aabb {
    pub(super) low: Vec3A,
    pub(super) high: Vec3A,
}

impl Aabb {
    pub(super) const EMPTY: Self = Self { low: Vec3A::INFINITY, high: Vec3A::NEG_INFINITY };

    #[inline]
    pub(super) fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(super) fn grown(self, by: f32) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }

    /// Half the surface (m²); 0 if empty.
    #[inline]
    pub(super) fn half_area(self) -> f32 {
        let d = (self.high - self.low).max(Vec3A::ZERO);
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    /// Largest coordinate, either side of 0; 0 if empty.
    pub(super) fn reach(self) -> f32 {
        let reach = self.low.abs().max(self.high.abs()).max_element();
        if reach.is_finite() { reach } else { 0.0 }
    }
}
