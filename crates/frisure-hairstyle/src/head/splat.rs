//! Distances of the nodes of a grid near triangles: each triangle is offered to the nodes around it.

use fearless_simd::{Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f32x8};
use glam::DVec3;

use super::triangles::{Soup, closest_point};
use super::voxel_grid::{FAR, Grid, NONE, Node};
use crate::parallel;

/// What the rounding of distances may add up to (m): `f32` distances within the band have steps below 1 nm, and bounds
/// in `f64` err by far less.
const SLACK: f64 = 1e-8;
/// What the rounding of a first look in single precision may add to a distance, per length of what is looked at: a step is 6e-8, and
/// a square has about six.
const ROUNDING: f64 = 2e-6;
/// How far beside a face an edge of the grid that meets it may be (m): above the breadth by which [`covers`] is too large.
/// Chosen; no result depends on it.
const BESIDE: f64 = 1e-6;
/// Layers of nodes that one task fills. Chosen; no result depends on it.
const SLAB: usize = 8;
/// Nodes of a row that are looked at at once.
const LANES: usize = 8;

/// Some layers of nodes.
struct Slab<'a> {
    /// Its first layer.
    base: usize,
    nodes: &'a mut [Node],
    /// No node is farther from the mesh (m), but for those whose nearest face is known, which have less; [`LANES`] more than nodes.
    limits: Vec<f32>,
    /// Nodes farther from the mesh (m) are of no interest.
    reach: f64,
}

/// First and last node of a box along each axis.
type Nodes = [[usize; 3]; 2];

/// A triangle, and what bounds it.
struct Face {
    index: u32,
    corners: [DVec3; 3],
    normal: DVec3,
    /// A ball around it (m).
    middle: DVec3,
    radius: f64,
    /// A box around it (m), [`BESIDE`] larger.
    low: DVec3,
    high: DVec3,
}

impl Grid {
    /// Exact distance, nearest face and crossed edges of the nodes within `reach` (m) of the mesh that are `wrong`.
    pub(crate) fn splat(
        &self,
        soup: &Soup,
        reach: f64,
        nodes: &mut [Node],
        wrong: impl Fn(&Node) -> bool + Sync,
    ) {
        let mut slabs = vec![Vec::new(); self.size[2].div_ceil(SLAB)];
        for face in (0..soup.len()).filter(|&f| soup.has(f)) {
            let near = self.near(soup.corners(face), reach);
            // A part of a mesh may reach out of its grid.
            for slab in slabs.iter_mut().take(near[1][2] / SLAB + 1).skip(near[0][2] / SLAB) {
                slab.push(face as u32);
            }
        }
        let level = Level::new();
        let mut slabs: Vec<_> = nodes.chunks_mut(SLAB * self.layer()).zip(slabs).collect();
        parallel::for_each_mut(&mut slabs, |index, (nodes, faces)| {
            let base = index * SLAB;
            let Some(part) = self.reset(nodes, base, &wrong) else { return };
            let meets =
                |near: Nodes| (0..3).all(|a| near[0][a] <= part[1][a] && near[1][a] >= part[0][a]);
            faces.retain(|&f| meets(self.near(soup.corners(f as usize), reach)));
            let limits = vec![f32::INFINITY; nodes.len() + LANES];
            let mut slab = Slab { base, nodes, limits, reach };
            dispatch!(level, simd => self.fill(simd, &mut slab, soup, faces));
        });
    }

    /// Offers faces to the nodes of a slab, with the instruction set that `dispatch!` selects; `inline(always)` is what makes it so.
    #[inline(always)]
    fn fill<S: Simd>(&self, simd: S, slab: &mut Slab<'_>, soup: &Soup, faces: &[u32]) {
        for &face in faces {
            self.bound(simd, slab, soup.corners(face as usize));
        }
        for (limit, node) in slab.limits.iter_mut().zip(&*slab.nodes) {
            // Where the nearest face is known no other is nearer.
            *limit = if node.face == NONE { limit.sqrt() } else { f32::NEG_INFINITY };
        }
        for &face in faces {
            let face = Face::new(face, soup.corners(face as usize));
            self.offer(simd, slab, &face);
            self.cross(slab, &face);
        }
    }

