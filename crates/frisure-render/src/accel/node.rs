//! Parts of a BVH: primitives, leaves of up to eight primitives, nodes of eight children.

use fearless_simd::{Simd, f32x8};
use glam::Vec3A;

use super::aabb::Aabb;
use super::simd::{LANES, Lanes, Wide3};

/// A primitive: its AABB, its index and a number of its own.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(super) struct Primitive {
    low: [f32; 3],
    index: u32,
    high: [f32; 3],
    number: u32,
}

impl Primitive {
    pub(super) fn new(bounds: Aabb, index: u32, number: u32) -> Self {
        Self { low: bounds.low.to_array(), index, high: bounds.high.to_array(), number }
    }

    #[inline]
    pub(super) fn bounds(&self) -> Aabb {
        Aabb { low: Vec3A::from(self.low), high: Vec3A::from(self.high) }
    }

    pub(super) fn index(&self) -> usize {
        self.index as usize
    }

    pub(super) fn number(&self) -> u32 {
        self.number
    }

    /// Twice the centroid of the AABB.
    #[inline]
    pub(super) fn centroid(&self) -> Vec3A {
        Vec3A::from(self.low) + Vec3A::from(self.high)
    }
}

/// Up to eight primitives that are intersected at once.
pub(super) trait Leaf: Copy + Send + Sync {
    /// All primitives.
    type Primitives: Sync + ?Sized;
    /// The leaf of up to eight primitives.
    fn new(all: &Self::Primitives, primitives: &[Primitive]) -> Self;
    /// Intersects the ray: distances along it (m), and a bit mask of the primitives that are hit before `t_max`. The
    /// ray starts at or before the leaf's AABB.
    fn intersect<S: Simd>(&self, simd: S, ray: &WideRay<S>, t_max: f32) -> (f32x8<S>, u32);
}

/// A ray in all eight lanes.
pub(super) struct WideRay<S: Simd> {
    pub(super) origin: Wide3<S>,
    pub(super) direction: Wide3<S>,
}

/// A node: the AABBs of eight children.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(super) struct Node {
    pub(super) low: [Lanes; 3],
    pub(super) high: [Lanes; 3],
    pub(super) child: [Child; LANES],
}

/// Index of a node or of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Child(pub(super) u32);

/// Bit of an index that marks a leaf.
pub(super) const LEAF: u32 = 1 << 31;

impl Child {
    pub(super) const NONE: Self = Self(u32::MAX);

    // There are fewer than 2³¹ primitives, so that indices fit.
    pub(super) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(super) fn leaf(index: usize) -> Self {
        Self(index as u32 | LEAF)
    }

    /// The child, moved behind `nodes` nodes and `leaves` leaves.
    pub(super) fn behind(self, nodes: usize, leaves: usize) -> Self {
        match self {
            Self::NONE => self,
            Self(leaf) if leaf & LEAF != 0 => Self(leaf + leaves as u32),
            Self(node) => Self(node + nodes as u32),
        }
    }
}
