//! A triangle mesh to signed distances at the nodes of a grid.
//!
//! Exact distances near the triangles; which side a node is on comes from flooding the outside from
//! the border, because real heads are open at the shoulders and have bags for eyes and mouth, so
//! that normals alone would tell a wrong side. Farther away nodes take the nearest point that their
//! neighbours know.

use frisure_strands::Surface;
use glam::DVec3;
use rayon::prelude::*;

use super::triangles::{Soup, closest_point};

/// Samples at `origin + spacing·(i, j, k)`, i fastest (m).
pub(crate) struct Voxels {
    pub(crate) origin: DVec3,
    pub(crate) spacing: f64,
    pub(crate) size: [usize; 3],
    pub(crate) values: Vec<f32>,
}

/// Grid spacing where the mesh is of human size (m).
const SPACING: f64 = 3e-3;
/// Room around the mesh (m): hair that stands away farther than this meets the extrapolation.
const MARGIN: f64 = 0.06;
/// Most nodes in a grid: 5.5 million of 4 bytes.
const MOST_NODES: f64 = 5.5e6;
/// Nodes this near (spacings) get an exact distance.
const BAND: f64 = 2.6;
/// The outside flows only through nodes farther from the mesh than this (spacings): what lies
/// behind a narrower slit is inside.
const CLEARANCE: f64 = 1.0;
/// Steps from a node with clearance to one near the skin.
const SHORE: usize = 4;
/// Layers of nodes that one task fills.
const SLAB: usize = 8;
const NONE: u32 = u32::MAX;

/// The signed distance to `surface` (m), positive outside, on a grid around it.
pub(crate) fn sample(surface: &Surface) -> Voxels {
    let soup = Soup::closed(surface);
    let grid = Grid::around(surface);
    let band = grid.splat(&soup);
    let outside = grid.flood(&band);
    let kept = soup.grow(&outer_faces(&band, &outside, soup.len()), 1.5 * grid.spacing);
    // Inner faces (a mouth bag, the double of a skin) must not attract: measure again without them.
    let (soup, band) = if kept.iter().all(|&k| k) {
        (soup, band)
    } else {
        let soup = soup.only(&kept);
        let band = grid.splat(&soup);
        (soup, band)
    };
    let values = grid.spread(band, &soup, &outside);
    Voxels { origin: grid.origin, spacing: grid.spacing, size: grid.size, values }
}

struct Grid {
    origin: DVec3,
    spacing: f64,
    size: [usize; 3],
}

/// What is known at one node near the mesh.
#[derive(Clone, Copy)]
struct Node {
    distance: f32,
    face: u32,
    nearest: [f32; 3],
    /// Bit a: a face crosses the edge to the next node along axis a.
    crossed: u8,
    /// The face was found by measuring all near ones, not taken from a neighbour.
    exact: bool,
}

const FAR: Node =
    Node { distance: f32::INFINITY, face: NONE, nearest: [0.0; 3], crossed: 0, exact: false };

impl Grid {
    fn around(surface: &Surface) -> Self {
        let (low, high) = surface.bounds();
        let extent = high - low + DVec3::splat(2.0 * MARGIN);
        let spacing = (extent.x * extent.y * extent.z / MOST_NODES).cbrt().max(SPACING);
        // The cast cannot lose a sign: an extent is at least two margins.
        let size = (extent / spacing).to_array().map(|n| n.ceil() as usize + 3);
        Self { origin: low - DVec3::splat(MARGIN + spacing), spacing, size }
    }

    fn position(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        self.origin + self.spacing * DVec3::new(i as f64, j as f64, k as f64)
    }

    fn unravel(&self, at: usize) -> [usize; 3] {
        [at % self.size[0], at / self.size[0] % self.size[1], at / self.layer()]
    }

    fn layer(&self) -> usize {
        self.size[0] * self.size[1]
    }

    fn len(&self) -> usize {
        self.layer() * self.size[2]
    }

