//! Distances away from the mesh, on every second node of the grid and cubic between.

use std::ops::Range;

use glam::DVec3;

use super::derived::Derived;
use super::triangles::{Rows, Soup, closest_point};
use super::voxel_grid::{Grid, NONE, Node};

/// Directions of the sweeps (bit a: axis a runs downwards): all there are. The descent on the mesh mends what they leave.
const SWEEPS: [usize; 8] = [0b000, 0b111, 0b101, 0b010, 0b001, 0b110, 0b100, 0b011];

/// Every second node along each axis, with a face that is about the nearest to it.
#[derive(Debug, PartialEq)]
pub(crate) struct Coarse {
    size: [usize; 3],
    faces: Vec<u32>,
    /// Distances (m) without their sign, of the nodes that were asked for.
    distances: Vec<Derived<f32>>,
    soup: Soup,
    /// The faces around each face of the mesh.
    around: Derived<Rows>,
}

impl Coarse {
    /// Sweeps the nearest points of faces from the band over the grid (Danielsson 1980,
    /// doi:10.1016/0146-664X(80)90054-4).
    pub(crate) fn around(grid: &Grid, nodes: &[Node], soup: Soup) -> Self {
        let size = grid.size.map(|n| n / 2 + 1);
        let count = size.iter().product();
        let (distances, around) = (vec![Derived::new(); count], Derived::new());
        let mut coarse = Self { size, faces: vec![NONE; count], distances, soup, around };
        // The nearest point known for each node (m).
        let mut feet = vec![DVec3::INFINITY; count];
        let place = |at3: [usize; 3]| grid.position(at3.map(|n| 2 * n));
        for k in 0..size[2] {
            for j in 0..size[1] {
                for i in 0..size[0] {
                    let (at, node) = (coarse.at([i, j, k]), nodes[fine(grid, [i, j, k])]);
                    coarse.faces[at] = node.face;
                    if node.face != NONE {
                        let corners = coarse.soup.corners(node.face as usize);
                        feet[at] = closest_point(place([i, j, k]), corners);
                    }
                }
            }
        }
        let known: Vec<bool> = coarse.faces.iter().map(|&face| face != NONE).collect();
        let (changed, rows) = (vec![0; count], vec![0; size[1] * size[2]]);
        let mut nearest = Nearest { feet, known, changed, rows };
        for time in 0..SWEEPS.len() {
            coarse.sweep(&mut nearest, time, place);
        }
        coarse
    }

    fn at(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.size[1] + j) * self.size[0] + i
    }

    /// Offers each node the nearest points of the three neighbours just passed, in the sweep of index `time`.
    fn sweep(&mut self, nearest: &mut Nearest, time: usize, place: impl Fn([usize; 3]) -> DVec3) {
        let [nx, ny, nz] = self.size;
        let ways = [0, 1, 2].map(|axis| Way::new(time, axis));
        for k in directed(nz, ways[2].down) {
            for j in directed(ny, ways[1].down) {
                let row = k * ny + j;
                let beside = ways[1].passed(j, ny).map(|j| k * ny + j);
                let below = ways[2].passed(k, nz).map(|k| k * ny + j);
                let rows = [Some(row), beside, below];
                let is_new = |(row, way): (Option<usize>, &Way)| {
                    row.is_some_and(|row| way.is_new(nearest.rows[row]))
                };
                if !rows.into_iter().zip(&ways).any(is_new) {
                    continue;
                }
                for i in directed(nx, ways[0].down) {
                    let at = row * nx + i;
                    if !nearest.known[at] {
                        let before = ways[0].passed(i, nx).map(|i| row * nx + i);
                        let from = [before, beside.map(|r| r * nx + i), below.map(|r| r * nx + i)];
                        let offer = nearest.offer(at, from, &ways, || place([i, j, k]));
                        if let Some(from) = offer {
                            self.faces[at] = self.faces[from];
                            nearest.changed[at] = time as u8 + 1;
                            nearest.rows[row] = time as u8 + 1;
                        }
                    }
                }
            }
        }
    }

    /// Signed distance (m) at a node: that of the node of the fine grid where it is `known`; elsewhere a descent on the mesh from
    /// the swept face.
    fn value(
        &self,
        grid: &Grid,
        at3: [usize; 3],
        known: impl Fn(usize) -> Option<f32>,
        outside: impl Fn(usize) -> bool,
    ) -> f32 {
        let fine = fine(grid, at3);
        known(fine).unwrap_or_else(|| {
            let at = self.at(at3);
            let distance = *self.distances[at].get_or(|| {
                let around = self.around.get_or(|| self.soup.faces_around());
                let p = grid.position(at3.map(|n| 2 * n));
                self.soup.descend(around, self.faces[at], p) as f32
            });
            if outside(fine) { distance } else { -distance }
        })
    }

    /// Signed distances (m) at the nodes of a box of the fine grid, from its first to before its last, cubic in the coarse values;
    /// by its index, the distance of a node of the fine grid that is `known` (m), and whether it is `outside`.
    pub(crate) fn interpolated(
        &self,
        grid: &Grid,
        (low, high): ([usize; 3], [usize; 3]),
        known: impl Fn(usize) -> Option<f32>,
        outside: impl Fn(usize) -> bool,
    ) -> Vec<f32> {
        let last = self.size.map(|n| n - 1);
        let [xs, ys, zs] = [0, 1, 2].map(|a| Taps::new(low[a]..high[a], last[a]));
        let mut coarse = Vec::with_capacity(xs.count() * ys.count() * zs.count());
        for (k, j) in zs.coarse().flat_map(|k| ys.coarse().map(move |j| (k, j))) {
            coarse.extend(xs.coarse().map(|i| self.value(grid, [i, j, k], &known, &outside)));
        }
        // One axis after another: each value has four taps at most instead of 64.
        let along_x = refine(&coarse, &xs, 1);
        let along_y = refine(&along_x, &ys, xs.fine.len());
        refine(&along_y, &zs, xs.fine.len() * ys.fine.len())
    }
}

