//! Distances away from the mesh, on every second node of the grid and cubic between.

use rayon::prelude::*;

use super::triangles::{Soup, closest_point};
use super::voxel_grid::{Grid, NONE, Node};

/// Directions of the sweeps (bit a: axis a runs downwards). Four of the eight reach everything, and
/// the descent on the mesh mends what they leave. Chosen.
const SWEEPS: [usize; 4] = [0b000, 0b111, 0b101, 0b010];

/// Every second node along each axis, with the face nearest to it.
pub(crate) struct Coarse {
    size: [usize; 3],
    faces: Vec<u32>,
    /// Signed distances (m).
    values: Vec<f32>,
}

impl Coarse {
    /// Sweeps the nearest faces from the band over the grid. Carrying faces and measuring the
    /// distance to each afresh is far more exact than carrying distances, and cheap on few nodes.
    pub(crate) fn around(grid: &Grid, nodes: &[Node], soup: &Soup, outside: &[bool]) -> Self {
        let size = grid.size.map(|n| n / 2 + 1);
        let fine = |at3: [usize; 3]| {
            let [i, j, k] = at3.map(|n| 2 * n);
            (k * grid.size[1] + j) * grid.size[0] + i
        };
        let mut coarse =
            Self { size, faces: vec![NONE; size[0] * size[1] * size[2]], values: Vec::new() };
        let mut distances = vec![f64::INFINITY; coarse.faces.len()];
        for k in 0..size[2] {
            for j in 0..size[1] {
                for i in 0..size[0] {
                    let (at, node) = (coarse.at([i, j, k]), nodes[fine([i, j, k])]);
                    (coarse.faces[at], distances[at]) = (node.face, node.distance.into());
                }
            }
        }
        let place = |at3| grid.position(grid.unravel(fine(at3)));
        for sweep in SWEEPS {
            coarse.sweep(&mut distances, nodes, sweep, fine, |at3, face| {
                let p = place(at3);
                p.distance(closest_point(p, soup.corners(face as usize)))
            });
        }
        let neighbours = soup.faces_of_vertices();
        let measure = |(at, &face): (usize, &u32)| {
            let at3 = [at % size[0], at / size[0] % size[1], at / (size[0] * size[1])];
            let near = nodes[fine(at3)];
            // In the band about the skin the distance is known exactly; elsewhere the swept face is a start.
            let distance = if near.face == NONE {
                soup.descend(&neighbours, face, place(at3)) as f32
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

    /// Offers each node the faces of the three neighbours just passed; bit a of `sweep` is set
    /// where axis a runs downwards.
    fn sweep(
        &mut self,
        distances: &mut [f64],
        nodes: &[Node],
        sweep: usize,
        fine: impl Fn([usize; 3]) -> usize,
        measure: impl Fn([usize; 3], u32) -> f64,
    ) {
        let order = |axis: usize| (0..self.size[axis], sweep >> axis & 1 == 1);
        let (zs, ys, xs) = (order(2), order(1), order(0));
        for k in directed(zs) {
            for j in directed(ys.clone()) {
                for i in directed(xs.clone()) {
                    let at3 = [i, j, k];
                    if nodes[fine(at3)].face == NONE {
                        self.relax(distances, at3, sweep, &measure);
                    }
                }
            }
        }
    }

    fn relax(
        &mut self,
        distances: &mut [f64],
        at3: [usize; 3],
        sweep: usize,
        measure: impl Fn([usize; 3], u32) -> f64,
    ) {
        let at = self.at(at3);
        for axis in 0..3 {
            let down = sweep >> axis & 1 == 1;
            if at3[axis] == if down { self.size[axis] - 1 } else { 0 } {
                continue;
            }
            let mut from = at3;
            from[axis] = if down { at3[axis] + 1 } else { at3[axis] - 1 };
            // The neighbour's nearest face is a candidate for this node, too.
            let face = self.faces[self.at(from)];
            if face != NONE && face != self.faces[at] {
                let distance = measure(at3, face);
                if distance < distances[at] {
                    (distances[at], self.faces[at]) = (distance, face);
                }
            }
        }
    }

    /// Signed distance (m) at node `at3` of the fine grid, cubic in the coarse values.
    pub(crate) fn interpolate(&self, at3: [usize; 3]) -> f32 {
        if at3.iter().all(|n| n.is_multiple_of(2)) {
            return self.values[self.at(at3.map(|n| n / 2))];
        }
        let strides = [1, self.size[0], self.size[0] * self.size[1]];
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let taps = if at3[axis].is_multiple_of(2) { &ON_NODE[..] } else { &BETWEEN[..] };
            let mut placed = [(0, 0.0); 4];
            for (tap, (offset, weight)) in placed.iter_mut().zip(taps) {
                let n = (at3[axis] / 2).saturating_add_signed(*offset).min(self.size[axis] - 1);
                *tap = (n * strides[axis], *weight);
            }
            (placed, taps.len())
        });
        let mut sum = 0.0;
        for &(k, wz) in &z.0[..z.1] {
            for &(j, wy) in &y.0[..y.1] {
                for &(i, wx) in &x.0[..x.1] {
                    sum += wx * wy * wz * self.values[i + j + k];
                }
            }
        }
        sum
    }
}

/// Offsets and weights of cubic interpolation at a coarse node, and half-way between two: Lagrange's (−1, 9, 9, −1)/16.
const ON_NODE: [(isize, f32); 1] = [(0, 1.0)];
const BETWEEN: [(isize, f32); 4] = [(-1, -0.0625), (0, 0.5625), (1, 0.5625), (2, -0.0625)];

/// A range, upwards or downwards.
fn directed((range, down): (std::ops::Range<usize>, bool)) -> impl Iterator<Item = usize> {
    let last = range.end - 1;
    range.map(move |i| if down { last - i } else { i })
}