    /// Exact distance, nearest face and crossed edges of the nodes near the mesh.
    fn splat(&self, soup: &Soup) -> Vec<Node> {
        let reach = BAND * self.spacing;
        let mut slabs = vec![Vec::new(); self.size[2].div_ceil(SLAB)];
        for face in 0..soup.len() {
            let [a, b, c] = soup.corners(face);
            let low = self.first(a.min(b).min(c) - DVec3::splat(reach));
            let high = self.last(a.max(b).max(c) + DVec3::splat(reach));
            for slab in &mut slabs[low[2] / SLAB..=high[2] / SLAB] {
                slab.push(face);
            }
        }
        let mut nodes = vec![FAR; self.len()];
        nodes.par_chunks_mut(SLAB * self.layer()).zip(slabs).enumerate().for_each(
            |(index, (nodes, faces))| {
                for face in faces {
                    self.splat_face(nodes, index * SLAB, soup.corners(face), face as u32, reach);
                }
            },
        );
        nodes
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

    /// Offers one face to the nodes of the slab that begins at layer `base`.
    fn splat_face(
        &self,
        nodes: &mut [Node],
        base: usize,
        corners: [DVec3; 3],
        face: u32,
        reach: f64,
    ) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let low = self.first(a.min(b).min(c) - DVec3::splat(reach));
        let high = self.last(a.max(b).max(c) + DVec3::splat(reach));
        let top = (base + nodes.len() / self.layer() - 1).min(high[2]);
        for k in low[2].max(base)..=top {
            for j in low[1]..=high[1] {
                let row = ((k - base) * self.size[1] + j) * self.size[0];
                for i in low[0]..=high[0] {
                    let p = self.position([i, j, k]);
                    if (p - a).dot(normal).abs() > reach {
                        continue;
                    }
                    let q = closest_point(p, corners);
                    let distance = p.distance(q) as f32;
                    let node = &mut nodes[row + i];
                    if distance < node.distance && f64::from(distance) <= reach {
                        (node.distance, node.face, node.exact) = (distance, face, true);
                        node.nearest = q.as_vec3().to_array();
                    }
                    if f64::from(distance) <= 1.001 * self.spacing {
                        node.crossed |= crossed_edges(p, self.spacing, corners, normal);
                    }
                }
            }
        }
    }

    /// True at the nodes outside: reached from the border with clearance, or in a few steps from
    /// such a node without crossing a face.
    fn flood(&self, nodes: &[Node]) -> Vec<bool> {
        let clearance = (CLEARANCE * self.spacing) as f32;
        let mut outside = vec![false; nodes.len()];
        let mut open = vec![0];
        outside[0] = true;
        let mut shore = Vec::new();
        while let Some(at) = open.pop() {
            let mut ashore = false;
            self.for_neighbours(at, |next, _, _| {
                ashore |= nodes[next].distance <= clearance;
                if nodes[next].distance > clearance && !outside[next] {
                    outside[next] = true;
                    open.push(next);
                }
            });
            if ashore {
                shore.push(at);
            }
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

    /// Signed distances everywhere: nodes away from the band take the nearest face of a neighbour.
    fn spread(&self, mut nodes: Vec<Node>, soup: &Soup, outside: &[bool]) -> Vec<f32> {
        for sweep in 0..8 {
            let order = |axis: usize| (0..self.size[axis], sweep >> axis & 1 == 1);
            for k in directed(order(2)) {
                for j in directed(order(1)) {
                    for i in directed(order(0)) {
                        self.relax(&mut nodes, [i, j, k], sweep);
                    }
                }
            }
        }
        let measure = |(at, node): (usize, &Node)| {
            let p = self.position(self.unravel(at));
            // Neighbours passed on points of the mesh; the nearest of that face is nearer still.
            let distance = p.distance(closest_point(p, soup.corners(node.face as usize))) as f32;
            if outside[at] { distance } else { -distance }
        };
        nodes.par_iter().enumerate().map(measure).collect()
    }

    /// Offers a node the nearest points of the three neighbours it has just been swept past.
    fn relax(&self, nodes: &mut [Node], at3: [usize; 3], sweep: usize) {
        let at = (at3[2] * self.size[1] + at3[1]) * self.size[0] + at3[0];
        if nodes[at].exact {
            return;
        }
        let p = self.position(at3).as_vec3();
        let mut best = nodes[at];
        for (axis, stride) in [1, self.size[0], self.layer()].into_iter().enumerate() {
            let down = sweep >> axis & 1 == 1;
            let end = if down { self.size[axis] - 1 } else { 0 };
            if at3[axis] == end {
                continue;
            }
            let from = nodes[if down { at + stride } else { at - stride }];
            if from.distance.is_finite() {
                let distance = p.distance(from.nearest.into());
                if distance < best.distance {
                    best = Node { distance, exact: false, ..from };
                }
            }
        }
        nodes[at] = best;
    }
}

/// A range, upwards or downwards.
fn directed((range, down): (std::ops::Range<usize>, bool)) -> impl Iterator<Item = usize> {
    let last = range.end - 1;
    range.map(move |i| if down { last - i } else { i })
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