/// What the sweeps know of the coarse nodes.
struct Nearest {
    /// The nearest point known (m).
    feet: Vec<DVec3>,
    /// Those that have been exact from the beginning.
    known: Vec<bool>,
    /// The number of the sweep, from 1, in which a node's point was found; and the last of these in a row along x.
    changed: Vec<u8>,
    rows: Vec<u8>,
}

impl Nearest {
    /// Takes for the node `at` the nearest of its own point and of those of its neighbours, one along each axis. The neighbour whose
    /// point it took, if any.
    fn offer(
        &mut self,
        at: usize,
        from: [Option<usize>; 3],
        ways: &[Way; 3],
        place: impl FnOnce() -> DVec3,
    ) -> Option<usize> {
        let mut new = [None; 3];
        for ((new, from), way) in new.iter_mut().zip(from).zip(ways) {
            *new = from.filter(|&from| way.is_new(self.changed[from]));
        }
        if new == [None; 3] {
            return None;
        }
        let (p, mut taken) = (place(), None);
        let mut least = p.distance_squared(self.feet[at]);
        for from in new.into_iter().flatten() {
            let distance = p.distance_squared(self.feet[from]);
            if distance < least {
                (least, taken) = (distance, Some(from));
            }
        }
        if let Some(from) = taken {
            self.feet[at] = self.feet[from];
        }
        taken
    }
}

/// How a sweep runs along an axis.
struct Way {
    down: bool,
    /// The number, from 1, of the last sweep before that ran so.
    last: Option<u8>,
}

impl Way {
    fn new(time: usize, axis: usize) -> Self {
        let down = |sweep: usize| sweep >> axis & 1 == 1;
        let same = |&before: &usize| down(SWEEPS[before]) == down(SWEEPS[time]);
        Self {
            down: down(SWEEPS[time]),
            last: (0..time).rev().find(same).map(|before| before as u8 + 1),
        }
    }

    /// The neighbour of node `n` of `count` along the axis that the sweep has just passed.
    fn passed(&self, n: usize, count: usize) -> Option<usize> {
        if self.down { Some(n + 1).filter(|&n| n < count) } else { n.checked_sub(1) }
    }

    /// Whether a neighbour's point of sweep `changed` has not been offered along this way. One that has been is no nearer now,
    /// because the points of nodes only become nearer.
    fn is_new(&self, changed: u8) -> bool {
        self.last.is_none_or(|last| changed > last)
    }
}

/// Index in the fine grid of a coarse node.
fn fine(grid: &Grid, at3: [usize; 3]) -> usize {
    let [i, j, k] = at3.map(|n| 2 * n);
    (k * grid.size[1] + j) * grid.size[0] + i
}

/// Fine nodes along an axis, and the coarse nodes that they depend on.
struct Taps {
    fine: Range<usize>,
    first: usize,
    /// The last coarse node of the grid: beyond the ends the values there go on.
    last: usize,
}

impl Taps {
    fn new(fine: Range<usize>, last: usize) -> Self {
        Self { first: (fine.start / 2).saturating_sub(1), fine, last }
    }

    fn coarse(&self) -> Range<usize> {
        self.first..self.first + self.count()
    }

    fn count(&self) -> usize {
        ((self.fine.end - 1) / 2 + 2).min(self.last) + 1 - self.first
    }
}

/// Blocks of rows of `width` values at twice the density: the coarse ones, and Lagrange's cubic (−1, 9, 9, −1)/16 half-way between
/// two.
fn refine(coarse: &[f32], taps: &Taps, width: usize) -> Vec<f32> {
    let length = taps.count() * width;
    let mut fine = Vec::with_capacity(coarse.len() / length * taps.fine.len() * width);
    for block in coarse.chunks(length) {
        let row = |n: usize| {
            let n = n.min(taps.last) - taps.first;
            &block[n * width..(n + 1) * width]
        };
        for n in taps.fine.clone() {
            let at = n / 2;
            if n.is_multiple_of(2) {
                fine.extend_from_slice(row(at));
                continue;
            }
            let [a, b, c, d] = [at.saturating_sub(1), at, at + 1, at + 2].map(row);
            fine.extend((0..width).map(|i| 0.5625 * (b[i] + c[i]) - 0.0625 * (a[i] + d[i])));
        }
    }
    fine
}

/// The numbers below `count`, upwards or downwards.
fn directed(count: usize, down: bool) -> impl Iterator<Item = usize> {
    (0..count).map(move |n| if down { count - 1 - n } else { n })
}