    /// First and last node, along each axis, that may be within `reach` (m) of a triangle.
    fn near(&self, [a, b, c]: [DVec3; 3], reach: f64) -> Nodes {
        let reach = DVec3::splat(reach);
        [self.first(a.min(b).min(c) - reach), self.last(a.max(b).max(c) + reach)]
    }

    /// Forgets what is known of the nodes that are `wrong` in the slab that begins at layer `base`; their first and last
    /// along each axis, if there are any.
    fn reset(
        &self,
        nodes: &mut [Node],
        base: usize,
        wrong: impl Fn(&Node) -> bool,
    ) -> Option<Nodes> {
        let mut part = [[usize::MAX; 3], [0; 3]];
        for (row, nodes) in nodes.chunks_mut(self.size[0]).enumerate() {
            for (i, node) in nodes.iter_mut().enumerate().filter(|(_, node)| wrong(node)) {
                *node = FAR;
                let at = [i, row % self.size[1], base + row / self.size[1]];
                for axis in 0..3 {
                    part[0][axis] = part[0][axis].min(at[axis]);
                    part[1][axis] = part[1][axis].max(at[axis]);
                }
            }
        }
        (part[0][0] != usize::MAX).then_some(part)
    }

    /// First node of the grid with no coordinate below `p`.
    fn first(&self, p: DVec3) -> [usize; 3] {
        ((p - self.origin) / self.spacing).to_array().map(|u| u.ceil().max(0.0) as usize)
    }

    /// Last node of the grid with no coordinate above `p`.
    fn last(&self, p: DVec3) -> [usize; 3] {
        let u = ((p - self.origin) / self.spacing).to_array();
        [0, 1, 2].map(|a| (u[a].max(0.0) as usize).min(self.size[a] - 1))
    }

