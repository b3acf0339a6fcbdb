//! A mesh on the zero of a field: surface nets on a grid whose spacing may vary along each axis.
//!
//! Own code and not the `fast-surface-nets` crate, because that one wants an even grid of `f32` and
//! leaves its vertices off the surface; here the face gets finer cells than the shoulders, and every
//! vertex is brought onto the field.

use frisure_strands::Surface;
use glam::DVec3;

use super::fans::part_sheets;
use crate::parallel;

/// Places at which a field is evaluated at once.
pub(crate) const LANES: usize = 4;

/// Coordinates of the nodes along each axis (m), increasing.
pub(crate) struct Lattice {
    pub(crate) axes: [Vec<f64>; 3],
}

/// Rounds of smoothing along the surface. Chosen by eye.
const ROUNDS: usize = 3;

impl Lattice {
    /// Nodes from `low` to `high`, `spacing(x)` apart.
    pub(crate) fn axis(low: f64, high: f64, spacing: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut nodes = vec![low];
        while nodes[nodes.len() - 1] < high {
            let last = nodes[nodes.len() - 1];
            nodes.push(last + spacing(last + 0.5 * spacing(last)));
        }
        nodes
    }

    fn size(&self) -> [usize; 3] {
        [0, 1, 2].map(|a| self.axes[a].len())
    }

    fn position(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        DVec3::new(self.axes[0][i], self.axes[1][j], self.axes[2][k])
    }
}

/// The surface where `field` (m, about a distance, positive outside) of places (m) is zero: the piece on top of the middle, without
/// bubbles that carving may leave inside.
///
/// # Panics
/// If the field has no zero in the middle of the lattice.
pub(crate) fn mesh(
    lattice: &Lattice,
    field: impl Fn([DVec3; LANES]) -> [f64; LANES] + Sync,
) -> Surface {
    let (mut positions, mut triangles) = nets(lattice, &Passed::follow(lattice, &field));
    for _ in 0..ROUNDS {
        positions = smoothed(&positions, &triangles);
        parallel::for_each_mut(&mut positions, |_, p| *p = projected(*p, &field));
    }
    parallel::for_each_mut(&mut positions, |_, p| *p = projected(*p, &field));
    part_sheets(&mut positions, &mut triangles);
    Surface::new(positions, triangles).expect("the field has a zero in the middle")
}

/// The cells that the surface passes, and the field at their corners; not a number at other nodes.
struct Passed {
    values: Vec<f64>,
    cells: Vec<bool>,
}

impl Passed {
    /// Follows the surface from cell to cell (Wyvill et al. 1986, doi:10.1007/BF01900346), from the highest place below the
    /// middle of the lattice's top.
    ///
    /// The field is evaluated nowhere else. Every cell of the piece is found: the pieces of surface in two cells are
    /// connected exactly if an edge of both crosses it, and the cells around each such edge are visited.
    fn follow(lattice: &Lattice, field: &impl Fn([DVec3; LANES]) -> [f64; LANES]) -> Self {
        let size = lattice.size();
        let strides = [1, size[0], size[0] * size[1]];
        let count = size.iter().product();
        let mut passed = Self { values: vec![f64::NAN; count], cells: vec![false; count] };
        let at = |[i, j, k]: [usize; 3]| i * strides[0] + j * strides[1] + k * strides[2];
        let mut open: Vec<[usize; 3]> = top(lattice, field).into_iter().collect();
        while !open.is_empty() {
            open.retain(|cell| !std::mem::replace(&mut passed.cells[at(*cell)], true));
            passed.evaluate(lattice, field, &open);
            let mut next = Vec::new();
            for &cell in &open {
                let corner = |c: usize| at([0, 1, 2].map(|a| cell[a] + (c >> a & 1)));
                let inside: [bool; 8] = std::array::from_fn(|c| passed.values[corner(c)] < 0.0);
                for (c, axis) in (0..8).flat_map(|c| (0..3).map(move |axis| (c, axis))) {
                    if c >> axis & 1 == 0 && inside[c] != inside[c | 1 << axis] {
                        let cells = around(cell, c, axis, size);
                        next.extend(cells.filter(|cell| !passed.cells[at(*cell)]));
                    }
                }
            }
            open = next;
        }
        passed
    }

