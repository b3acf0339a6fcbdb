//! The bounding volume hierarchy (BVH), eight children to a node, and its traversal.

use fearless_simd::{Level, Simd, SimdBase, SimdFloat, dispatch, f32x8};
use glam::{DVec3, Vec3};

use super::Ray;
use super::aabb::Aabb;
use super::build;
use super::node::{LEAF, Leaf, Node, Primitive, WideRay};
use super::simd::{LANES, Wide3, bits};

/// An 8-wide BVH with leaves of type `L`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bvh<L> {
    bounds: Aabb,
    nodes: Vec<Node>,
    leaves: Vec<L>,
}

/// The closest hit: a lane of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LeafHit<'a, L> {
    /// Distance (m).
    pub(super) t: f32,
    pub(super) leaf: &'a L,
    pub(super) lane: usize,
}

impl<L: Leaf> Bvh<L> {
    /// Builds the BVH over primitives.
    pub(super) fn new(all: &L::Primitives, primitives: &mut [Primitive]) -> Self {
        let bounds = primitives.iter().fold(Aabb::EMPTY, |b, p| b.union(p.bounds()));
        // What single precision makes of a ray and a box may differ by a few parts in 10⁷.
        let pad = 5e-7 * bounds.reach();
        let tree = build::tree(all, primitives, pad);
        Self { bounds: bounds.grown(2.0 * pad), nodes: tree.nodes, leaves: tree.leaves }
    }

    /// AABB around everything.
    pub(super) fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.leaves[..])
    }

    /// The closest hit before `t_max` (m).
    pub(super) fn closest_hit(
        &self,
        level: Level,
        ray: &Ray,
        t_max: f32,
    ) -> Option<LeafHit<'_, L>> {
        let (ray, skipped) = self.enter(ray, t_max)?;
        let found =
            dispatch!(level, simd => traverse::<_, L, false>(simd, self, &ray, t_max - skipped));
        found.map(|found| LeafHit { t: found.t + skipped, ..found })
    }

    /// Whether the ray hits anything before `t_max` (m): a shadow ray.
    pub(super) fn occluded(&self, level: Level, ray: &Ray, t_max: f32) -> bool {
        let Some((ray, skipped)) = self.enter(ray, t_max) else { return false };
        dispatch!(level, simd => traverse::<_, L, true>(simd, self, &ray, t_max - skipped).is_some())
    }

    /// The ray, moved to just before it enters the AABB of everything, and the distance moved (m); `None` if it misses,
    /// is not finite, or enters after `t_max`. From there coordinates are of the size of the AABB, however far away the
    /// eye is: precision that thin fibres need.
    fn enter(&self, ray: &Ray, t_max: f32) -> Option<(ClippedRay, f32)> {
        if !ray.is_finite() {
            return None;
        }
        let inverse = inverse(ray.direction());
        let (a, b) = (Vec3::from(self.bounds.low), Vec3::from(self.bounds.high));
        let (a, b) = ((a - ray.origin()) * inverse, (b - ray.origin()) * inverse);
        let (near, far) = (a.min(b).max_element(), a.max(b).min_element());
        let reach = self.bounds.reach();
        // A hundredth of the scene (chosen) and the rounding of the distance, so that nothing before the box is skipped.
        let slack = 0.01 * reach + 1e-6 * near.abs();
        if !(near - slack <= far.min(t_max)) || !(far + slack >= 0.0) {
            return None;
        }
        let skipped = (near - slack).max(0.0);
        let origin = ray.origin().as_dvec3() + f64::from(skipped) * DVec3::from(ray.direction());
        Some((
            ClippedRay { origin: origin.as_vec3(), direction: ray.direction(), inverse },
            skipped,
        ))
    }
}

/// A ray that starts near the scene, with the reciprocal of its direction.
struct ClippedRay {
    origin: Vec3,
    direction: Vec3,
    inverse: Vec3,
}

/// Reciprocal of each coordinate, large instead of infinite, so that nothing becomes NaN.
fn inverse(direction: Vec3) -> Vec3 {
    direction
        .to_array()
        .map(|d| 1.0 / if d.abs() < 1e-18 { 1e-18_f32.copysign(d) } else { d })
        .into()
}

/// Entries of the traversal stack: see `build`.
const STACK: usize = build::DEEPEST * (LANES - 1) + 1;

/// A child still to be visited, and the distance at which the ray enters it (m).
#[derive(Clone, Copy)]
struct StackEntry {
    near: f32,
    child: u32,
}