    /// Calls `visit` for the rows of a box of nodes in a slab, with the index in the slab of the row's first node in the box, and its
    /// place in the grid.
    #[inline(always)]
    fn for_rows(
        &self,
        slab: &mut Slab<'_>,
        [low, high]: Nodes,
        mut visit: impl FnMut(&mut Slab<'_>, usize, [usize; 3]),
    ) {
        let top = slab.base + slab.nodes.len() / self.layer() - 1;
        for k in low[2].max(slab.base)..=high[2].min(top) {
            for j in low[1]..=high[1] {
                let at = ((k - slab.base) * self.size[1] + j) * self.size[0] + low[0];
                visit(slab, at, [low[0], j, k]);
            }
        }
    }

    /// Boxes as wide as the nodes of a row that are looked at at once, or less, which make up a box.
    fn pieces([low, high]: Nodes) -> impl Iterator<Item = Nodes> {
        let firsts = (low[0]..=high[0]).step_by(LANES);
        firsts.map(move |first| {
            let last = (first + LANES - 1).min(high[0]);
            [[first, low[1], low[2]], [last, high[1], high[2]]]
        })
    }

    /// How far (m) the nodes of a row that are looked at at once are from the first.
    #[inline(always)]
    fn steps<S: Simd>(&self, simd: S) -> f32x8<S> {
        let steps: [f32; LANES] = std::array::from_fn(|lane| (self.spacing * lane as f64) as f32);
        f32x8::from_slice(simd, &steps)
    }

    /// Lowers the squares of the limits (m²) to the squared distance from the middle of a face, which bounds that to the mesh.
    #[inline(always)]
    fn bound<S: Simd>(&self, simd: S, slab: &mut Slab<'_>, corners: [DVec3; 3]) {
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        let steps = self.steps(simd);
        for piece in Self::pieces(self.near([middle; 3], slab.reach)) {
            let x = single(simd, (self.position(piece[0]) - middle).x) + steps;
            let along = x * x;
            // More than the steps to the nodes of the piece, and less than those to others.
            let width = (piece[1][0] - piece[0][0]) as f64 + 0.5;
            let in_piece = steps.simd_lt(single(simd, width * self.spacing));
            self.for_rows(
                slab,
                piece,
                #[inline(always)]
                |slab, at, first| {
                    let across = (self.position(first) - middle).with_x(0.0).length_squared();
                    let limits = &mut slab.limits[at..at + LANES];
                    let old = f32x8::from_slice(simd, limits);
                    let new = old.min(along + single(simd, across));
                    in_piece.select(new, old).store_slice(limits);
                },
            );
        }
    }

    /// Offers one face to the nodes of a slab that it may be the nearest of.
    ///
    /// The plane of the face and a circle around it in this plane rule most nodes out, because no point of the face is nearer than the
    /// nearest of the circle's disc.
    #[inline(always)]
    fn offer<S: Simd>(&self, simd: S, slab: &mut Slab<'_>, face: &Face) {
        let steps = self.steps(simd);
        let margin = SLACK + ROUNDING * (slab.reach + 2.0 * face.radius);
        let (margin, radius) = (single(simd, margin), single(simd, face.radius + margin));
        let reach = single(simd, slab.reach);
        for piece in Self::pieces(self.near(face.corners, slab.reach)) {
            let start = self.position(piece[0]);
            let x = single(simd, start.x - face.middle.x) + steps;
            let along = x * x;
            let rise =
                (single(simd, start.x - face.corners[0].x) + steps) * single(simd, face.normal.x);
            let in_piece = (1 << (piece[1][0] - piece[0][0] + 1)) - 1;
            self.for_rows(
                slab,
                piece,
                #[inline(always)]
                |slab, at, first| {
                    let start = self.position(first);
                    let height = (start - face.corners[0]).with_x(0.0).dot(face.normal);
                    let across = (start - face.middle).with_x(0.0).length_squared();
                    let height = (rise + single(simd, height)).abs();
                    let away = along + single(simd, across);
                    let limits = f32x8::from_slice(simd, &slab.limits[at..at + LANES]);
                    let near = limits.min(reach) + margin;
                    // How far beside the face its plane is as near as the limit.
                    let square = height * height;
                    let beside = (near * near - square).max(0.0).sqrt() + radius;
                    let matters = height.simd_le(near) & (away - square).simd_le(beside * beside);
                    let mut left = matters.to_bitmask() & in_piece;
                    while left != 0 {
                        let lane = left.trailing_zeros() as usize;
                        let p = self.position([first[0] + lane, first[1], first[2]]);
                        slab.measure(at + lane, p, face);
                        left &= left - 1;
                    }
                },
            );
        }
    }

    /// Notes which edges of the grid from the nodes of a slab a face crosses.
    #[inline(always)]
    fn cross(&self, slab: &mut Slab<'_>, face: &Face) {
        // An edge that meets the face begins in its box or below it, and passes through the box.
        let (edge, room) = (self.spacing + SLACK, DVec3::splat(BESIDE));
        let nodes = [self.first(face.low - DVec3::splat(edge) - room), self.last(face.high + room)];
        self.for_rows(
            slab,
            nodes,
            #[inline(always)]
            |slab, at, first| {
                for i in first[0]..=nodes[1][0] {
                    let p = self.position([i, first[1], first[2]]);
                    let beside = p.cmpge(face.low).bitmask().count_ones();
                    if beside >= 2 && p.cmple(face.high).all() && face.may_be_within(edge, p) {
                        slab.nodes[at + i - first[0]].crossed |=
                            crossed_edges(p, self.spacing, face.corners, face.normal);
                    }
                }
            },
        );
    }
}

/// A number in all lanes.
#[inline(always)]
fn single<S: Simd>(simd: S, x: f64) -> f32x8<S> {
    f32x8::splat(simd, x as f32)
}

impl Slab<'_> {
    /// Measures how far the node `at`, which is at `p` (m), is from a face.
    fn measure(&mut self, at: usize, p: DVec3, face: &Face) {
        let distance = p.distance(closest_point(p, face.corners)) as f32;
        let node = &mut self.nodes[at];
        if distance < node.distance && f64::from(distance) <= self.reach {
            (node.distance, node.face) = (distance, face.index);
            self.limits[at] = self.limits[at].min(distance);
        }
    }
}

