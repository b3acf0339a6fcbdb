//! A triangle mesh to signed distances at the nodes of a grid.
//!
//! Exact distances near the triangles; which side a node is on comes from flooding the outside from
//! the border, because real heads are open at the shoulders and have bags for eyes and mouth, so
//! that normals alone would tell a wrong side. Farther away nodes take the nearest point that their
//! neighbours know.

use std::ops::Range;

use frisure_strands::Surface;
use glam::DVec3;
use rayon::prelude::*;

use super::samples::Samples;
use super::triangles::{Soup, closest_point};
use super::voxel_grid::{FAR, Grid, NONE, Node};

/// Grid spacing where the mesh is of human size (m). Chosen: within 0.3 mm of a smooth mesh.
const SPACING: f64 = 3e-3;
/// Room around the mesh (m): hair that stands away farther than this meets the extrapolation. Chosen.
const MARGIN: f64 = 0.04;
/// Most nodes in a grid: 5.5 million of 4 bytes. A guard on memory.
const MOST_NODES: f64 = 5.5e6;
/// Nodes this near (spacings) get an exact distance: all corners, √3 away, of cells that the mesh passes.
const BAND: f64 = 1.8;
/// The outside flows only through nodes farther from the mesh than this (spacings): what lies
/// behind a narrower slit is inside. Chosen: a slit of 6 mm.
const CLEARANCE: f64 = 1.0;
/// Steps from a node with clearance to one near the skin. Chosen: more than the clearance along each axis.
const SHORE: usize = 4;
/// What the rounding of distances may add up to (m): `f32` distances within the band have steps below 1 nm, and bounds
/// in `f64` err by far less.
const SLACK: f64 = 1e-8;
/// How far beside a face an edge of the grid that meets it may be (m): above the breadth by which [`covers`] is too large.
/// Chosen; no result depends on it.
const BESIDE: f64 = 1e-6;
/// Layers of nodes that one task fills. Chosen; no result depends on it.
const SLAB: usize = 8;
/// Spacing of the grid of a torso (m). Chosen: its skin bends over centimetres.
const TORSO_SPACING: f64 = 8e-3;

/// A part of a mesh, and the box (m) and spacing (m) of a grid for it.
pub(crate) struct Region {
    low: DVec3,
    high: DVec3,
    spacing: f64,
    /// Heights (m) between which faces belong to the part.
    heights: [f64; 2],
}

impl Region {
    /// The whole mesh.
    pub(crate) fn whole(surface: &Surface) -> Self {
        let (low, high) = surface.bounds();
        Self { low, high, spacing: SPACING, heights: [f64::NEG_INFINITY, f64::INFINITY] }
    }

    /// What is higher than `height` (m); the grid fits into the box `frame` (m), if there is one.
    pub(crate) fn above(surface: &Surface, height: f64, frame: Option<(DVec3, DVec3)>) -> Self {
        let (low, high) = frame.unwrap_or_else(|| bounds(surface, |p| p.z >= height));
        Self { low, high, spacing: SPACING, heights: [low.z - MARGIN, f64::INFINITY] }
    }

    /// What is lower than `height` (m).
    pub(crate) fn below(surface: &Surface, height: f64) -> Self {
        let (low, high) = bounds(surface, |p| p.z <= height);
        Self { low, high, spacing: TORSO_SPACING, heights: [f64::NEG_INFINITY, height] }
    }

    fn has(&self, corners: [DVec3; 3]) -> bool {
        corners.iter().all(|c| (self.heights[0]..=self.heights[1]).contains(&c.z))
    }
}

/// Smallest and largest corner of the box around some vertices (m); around all where there is none.
fn bounds(surface: &Surface, chosen: impl Fn(&DVec3) -> bool) -> (DVec3, DVec3) {
    let mut points = surface.positions().iter().copied().filter(chosen);
    let Some(first) = points.next() else { return surface.bounds() };
    points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)))
}

/// The signed distance to a part of `surface` (m), positive outside, on a grid around it.
pub(crate) fn sample(surface: &Surface, region: &Region) -> Samples {
    // 1. Exact distances near the closed mesh. 2. Which nodes are outside. 3. Without faces that no node outside has as its
    // nearest. 4. What distances everywhere else follow from.
    let soup = Soup::closed(surface, |corners| region.has(corners));
    let grid = Grid::around(region);
    let mut band = vec![FAR; grid.len()];
    grid.splat(&soup, &mut band, |_| true);
    let outside = grid.flood(&band);
    let kept = soup.grow(&outer_faces(&band, &outside, soup.len()), 1.5 * grid.spacing);
    let soup = soup.only(&kept);
    // Inner faces (a mouth bag, the double of a skin) must not attract: measure again without them.
    grid.splat(&soup, &mut band, |node| node.face != NONE && !kept[node.face as usize]);
    let reach = BAND * grid.spacing;
    Samples::new(grid, &band, &outside, soup, reach)
}

