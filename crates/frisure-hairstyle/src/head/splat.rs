//! Distances of the nodes of a grid near triangles: each triangle is offered to the nodes around it.

use std::ops::Range;

use fearless_simd::{Level, Select, Simd, SimdBase, SimdMask, dispatch, f32x8};
use glam::DVec3;
use rayon::prelude::*;

use super::triangles::{Soup, closest_point};
use super::voxel_grid::{FAR, Grid, Node};

/// What the rounding of distances may add up to (m): `f32` distances within the band have steps below 1 nm, and bounds
/// in `f64` err by far less.
const SLACK: f64 = 1e-8;
/// What the rounding of a first look in single precision may add to a distance, per length of what is looked at: a step is 6e-8, and
/// a distance to a plane has about five.
const ROUNDING: f64 = 1e-6;
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
    /// No node is farther from the mesh (m); [`LANES`] more than nodes.
    limits: Vec<f32>,
    /// Nodes farther from the mesh (m) are of no interest.
    reach: f64,
}

/// Nodes of a row that may be near a triangle.
struct Row {
    /// Index of the row's first node in the slab.
    at: usize,
    /// Position of that node (m).
    start: DVec3,
    near: Range<usize>,
}

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
        nodes.par_chunks_mut(SLAB * self.layer()).zip(slabs).enumerate().for_each(
            |(index, (nodes, mut faces))| {
                let base = index * SLAB;
                let Some(part) = self.reset(nodes, base, &wrong) else { return };
                let meets = |near: [[usize; 3]; 2]| {
                    (0..3).all(|a| near[0][a] <= part[1][a] && near[1][a] >= part[0][a])
                };
                faces.retain(|&f| meets(self.near(soup.corners(f as usize), reach)));
                let limits = vec![f32::INFINITY; nodes.len() + LANES];
                let mut slab = Slab { base, nodes, limits, reach };
                dispatch!(level, simd => self.fill(simd, &mut slab, soup, &faces));
            },
        );
    }

    /// Offers faces to the nodes of a slab, with the instruction set that `dispatch!` selects; `inline(always)` is what makes it so.
    #[inline(always)]
    fn fill<S: Simd>(&self, simd: S, slab: &mut Slab<'_>, soup: &Soup, faces: &[u32]) {
        for &face in faces {
            self.bound(simd, slab, soup.corners(face as usize));
        }
        for (limit, node) in slab.limits.iter_mut().zip(&*slab.nodes) {
            *limit = limit.sqrt().min(node.distance);
        }
        for &face in faces {
            self.splat_face(simd, slab, &Face::new(face, soup.corners(face as usize)));
        }
    }

    /// First and last node, along each axis, that may be within `reach` (m) of a triangle.
    fn near(&self, [a, b, c]: [DVec3; 3], reach: f64) -> [[usize; 3]; 2] {
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
    ) -> Option<[[usize; 3]; 2]> {
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

    /// Calls `visit` for the rows of a slab with the nodes that may be within its reach of a triangle.
    #[inline(always)]
    fn for_rows(
        &self,
        slab: &mut Slab<'_>,
        corners: [DVec3; 3],
        mut visit: impl FnMut(&mut Slab<'_>, Row),
    ) {
        let (middle, radius) = bounding_ball(corners);
        let farthest = slab.reach + radius + SLACK;
        let [low, high] = self.near(corners, slab.reach);
        let top = (slab.base + slab.nodes.len() / self.layer() - 1).min(high[2]);
        for k in low[2].max(slab.base)..=top {
            for j in low[1]..=high[1] {
                let at = ((k - slab.base) * self.size[1] + j) * self.size[0];
                // The nodes of the row in a ball outside of which the face matters to none.
                let start = self.position([0, j, k]);
                let across = (start - middle).with_x(0.0).length_squared();
                let room = farthest * farthest - across;
                if room < 0.0 {
                    continue;
                }
                let ends = [-room.sqrt(), room.sqrt()];
                let [from, to] = ends.map(|x| (middle.x + x - start.x) / self.spacing);
                let (from, to) = (from.ceil().max(0.0) as usize, to.max(0.0) as usize);
                let (from, to) = (from.max(low[0]), to.min(high[0]));
                if from <= to {
                    visit(slab, Row { at, start, near: from..to + 1 });
                }
            }
        }
    }

    /// Lowers the squares of the limits (m²) to the squared distance from the middle of a face, which bounds that to the mesh.
    #[inline(always)]
    fn bound<S: Simd>(&self, simd: S, slab: &mut Slab<'_>, corners: [DVec3; 3]) {
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        let steps = self.steps(simd);
        self.for_rows(
            slab,
            [middle; 3],
            #[inline(always)]
            |slab, row| {
                let across = (row.start - middle).with_x(0.0).length_squared();
                let across = single(simd, across);
                for first in row.near.clone().step_by(LANES) {
                    let x = row.start.x - middle.x + self.spacing * first as f64;
                    let x = single(simd, x) + steps;
                    let limits = &mut slab.limits[row.at + first..][..LANES];
                    let old = f32x8::from_slice(simd, limits);
                    let in_row = steps.simd_lt(self.steps_before(simd, &row, first));
                    in_row.select(old.min(x * x + across), old).store_slice(limits);
                }
            },
        );
    }

    /// How far (m) the nodes of a row that are looked at at once are from the first.
    #[inline(always)]
    fn steps<S: Simd>(&self, simd: S) -> f32x8<S> {
        let steps: [f32; LANES] = std::array::from_fn(|lane| (self.spacing * lane as f64) as f32);
        f32x8::from_slice(simd, &steps)
    }

    /// What is more than the steps (m) from node `first` to the nodes of a row that may be near, and less than those to others.
    #[inline(always)]
    fn steps_before<S: Simd>(&self, simd: S, row: &Row, first: usize) -> f32x8<S> {
        let count = (row.near.end - first) as f64;
        single(simd, self.spacing * (count - 0.5))
    }

    /// Offers one face to the nodes of a slab.
    #[inline(always)]
    fn splat_face<S: Simd>(&self, simd: S, slab: &mut Slab<'_>, face: &Face) {
        self.for_rows(
            slab,
            face.corners,
            #[inline(always)]
            |slab, row| {
                for first in row.near.clone().step_by(LANES) {
                    // The face matters to a node if it is nearer than the nearest yet.
                    let mut left = self.may_be_nearest(simd, slab, face, &row, first);
                    while left != 0 {
                        let i = first + left.trailing_zeros() as usize;
                        slab.offer(row.at + i, self.on_row(&row, i), face);
                        left &= left - 1;
                    }
                }
                self.cross(slab, face, &row);
            },
        );
    }

    /// Position of node `i` of a row (m).
    #[inline(always)]
    fn on_row(&self, row: &Row, i: usize) -> DVec3 {
        row.start.with_x(row.start.x + self.spacing * i as f64)
    }

    /// A bit for each node of a row from `first` on, set where the face may be nearer than the limit: its plane and a ball around it
    /// rule most nodes out, because no point of the face is nearer than either.
    #[inline(always)]
    fn may_be_nearest<S: Simd>(
        &self,
        simd: S,
        slab: &Slab<'_>,
        face: &Face,
        row: &Row,
        first: usize,
    ) -> u64 {
        let start = row.start.with_x(row.start.x + self.spacing * first as f64);
        let (from_plane, from_middle) = (start - face.corners[0], start - face.middle);
        let steps = self.steps(simd);
        let height =
            single(simd, from_plane.dot(face.normal)) + single(simd, face.normal.x) * steps;
        let x = single(simd, from_middle.x) + steps;
        let away = x * x + single(simd, from_middle.with_x(0.0).length_squared());
        let margin = SLACK + ROUNDING * (slab.reach + 2.0 * face.radius);
        let limits = f32x8::from_slice(simd, &slab.limits[row.at + first..][..LANES]);
        let near = limits.min(single(simd, slab.reach)) + single(simd, margin);
        let within = near + single(simd, face.radius);
        let matters = height.abs().simd_le(near) & away.simd_le(within * within);
        let in_row = steps.simd_lt(self.steps_before(simd, row, first));
        (matters & in_row).to_bitmask()
    }

    /// Notes which edges of the grid from the nodes of a row the face crosses.
    #[inline(always)]
    fn cross(&self, slab: &mut Slab<'_>, face: &Face, row: &Row) {
        // An edge that meets the face begins in its box or below it, and passes through the box.
        let (low, high, y, z) = (face.low, face.high, row.start.y, row.start.z);
        let beside = usize::from(y >= low.y) + usize::from(z >= low.z);
        if y > high.y || z > high.z || beside == 0 {
            return;
        }
        let edge = self.spacing + SLACK;
        for i in row.near.clone() {
            let p = self.on_row(row, i);
            let in_box = p.x <= high.x && beside + usize::from(p.x >= low.x) >= 2;
            if in_box && face.may_be_within(edge, p) {
                slab.nodes[row.at + i].crossed |=
                    crossed_edges(p, self.spacing, face.corners, face.normal);
            }
        }
    }
}

/// A number in all lanes.
#[inline(always)]
fn single<S: Simd>(simd: S, x: f64) -> f32x8<S> {
    f32x8::splat(simd, x as f32)
}

impl Slab<'_> {
    /// Offers a face to the node `at`, which is at `p` (m).
    fn offer(&mut self, at: usize, p: DVec3, face: &Face) {
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
