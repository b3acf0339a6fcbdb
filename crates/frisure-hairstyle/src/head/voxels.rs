//! A triangle mesh to signed distances at the nodes of a grid.
//!
//! Exact distances near the triangles; which side a node is on comes from flooding the outside from
//! the border, because real heads are open at the shoulders and have bags for eyes and mouth, so
//! that normals alone would tell a wrong side. Farther away nodes take the nearest point that their
//! neighbours know.

use frisure_strands::Surface;
use glam::DVec3;

use super::samples::Samples;
use super::triangles::Soup;
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
    let reach = BAND * grid.spacing;
    grid.splat(&soup, reach, &mut band, |_| true);
    let outside = grid.flood(&band);
    let kept = soup.grow(&outer_faces(&band, &outside, soup.len()), 1.5 * grid.spacing);
    let soup = soup.only(&kept);
    // Inner faces (a mouth bag, the double of a skin) must not attract: measure again without them.
    grid.splat(&soup, reach, &mut band, |node| node.face != NONE && !kept[node.face as usize]);
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
        // What may be reached and is not yet; the flood begins at the first node in any case.
        let (mut open, mut reached) = (clear.to_vec(), vec![false; clear.len()]);
        open[0] = true;
        let mut seeds = vec![0];
        while let Some(seed) = seeds.pop() {
            if !open[seed] {
                continue;
            }
            // The run of open nodes around the seed.
            let (row, i) = (seed / width * width, seed % width);
            let before = open[row..seed].iter().rev().position(|open| !open).unwrap_or(i);
            let after = &open[seed..row + width];
            let to = seed + after.iter().position(|open| !open).unwrap_or(after.len());
            reached[seed - before..to].fill(true);
            open[seed - before..to].fill(false);
            // The first node of each open run beside it in the four rows around.
            let (j, k) = (row / width % depth, row / self.layer());
            let run = seed - before - row..to - row;
            let around = [
                (j > 0).then(|| row - width),
                (j + 1 < depth).then_some(row + width),
                (k > 0).then(|| row - self.layer()),
                (k + 1 < height).then_some(row + self.layer()),
            ];
            for row in around.into_iter().flatten() {
                let mut at = row + run.start;
                for beside in open[at..row + run.end].chunk_by(|a, b| a == b) {
                    if beside[0] {
                        seeds.push(at);
                    }
                    at += beside.len();
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

/// Faces that are nearest to some node outside.
fn outer_faces(nodes: &[Node], outside: &[bool], count: usize) -> Vec<bool> {
    let mut outer = vec![false; count];
    for (node, _) in nodes.iter().zip(outside).filter(|(n, out)| **out && n.face != NONE) {
        outer[node.face as usize] = true;
    }
    outer
}