    /// Evaluates the field at those corners of cells where it is not known.
    fn evaluate(
        &mut self,
        lattice: &Lattice,
        field: &impl Fn([DVec3; LANES]) -> [f64; LANES],
        cells: &[[usize; 3]],
    ) {
        let [nx, ny, _] = lattice.size();
        let mut unknown = Vec::new();
        for (cell, c) in cells.iter().flat_map(|cell| (0..8).map(move |c| (cell, c))) {
            let node = [0, 1, 2].map(|a| cell[a] + (c >> a & 1));
            let at = (node[2] * ny + node[1]) * nx + node[0];
            if self.values[at].is_nan() {
                // Whatever number: once in the list is enough.
                self.values[at] = 0.0;
                unknown.push((node, at));
            }
        }
        for chunk in unknown.chunks(LANES) {
            let places = std::array::from_fn(|n| lattice.position(chunk[n.min(chunk.len() - 1)].0));
            for ((_, at), value) in chunk.iter().zip(field(places)) {
                self.values[*at] = value;
            }
        }
    }
}

/// The highest cell that the surface passes in the column of nodes in the middle.
fn top(lattice: &Lattice, field: &impl Fn([DVec3; LANES]) -> [f64; LANES]) -> Option<[usize; 3]> {
    let [nx, ny, nz] = lattice.size();
    let inside = |k: usize| field([lattice.position([nx / 2, ny / 2, k]); LANES])[0] < 0.0;
    (0..nz).rev().find(|&k| inside(k)).filter(|&k| k + 1 < nz).map(|k| [nx / 2, ny / 2, k])
}

/// The cells around the edge along `axis` from corner `c` of a cell, but for those beyond the lattice.
fn around(
    cell: [usize; 3],
    c: usize,
    axis: usize,
    size: [usize; 3],
) -> impl Iterator<Item = [usize; 3]> {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let node = [0, 1, 2].map(|a| cell[a] + (c >> a & 1));
    [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().filter_map(move |(du, dv)| {
        let mut next = node;
        (next[u], next[v]) = (node[u].checked_sub(du)?, node[v].checked_sub(dv)?);
        (0..3).all(|a| next[a] + 1 < size[a]).then_some(next)
    })
}

/// One vertex in each cell that the surface passes, one quad around each edge that crosses it.
fn nets(lattice: &Lattice, passed: &Passed) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let values = &passed.values;
    let [nx, ny, nz] = lattice.size();
    let strides = [1, nx, nx * ny];
    let mut cells = vec![u32::MAX; values.len()];
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for k in 0..nz - 1 {
        for j in 0..ny - 1 {
            for i in 0..nx - 1 {
                let at = (k * ny + j) * nx + i;
                if !passed.cells[at] {
                    continue;
                }
                let p = cell_vertex(lattice, values, [i, j, k], at, strides);
                cells[at] = positions.len() as u32;
                positions.push(p);
                quads(&cells, values, [i, j, k], at, strides, &mut triangles);
            }
        }
    }
    let faces = triangles.into_iter().flat_map(|quad| split(&positions, quad)).collect();
    (positions, faces)
}

/// Mean of the crossings on the twelve edges of a cell that the surface passes.
fn cell_vertex(
    lattice: &Lattice,
    values: &[f64],
    cell: [usize; 3],
    at: usize,
    strides: [usize; 3],
) -> DVec3 {
    let corner = |c: usize| at + (0..3).map(|a| (c >> a & 1) * strides[a]).sum::<usize>();
    let place = |c: usize| lattice.position([0, 1, 2].map(|a| cell[a] + (c >> a & 1)));
    let (mut sum, mut count) = (DVec3::ZERO, 0.0);
    for c in 0..8 {
        for axis in (0..3).filter(|a| c >> a & 1 == 0) {
            let d = c | 1 << axis;
            let (u, v) = (values[corner(c)], values[corner(d)]);
            // The zero of the linear interpolation along the edge.
            if (u < 0.0) != (v < 0.0) {
                sum += place(c).lerp(place(d), u / (u - v));
                count += 1.0;
            }
        }
    }
    sum / count
}