impl Face {
    fn new(index: u32, corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let (middle, radius) = bounding_ball(corners);
        let room = DVec3::splat(BESIDE);
        let (low, high) = (a.min(b).min(c) - room, a.max(b).max(c) + room);
        Self { index, corners, normal, middle, radius, low, high }
    }

    /// False only where no point of the face is within `reach` (m) of `p` (m).
    #[inline(always)]
    fn may_be_within(&self, reach: f64, p: DVec3) -> bool {
        let height = (p - self.corners[0]).dot(self.normal).abs();
        let within = reach + self.radius;
        height <= reach && p.distance_squared(self.middle) <= within * within
    }
}

/// The middle of a triangle (m), and how far it reaches from there (m).
fn bounding_ball(corners: [DVec3; 3]) -> (DVec3, f64) {
    let middle = corners.iter().sum::<DVec3>() / 3.0;
    let radius = corners.iter().map(|c| c.distance_squared(middle)).fold(0.0, f64::max);
    (middle, radius.sqrt())
}

/// Bit a is set where the triangle meets the segment of length `h` from `p` along axis a.
fn crossed_edges(p: DVec3, h: f64, corners: [DVec3; 3], normal: DVec3) -> u8 {
    let mut bits = 0;
    for axis in 0..3 {
        let t = (corners[0] - p).dot(normal) / normal[axis];
        if t >= -1e-9 && t <= h + 1e-9 && covers(corners, p, axis) {
            bits |= 1 << axis;
        }
    }
    bits
}

/// Whether the line through `p` along `axis` meets the triangle. A hair's breadth too large: two
/// faces that share an edge must not leave a gap between them.
fn covers(corners: [DVec3; 3], p: DVec3, axis: usize) -> bool {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let side = |a: DVec3, b: DVec3| (b[u] - a[u]) * (p[v] - a[v]) - (b[v] - a[v]) * (p[u] - a[u]);
    let [a, b, c] = corners;
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|&s| s >= -1e-12) || sides.iter().all(|&s| s <= 1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::ball;
    use frisure_strands::Surface;

    /// Triangles of all sizes from 0.1 mm to 6 cm, in no order.
    fn shards() -> Surface {
        let at = |a: f64| DVec3::new((1.3 * a).sin(), (0.7 * a).cos(), (2.1 * a).sin());
        let shard = |n: u32| {
            let (a, size) = (f64::from(n), 1e-4 * 600_f64.powf(f64::from(n) / 60.0));
            [0.0, 1.0, 2.0].map(|k| 0.03 * at(a) + size * at(17.0 * a + 5.0 * k))
        };
        let positions: Vec<DVec3> = (0..60).flat_map(shard).collect();
        let triangles = (0..60).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
        Surface::new(positions, triangles).unwrap()
    }

    #[test]
    fn nodes_have_the_distance_to_the_nearest_face_to_the_bit() {
        let spacing = 3e-3;
        let reach = 1.8 * spacing;
        let grid = Grid { origin: DVec3::splat(-0.045), spacing, size: [31, 31, 31] };
        for surface in [ball(0.035, 9), shards()] {
            let soup = Soup::closed(&surface, |_| true);
            let mut nodes = vec![FAR; grid.len()];
            grid.splat(&soup, reach, &mut nodes, |_| true);
            for (at, node) in nodes.iter().enumerate() {
                let p = grid.position(grid.unravel(at));
                let distance = |f: usize| p.distance(closest_point(p, soup.corners(f))) as f32;
                // Of equal distances the first.
                let all = (0..soup.len()).map(|f| (distance(f), f as u32));
                let exact = all.min_by(|a, b| a.0.total_cmp(&b.0));
                let near = exact.filter(|exact| f64::from(exact.0) <= reach);
                assert_eq!((node.distance, node.face), near.unwrap_or((FAR.distance, NONE)), "{p}");
            }
            assert!(nodes.iter().filter(|node| node.face != NONE).count() > 1000);
            assert!(nodes.iter().filter(|node| node.crossed != 0).count() > 200);
        }
    }
}