impl Grid {
    fn around(region: &Region) -> Self {
        let (low, high) = (region.low, region.high);
        let extent = high - low + DVec3::splat(2.0 * MARGIN);
        let spacing = (extent.x * extent.y * extent.z / MOST_NODES).cbrt().max(region.spacing);
        // The cast cannot lose a sign: an extent is at least two margins. Odd, so that every second
        // node includes the last.
        let size = (extent / spacing).to_array().map(|n| (n.ceil() as usize + 3) | 1);
        Self { origin: low - DVec3::splat(MARGIN + spacing), spacing, size }
    }

    /// Exact distance, nearest face and crossed edges of the nodes near the mesh that are `wrong`.
    fn splat(&self, soup: &Soup, nodes: &mut [Node], wrong: impl Fn(&Node) -> bool + Sync) {
        let reach = BAND * self.spacing;
        let mut slabs = vec![Vec::new(); self.size[2].div_ceil(SLAB)];
        for face in (0..soup.len()).filter(|&f| soup.has(f)) {
            let near = self.near(soup.corners(face), reach);
            // A part of a mesh may reach out of its grid.
            for slab in slabs.iter_mut().take(near[1][2] / SLAB + 1).skip(near[0][2] / SLAB) {
                slab.push(face as u32);
            }
        }
        nodes.par_chunks_mut(SLAB * self.layer()).zip(slabs).enumerate().for_each(
            |(index, (nodes, mut faces))| {
                let base = index * SLAB;
                let Some(part) = self.reset(nodes, base, &wrong) else { return };
                let meets = |near: [[usize; 3]; 2]| {
                    (0..3).all(|a| near[0][a] <= part[1][a] && near[1][a] >= part[0][a])
                };
                faces.retain(|&f| meets(self.near(soup.corners(f as usize), reach)));
                let mut most = vec![f32::INFINITY; nodes.len()];
                for &face in &faces {
                    self.bound(&mut most, base, soup.corners(face as usize), reach);
                }
                for &face in &faces {
                    self.splat_face(nodes, &most, base, soup.corners(face as usize), face, reach);
                }
            },
        );
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

    /// Lowers to the squared distance (m²) from the middle of a face what bounds the distance to the mesh from above.
    fn bound(&self, most: &mut [f32], base: usize, corners: [DVec3; 3], reach: f64) {
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        self.for_rows([middle; 3], base, most.len(), reach, |row, start, range| {
            let across = (start - middle).with_x(0.0).length_squared();
            let x = start.x - middle.x;
            for (i, most) in range.clone().zip(&mut most[row + range.start..row + range.end]) {
                let x = x + self.spacing * i as f64;
                *most = most.min((across + x * x) as f32);
            }
        });
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

    /// Calls `visit(index of the row in the slab, position of its first node (m), nodes of the row)` for the rows of the slab
    /// of `count` nodes that begins at layer `base`, and the nodes in them that may be within `reach` (m) of a triangle.
    fn for_rows(
        &self,
        corners: [DVec3; 3],
        base: usize,
        count: usize,
        reach: f64,
        mut visit: impl FnMut(usize, DVec3, Range<usize>),
    ) {
        let (middle, radius) = bounding_ball(corners);
        let farthest = reach + radius + SLACK;
        let [low, high] = self.near(corners, reach);
        let top = (base + count / self.layer() - 1).min(high[2]);
        for k in low[2].max(base)..=top {
            for j in low[1]..=high[1] {
                let row = ((k - base) * self.size[1] + j) * self.size[0];
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
                    visit(row, start, from..to + 1);
                }
            }
        }
    }

    /// Offers one face to the nodes of the slab that begins at layer `base`; no node is farther from the mesh than the root
    /// of its `most` (m²).
    fn splat_face(
        &self,
        nodes: &mut [Node],
        most: &[f32],
        base: usize,
        corners: [DVec3; 3],
        face: u32,
        reach: f64,
    ) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let (middle, radius) = bounding_ball(corners);
        let edge = self.spacing + SLACK;
        let room = DVec3::splat(BESIDE);
        let (low, high) = (a.min(b).min(c) - room, a.max(b).max(c) + room);
        self.for_rows(corners, base, nodes.len(), reach, |row, start, range| {
            for i in range {
                let p = start.with_x(start.x + self.spacing * i as f64);
                let node = &mut nodes[row + i];
                // The face matters to a node if it is nearer than the nearest yet, or may cross an edge. Its plane and a
                // ball around it rule most nodes out: no point of the face is nearer than either.
                let near = f64::from(node.distance.min(most[row + i].sqrt())).min(reach) + SLACK;
                let (height, away) = ((p - a).dot(normal).abs(), p.distance_squared(middle));
                let matters =
                    |least: f64| height <= least && away <= (least + radius) * (least + radius);
                if matters(near) {
                    let distance = p.distance(closest_point(p, corners)) as f32;
                    if distance < node.distance && f64::from(distance) <= reach {
                        (node.distance, node.face) = (distance, face);
                    }
                }
                // An edge of the grid that meets the face begins in its box or below it, and passes through the box.
                let below = [p.x <= high.x, p.y <= high.y, p.z <= high.z];
                if below == [true; 3] && matters(edge) && p.cmpge(low).bitmask().count_ones() >= 2 {
                    node.crossed |= crossed_edges(p, self.spacing, corners, normal);
                }
            }
        });
    }

