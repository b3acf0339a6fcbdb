//! Distances away from the mesh, on every second node of the grid and cubic between.

use glam::DVec3;
use rayon::prelude::*;

use super::triangles::{Soup, closest_point};
use super::voxel_grid::{Grid, NONE, Node};

/// Directions of the sweeps (bit a: axis a runs downwards): all there are. The descent on the mesh mends what they leave.
const SWEEPS: [usize; 8] = [0b000, 0b111, 0b101, 0b010, 0b001, 0b110, 0b100, 0b011];

/// Every second node along each axis, with the face nearest to it.
pub(crate) struct Coarse {
    size: [usize; 3],
    faces: Vec<u32>,
    /// Signed distances (m).
    values: Vec<f32>,
}

impl Coarse {
    /// Sweeps the nearest points of faces from the band over the grid (Danielsson 1980,
    /// doi:10.1016/0146-664X(80)90054-4), and descends on the mesh from each node's face to the nearest.
    pub(crate) fn around(grid: &Grid, nodes: &[Node], soup: &Soup, outside: &[bool]) -> Self {
        let size = grid.size.map(|n| n / 2 + 1);
        let fine = |at3: [usize; 3]| {
            let [i, j, k] = at3.map(|n| 2 * n);
            (k * grid.size[1] + j) * grid.size[0] + i
        };
        let mut coarse =
            Self { size, faces: vec![NONE; size[0] * size[1] * size[2]], values: Vec::new() };
        // The nearest point known for each node (m).
        let mut feet = vec![DVec3::INFINITY; coarse.faces.len()];
        let place = |at3: [usize; 3]| grid.position(at3.map(|n| 2 * n));
        for k in 0..size[2] {
            for j in 0..size[1] {
                for i in 0..size[0] {
                    let (at, node) = (coarse.at([i, j, k]), nodes[fine([i, j, k])]);
                    coarse.faces[at] = node.face;
                    if node.face != NONE {
                        feet[at] =
                            closest_point(place([i, j, k]), soup.corners(node.face as usize));
                    }
                }
            }
        }
        let known: Vec<bool> = coarse.faces.iter().map(|&face| face != NONE).collect();
        for sweep in SWEEPS {
            coarse.sweep(&mut feet, &known, sweep, place);
        }
        let around = soup.faces_around();
        let measure = |(at, &face): (usize, &u32)| {
            let at3 = [at % size[0], at / size[0] % size[1], at / (size[0] * size[1])];
            let near = nodes[fine(at3)];
            // In the band about the skin the distance is known exactly; elsewhere the swept face is a start.
            let distance = if near.face == NONE {
                soup.descend(&around, face, place(at3)) as f32
            } else {
                near.distance
            };
            if outside[fine(at3)] { distance } else { -distance }
        };
        coarse.values = coarse.faces.par_iter().enumerate().map(measure).collect();
        coarse
    }

    fn at(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.size[1] + j) * self.size[0] + i
    }

    /// Offers each node the nearest points of the three neighbours just passed; bit a of `sweep` is set
    /// where axis a runs downwards. Those whose nearest point is `known` keep it.
    fn sweep(
        &mut self,
        feet: &mut [DVec3],
        known: &[bool],
        sweep: usize,
        place: impl Fn([usize; 3]) -> DVec3,
    ) {
        let order = |axis: usize| (0..self.size[axis], sweep >> axis & 1 == 1);
        let (zs, ys, xs) = (order(2), order(1), order(0));
        for k in directed(zs) {
            for j in directed(ys.clone()) {
                for i in directed(xs.clone()) {
                    let at3 = [i, j, k];
                    if !known[self.at(at3)] {
                        self.relax(feet, at3, sweep, place(at3));
                    }
                }
            }
        }
    }

    fn relax(&mut self, feet: &mut [DVec3], at3: [usize; 3], sweep: usize, p: DVec3) {
        let at = self.at(at3);
        let mut least = p.distance_squared(feet[at]);
        for axis in 0..3 {
            let down = sweep >> axis & 1 == 1;
            if at3[axis] == if down { self.size[axis] - 1 } else { 0 } {
                continue;
            }
            let mut from = at3;
            from[axis] = if down { at3[axis] + 1 } else { at3[axis] - 1 };
            // The neighbour's nearest point is a candidate for this node, too.
            let from = self.at(from);
            let distance = p.distance_squared(feet[from]);
            if distance < least {
                (least, self.faces[at], feet[at]) = (distance, self.faces[from], feet[from]);
            }
        }
    }

    /// Signed distances (m) at all nodes of the fine grid of `size`, cubic in the coarse values.
    pub(crate) fn interpolated(&self, size: [usize; 3]) -> Vec<f32> {
        let [nx, ny, _] = size;
        let [cx, cy, _] = self.size;
        // One axis after another: each value has four taps at most instead of 64.
        let mut along_x = vec![0.0; nx * cy * self.size[2]];
        let rows = along_x.par_chunks_mut(nx).zip(self.values.par_chunks(cx));
        rows.for_each(|(fine, coarse)| refine(fine, coarse, 1));
        let mut along_y = vec![0.0; nx * ny * self.size[2]];
        let layers = along_y.par_chunks_mut(nx * ny).zip(along_x.par_chunks(nx * cy));
        layers.for_each(|(fine, coarse)| refine(fine, coarse, nx));
        let mut values = vec![0.0; size.iter().product()];
        refine(&mut values, &along_y, nx * ny);
        values
    }
}

/// Rows of `width` values at twice the density: the coarse ones, and Lagrange's cubic (−1, 9, 9, −1)/16 half-way between two.
fn refine(fine: &mut [f32], coarse: &[f32], width: usize) {
    let last = coarse.len() / width - 1;
    let row = |n: usize| &coarse[n * width..(n + 1) * width];
    fine.par_chunks_mut(width).with_min_len(SERIAL / width + 1).enumerate().for_each(|(n, out)| {
        let at = n / 2;
        if n.is_multiple_of(2) {
            out.copy_from_slice(row(at.min(last)));
            return;
        }
        // Beyond the ends the last value goes on.
        let [a, b, c, d] = [at.saturating_sub(1), at, at + 1, at + 2].map(|n| row(n.min(last)));
        for (i, out) in out.iter_mut().enumerate() {
            *out = 0.5625 * (b[i] + c[i]) - 0.0625 * (a[i] + d[i]);
        }
    });
}

/// Values that one task refines. Chosen; no result depends on it.
const SERIAL: usize = 1 << 14;

/// A range, upwards or downwards.
fn directed((range, down): (std::ops::Range<usize>, bool)) -> impl Iterator<Item = usize> {
    let last = range.end - 1;
    range.map(move |i| if down { last - i } else { i })
}
