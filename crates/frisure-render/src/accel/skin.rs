//! Intersection of a ray with eight triangles of the head at once.

use fearless_simd::{Simd, SimdBase, f32x8};
use frisure_strands::Surface;
use glam::{DVec3, Vec3};

use super::aabb::Aabb;
use super::node::{Leaf, Primitive, WideRay};
use super::simd::{LANES, Lanes, Wide3, bits};

/// A triangle: a corner, and the ways to the two others (m).
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    corner: Vec3,
    edges: [Vec3; 2],
    face: u32,
}

impl Triangle {
    /// The faces of a surface that have an area.
    pub(super) fn of(surface: &Surface) -> Vec<Self> {
        let faces = 0..surface.triangles().len();
        let triangle = |face: usize| {
            let [a, b, c] = surface.corners(face).map(DVec3::as_vec3);
            Self { corner: a, edges: [b - a, c - a], face: face as u32 }
        };
        faces.map(triangle).filter(|t| t.edges[0].cross(t.edges[1]) != Vec3::ZERO).collect()
    }

    pub(super) fn bounds(&self) -> Aabb {
        let [b, c] = self.edges.map(|edge| self.corner + edge);
        let (low, high) = (self.corner.min(b).min(c), self.corner.max(b).max(c));
        Aabb { low: low.into(), high: high.into() }
    }
}

/// Margin over the edges of a triangle, in barycentric weights, against rays that slip between triangles; chosen.
const OVERLAP: f32 = 1e-5;

/// Up to eight triangles, side by side; unused lanes have no area.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(super) struct SkinLeaf {
    corner: [Lanes; 3],
    edges: [[Lanes; 3]; 2],
    face: [u32; LANES],
}

impl Leaf for SkinLeaf {
    type Primitives = [Triangle];

    fn new(triangles: &[Triangle], primitives: &[Primitive]) -> Self {
        let zero = [Lanes([0.0; LANES]); 3];
        let mut leaf = Self { corner: zero, edges: [zero; 2], face: [0; LANES] };
        for (lane, primitive) in primitives.iter().enumerate() {
            leaf.put(lane, &triangles[primitive.index()]);
        }
        leaf
    }

    /// Möller & Trumbore 1997, both sides. Without area the determinant is 0 and its inverse
    /// infinite: no comparison then holds.
    #[inline(always)]
    fn intersect<S: Simd>(&self, simd: S, ray: &WideRay<S>, t_max: f32) -> (f32x8<S>, u32) {
        let [e1, e2] = [Wide3::load(simd, &self.edges[0]), Wide3::load(simd, &self.edges[1])];
        let p = ray.direction.cross(e2);
        let inverse = 1.0 / e1.dot(p);
        let x = ray.origin - Wide3::load(simd, &self.corner);
        let u = x.dot(p) * inverse;
        let q = x.cross(e1);
        let v = ray.direction.dot(q) * inverse;
        let t = e2.dot(q) * inverse;
        let within = u.min(v).simd_ge(-OVERLAP) & (u + v).simd_le(1.0 + OVERLAP);
        let ahead = t.simd_ge(0.0) & t.simd_lt(t_max);
        (t, bits(within & ahead))
    }
}

impl SkinLeaf {
    fn put(&mut self, lane: usize, triangle: &Triangle) {
        for axis in 0..3 {
            self.corner[axis].0[lane] = triangle.corner[axis];
            self.edges[0][axis].0[lane] = triangle.edges[0][axis];
            self.edges[1][axis].0[lane] = triangle.edges[1][axis];
        }
        self.face[lane] = triangle.face;
    }

    /// The face in a lane.
    pub(super) fn face(&self, lane: usize) -> u32 {
        self.face[lane]
    }
}