/// The quads around those edges of a cell's first corner that cross the surface.
fn quads(
    cells: &[u32],
    values: &[f64],
    cell: [usize; 3],
    at: usize,
    strides: [usize; 3],
    out: &mut Vec<[u32; 4]>,
) {
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let (from, to) = (values[at] < 0.0, values[at + strides[axis]] < 0.0);
        if from == to || cell[u] == 0 || cell[v] == 0 {
            continue;
        }
        let (su, sv) = (strides[u], strides[v]);
        let mut quad = [cells[at - su - sv], cells[at - sv], cells[at], cells[at - su]];
        // The normal points from inside to outside, along the edge or against it.
        if !from {
            quad.reverse();
        }
        out.push(quad);
    }
}

/// Two triangles, cut along the shorter diagonal.
fn split(positions: &[DVec3], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let length = |i: u32, j: u32| positions[i as usize].distance_squared(positions[j as usize]);
    if length(a, c) <= length(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
}

/// Moves each vertex half-way to the mean of its neighbours.
fn smoothed(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut sums = vec![(DVec3::ZERO, 0.0); positions.len()];
    for &[a, b, c] in triangles {
        for (u, v) in [(a, b), (b, c), (c, a)] {
            sums[u as usize].0 += positions[v as usize];
            sums[u as usize].1 += 1.0;
        }
    }
    positions.iter().zip(sums).map(|(p, (sum, n))| 0.5 * (*p + sum / n)).collect()
}

/// `p` brought nearer to the zero of the field, by a step of Newton's.
fn projected(p: DVec3, field: &impl Fn([DVec3; LANES]) -> [f64; LANES]) -> DVec3 {
    let (value, slope) = slope(p, field);
    let length = slope.length_squared();
    // A step is bounded: at a crease the slope may vanish.
    if length > 0.04 { p - (slope * (value / length)).clamp_length_max(2e-3) } else { p }
}

/// Value and gradient, by four points of a tetrahedron.
fn slope(p: DVec3, field: &impl Fn([DVec3; LANES]) -> [f64; LANES]) -> (f64, DVec3) {
    let h = 1e-4;
    let ways = [
        DVec3::new(1.0, -1.0, -1.0),
        DVec3::new(-1.0, -1.0, 1.0),
        DVec3::new(-1.0, 1.0, -1.0),
        DVec3::new(1.0, 1.0, 1.0),
    ];
    // Σ w f(p + h w) = 4 h ∇f + O(h³) over the alternate corners of a cube, with a step of 0.1 mm (chosen).
    let values = field(ways.map(|w| p + h * w));
    let gradient = ways.iter().zip(values).map(|(w, v)| *w * v).sum::<DVec3>() / (4.0 * h);
    (values.iter().sum::<f64>() / 4.0, gradient)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_is_meshed_on_its_surface_and_turned_outwards() {
        let axis = || Lattice::axis(-0.11, 0.11, |x| if x < 0.0 { 6e-3 } else { 4e-3 });
        let ball = mesh(&Lattice { axes: [axis(), axis(), axis()] }, |places| {
            places.map(|p| p.length() - 0.1)
        });
        assert!(ball.positions().iter().all(|p| (p.length() - 0.1).abs() < 1e-6));
        let exact = 4.0 * std::f64::consts::PI * 0.01;
        assert!((ball.area() / exact - 1.0).abs() < 0.01);
        assert_eq!(ball.positions().len() as i64 - ball.triangles().len() as i64 / 2, 2);
        for (n, p) in ball.vertex_normals().iter().zip(ball.positions()) {
            assert!(n.dot(*p) > 0.09);
        }
    }

    #[test]
    fn bubbles_inside_are_left_out() {
        let axis = || Lattice::axis(-0.11, 0.11, |_| 5e-3);
        let hollow = |p: DVec3| (p.length() - 0.1).max(0.03 - p.length());
        let ball = mesh(&Lattice { axes: [axis(), axis(), axis()] }, |places| places.map(hollow));
        assert!(ball.positions().iter().all(|p| p.length() > 0.09));
    }
}