/// Traverses the BVH, nearest child first. With `ANY` it returns the first hit found (shadow rays).
#[inline(always)]
fn traverse<'a, S: Simd, L: Leaf, const ANY: bool>(
    simd: S,
    bvh: &'a Bvh<L>,
    ray: &ClippedRay,
    mut t_max: f32,
) -> Option<LeafHit<'a, L>> {
    let slabs = Slabs::new(simd, ray);
    let wide = WideRay {
        origin: Wide3::splat(simd, ray.origin),
        direction: Wide3::splat(simd, ray.direction),
    };
    let mut found = None;
    let mut stack = [StackEntry { near: 0.0, child: 0 }; STACK];
    let mut height = usize::from(!bvh.nodes.is_empty());
    while height > 0 {
        height -= 1;
        let visit = stack[height];
        if visit.near >= t_max {
            continue;
        }
        let mut child = visit.child;
        while child & LEAF == 0 {
            let node = &bvh.nodes[child as usize];
            let (near, bits) = slabs.enter(node, t_max);
            match nearest(node, &near, bits, &mut stack, &mut height) {
                Some(next) => child = next,
                None => break,
            }
        }
        if child & LEAF == 0 {
            continue;
        }
        let leaf = &bvh.leaves[(child & !LEAF) as usize];
        let (t, bits) = leaf.intersect(simd, &wide, t_max);
        if bits != 0 {
            let (lane, t) = first(t.as_array(), bits);
            // Subtrees that begin behind the hit are skipped from here on.
            t_max = t;
            found = Some(LeafHit { t, leaf, lane });
            if ANY {
                return found;
            }
        }
    }
    found
}

/// The lane of the smallest distance among those in the bit mask, and that distance.
#[inline(always)]
fn first(t: &[f32; LANES], mut bits: u32) -> (usize, f32) {
    let mut best = (0, f32::INFINITY);
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize & (LANES - 1);
        bits &= bits - 1;
        if t[lane] < best.1 {
            best = (lane, t[lane]);
        }
    }
    best
}

/// The nearest child that the ray enters; pushes the others on the stack, the farthest first.
#[inline(always)]
fn nearest(
    node: &Node,
    near: &[f32; LANES],
    mut bits: u32,
    stack: &mut [StackEntry; STACK],
    height: &mut usize,
) -> Option<u32> {
    if bits == 0 {
        return None;
    }
    let mut take = || {
        let lane = bits.trailing_zeros() as usize & (LANES - 1);
        bits &= bits - 1;
        (StackEntry { near: near[lane], child: node.child[lane].0 }, bits != 0)
    };
    // Insertion sort of the children above `floor`: the stack stays sorted by distance, the nearest on top.
    let (mut best, mut more) = take();
    let floor = *height;
    while more {
        let (next, left) = take();
        more = left;
        let other = if next.near < best.near { std::mem::replace(&mut best, next) } else { next };
        let mut place = *height;
        *height += 1;
        while place > floor && stack[place - 1].near < other.near {
            stack[place] = stack[place - 1];
            place -= 1;
        }
        stack[place] = other;
    }
    Some(best.child)
}

/// A ray prepared for the slab test (Kay & Kajiya 1986).
struct Slabs<S: Simd> {
    simd: S,
    inverse: Wide3<S>,
    /// −origin × inverse
    offset: Wide3<S>,
    backward: [bool; 3],
}

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    fn new(simd: S, ray: &ClippedRay) -> Self {
        Self {
            simd,
            inverse: Wide3::splat(simd, ray.inverse),
            offset: Wide3::splat(simd, -ray.origin * ray.inverse),
            backward: ray.inverse.to_array().map(|i| i < 0.0),
        }
    }

    /// Distance at which the ray enters each AABB, and a bit mask of those that it enters before `t_max`.
    #[inline(always)]
    fn enter(&self, node: &Node, t_max: f32) -> ([f32; LANES], u32) {
        let (x0, x1) = self.slab(node, 0, self.inverse.x, self.offset.x);
        let (y0, y1) = self.slab(node, 1, self.inverse.y, self.offset.y);
        let (z0, z1) = self.slab(node, 2, self.inverse.z, self.offset.z);
        // t = x/d − o/d at both slabs of each axis: inside from the last entry to the first exit.
        let near = x0.max(y0).max(z0.max(0.0));
        let far = x1.min(y1).min(z1.min(t_max));
        (near.to_array(), bits(near.simd_le(far)))
    }

    /// Distances at which the ray enters and leaves the AABBs along an axis.
    #[inline(always)]
    fn slab(
        &self,
        node: &Node,
        axis: usize,
        inverse: f32x8<S>,
        offset: f32x8<S>,
    ) -> (f32x8<S>, f32x8<S>) {
        let (mut near, mut far) = (&node.low[axis], &node.high[axis]);
        if self.backward[axis] {
            std::mem::swap(&mut near, &mut far);
        }
        let near = near.load(self.simd).mul_add(inverse, offset);
        (near, far.load(self.simd).mul_add(inverse, offset))
    }
}