    /// True at the nodes outside: reached from the border with clearance, or in a few steps from
    /// such a node without crossing a face.
    fn flood(&self, nodes: &[Node]) -> Vec<bool> {
        let clearance = (CLEARANCE * self.spacing) as f32;
        let clear: Vec<bool> = nodes.iter().map(|node| node.distance > clearance).collect();
        let mut outside = self.flood_clear(&clear);
        // The shore: nodes outside with a neighbour without clearance.
        let mut shore = Vec::new();
        for at in (0..nodes.len()).filter(|&at| !clear[at]) {
            self.for_neighbours(at, |next, _, _| {
                if outside[next] {
                    shore.push(next);
                }
            });
        }
        for _ in 0..SHORE {
            let mut nearer = Vec::new();
            for &at in &shore {
                self.for_neighbours(at, |next, owner, axis| {
                    if !outside[next] && nodes[owner].crossed >> axis & 1 == 0 {
                        outside[next] = true;
                        nearer.push(next);
                    }
                });
            }
            shore = nearer;
        }
        outside
    }

    /// True at the nodes that a flood through `clear` ones reaches from the first node of the grid, run by run along x.
    fn flood_clear(&self, clear: &[bool]) -> Vec<bool> {
        let [width, depth, height] = self.size;
        let mut reached = vec![false; clear.len()];
        let mut open = vec![0];
        while let Some(seed) = open.pop() {
            if reached[seed] {
                continue;
            }
            // The run of clear nodes around the seed.
            let (row, i) = (seed / width * width, seed % width);
            let is_clear = |i: &usize| clear[row + i];
            let from = (0..i).rev().take_while(is_clear).last().unwrap_or(i);
            let to = (i + 1..width).take_while(is_clear).last().unwrap_or(i);
            reached[row + from..=row + to].fill(true);
            // The first node of each clear run beside it in the four rows around.
            let (j, k) = (row / width % depth, row / self.layer());
            let around = [
                (j > 0).then(|| row - width),
                (j + 1 < depth).then_some(row + width),
                (k > 0).then(|| row - self.layer()),
                (k + 1 < height).then_some(row + self.layer()),
            ];
            for row in around.into_iter().flatten() {
                let mut before = false;
                for at in row + from..=row + to {
                    let goes_on = clear[at] && !reached[at];
                    if goes_on && !before {
                        open.push(at);
                    }
                    before = goes_on;
                }
            }
        }
        reached
    }

    /// Calls `visit(neighbour, node that owns the edge, axis)` for the six neighbours of a node.
    fn for_neighbours(&self, at: usize, mut visit: impl FnMut(usize, usize, usize)) {
        let at3 = self.unravel(at);
        for (axis, stride) in [1, self.size[0], self.layer()].into_iter().enumerate() {
            if at3[axis] > 0 {
                visit(at - stride, at - stride, axis);
            }
            if at3[axis] + 1 < self.size[axis] {
                visit(at + stride, at, axis);
            }
        }
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

/// Faces that are nearest to some node outside.
fn outer_faces(nodes: &[Node], outside: &[bool], count: usize) -> Vec<bool> {
    let mut outer = vec![false; count];
    for (node, _) in nodes.iter().zip(outside).filter(|(n, out)| **out && n.face != NONE) {
        outer[node.face as usize] = true;
    }
    outer
}
