//! A signed distance as a tricubic spline on a regular grid.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::derived::Derived;
use super::samples::Samples;

/// Signed distance to a mesh (m), positive outside: a tricubic B-spline.
///
/// Inside the grid it is C² and its derivatives are those of the spline itself. Outside the grid the value grows with the
/// distance to the grid; only there does the slope have a kink.
///
/// Its coefficients are computed where they are first asked for: most hair is near a small part of a head.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spline {
    origin: DVec3,
    spacing: f64,
    size: [usize; 3],
    samples: Arc<Samples>,
    /// Blocks of [`BLOCK`]³ cells, and their numbers along each axis.
    blocks: Vec<Derived<Block>>,
    counts: [usize; 3],
}

/// What [`BLOCK`]³ cells need.
#[derive(Clone, Debug)]
struct Block {
    /// The least coefficient for each [`PART`]³ of its cells: next to those of other blocks in memory, because many places are asked
    /// for nothing else.
    least: [f32; (BLOCK / PART).pow(3)],
    coefficients: Box<[f32; SIDE.pow(3)]>,
}

/// Cells along each axis of a block. Chosen: smaller ones share more coefficients with their neighbours; no result depends on it.
const BLOCK: usize = 8;

/// Coefficients along each axis of a block.
const SIDE: usize = BLOCK + 3;

/// Cells along each axis of the parts of a block that have a bound. Chosen: as long as hair is thick; no result depends on it.
const PART: usize = 4;

/// Weights of four neighbouring coefficients and their first and second derivatives.
type Weights = [[f64; 4]; 3];

impl Spline {
    /// The spline through the samples of a grid.
    pub(crate) fn through(samples: Samples) -> Self {
        let grid = &samples.grid;
        let (origin, spacing, size) = (grid.origin, grid.spacing, grid.size);
        // A cell begins at most four nodes before the end.
        let counts = size.map(|n| (n - 4) / BLOCK + 1);
        let blocks = vec![Derived::new(); counts.iter().product()];
        Self { origin, spacing, size, samples: Arc::new(samples), blocks, counts }
    }

    /// Distance between neighbouring nodes of the grid (m).
    pub(crate) fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Smallest and largest corner of the box in which the spline is evaluated (m).
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        let [x, y, z] = self.size.map(|n| (n - 2) as f64);
        let low = self.origin + DVec3::splat(self.spacing);
        (low, self.origin + self.spacing * DVec3::new(x, y, z))
    }

    /// Signed distance (m) at `p` (m), positive outside.
    pub(crate) fn value(&self, p: DVec3) -> f64 {
        let q = self.clamp(p);
        let (first, inside) = self.cell(q);
        let [x, y, z] = inside.map(values);
        let stencil = self.block(first).stencil(first);
        let mut value = 0.0;
        for n in 0..16 {
            let row = row_of(stencil, n);
            let along = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3] * x[3];
            value += y[n % 4] * z[n / 4] * along;
        }
        value + (p - q).length()
    }

    /// False only if [`Self::value`] at `p` (m) is larger than `distance` (m); far away it often is, at a fraction of the cost.
    #[inline]
    pub(crate) fn may_be_nearer(&self, p: DVec3, distance: f64) -> bool {
        let q = self.clamp(p);
        let (first, _) = self.cell(q);
        let [i, j, k] = first.map(|n| n % BLOCK / PART);
        let least = self.block(first).least[(k * (BLOCK / PART) + j) * (BLOCK / PART) + i];
        // A spline is nowhere less than the least of its coefficients; the bound (m) is far above rounding.
        f64::from(least) + (p - q).length() <= distance + 1e-9
    }

    /// Signed distance (m) at `p` (m) and its gradient.
    pub(crate) fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let q = self.clamp(p);
        let (first, [x, y, z]) = self.weights(q);
        let stencil = self.block(first).stencil(first);
        let (mut value, mut gradient) = (0.0, DVec3::ZERO);
        for n in 0..16 {
            let (j, k) = (n % 4, n / 4);
            let [v, s, _] = row_and_slopes(row_of(stencil, n), &x);
            let (here, along_y, along_z) =
                (y[0][j] * z[0][k], y[1][j] * z[0][k], y[0][j] * z[1][k]);
            value += here * v;
            gradient += DVec3::new(here * s, along_y * v, along_z * v);
        }
        // Outside the box φ(q) + |p − q| with q the nearest point of the box: q moves only along the sides that hold it.
        let beyond = p - q;
        (value + beyond.length(), gradient * free(beyond) + beyond.normalize_or_zero())
    }

    /// Signed distance (m) at `p` (m), its gradient and its Hessian (1/m).
    pub(crate) fn value_gradient_hessian(&self, p: DVec3) -> (f64, DVec3, DMat3) {
        let q = self.clamp(p);
        let (first, [x, y, z]) = self.weights(q);
        let stencil = self.block(first).stencil(first);
        let (mut value, mut gradient) = (0.0, DVec3::ZERO);
        let (mut square, mut cross) = (DVec3::ZERO, DVec3::ZERO);
        for n in 0..16 {
            let (j, k) = (n % 4, n / 4);
            let [v, s, b] = row_and_slopes(row_of(stencil, n), &x);
            let (here, along_y, along_z) =
                (y[0][j] * z[0][k], y[1][j] * z[0][k], y[0][j] * z[1][k]);
            let (yy, yz, zz) = (y[2][j] * z[0][k], y[1][j] * z[1][k], y[0][j] * z[2][k]);
            value += here * v;
            gradient += DVec3::new(here * s, along_y * v, along_z * v);
            square += DVec3::new(here * b, yy * v, zz * v);
            cross += DVec3::new(along_y * s, along_z * s, yz * v);
        }
        let hessian = DMat3::from_cols(
            DVec3::new(square.x, cross.x, cross.y),
            DVec3::new(cross.x, square.y, cross.z),
            DVec3::new(cross.y, cross.z, square.z),
        );
        let beyond = p - q;
        let mask = free(beyond);
        let free = DMat3::from_diagonal(mask);
        let gradient = gradient * mask + beyond.normalize_or_zero();
        (value + beyond.length(), gradient, free * hessian * free + length_hessian(beyond))
    }

    /// Nearest point of the box of [`Spline::bounds`].
    fn clamp(&self, p: DVec3) -> DVec3 {
        let (low, high) = self.bounds();
        p.clamp(low, high)
    }

    /// Index of the first of the 4×4×4 coefficients around `q`, and their weights per axis.
    fn weights(&self, q: DVec3) -> ([usize; 3], [Weights; 3]) {
        let (first, inside) = self.cell(q);
        (first, inside.map(|t| cubic(t, self.spacing)))
    }

    /// Index of the first of the 4×4×4 coefficients around `q`, and where in its cell it is, 0 to 1 along each axis.
    #[inline]
    fn cell(&self, q: DVec3) -> ([usize; 3], [f64; 3]) {
        let u = (q - self.origin) / self.spacing;
        let (mut first, mut inside) = ([0; 3], [0.0; 3]);
        for axis in 0..3 {
            // The last cell is closed on the right, so that the box includes its border. The cast
            // cannot lose a sign: `clamp` keeps u at 1 or above.
            let cell = (u[axis] as usize).clamp(1, self.size[axis] - 3);
            first[axis] = cell - 1;
            inside[axis] = u[axis] - cell as f64;
        }
        (first, inside)
    }

    /// The block of the cell whose first coefficient is `first`.
    #[inline]
    fn block(&self, first: [usize; 3]) -> &Block {
        let [i, j, k] = first.map(|n| n / BLOCK);
        let at = (k * self.counts[1] + j) * self.counts[0] + i;
        self.blocks[at].get_or(|| Block::new(&self.samples, first.map(|n| n / BLOCK)))
    }
}

impl Block {
    /// The block with this place among the blocks.
    fn new(samples: &Samples, block: [usize; 3]) -> Self {
        // A coefficient depends on the samples beside it.
        let size = samples.grid.size;
        let first = block.map(|n| n * BLOCK);
        let low = first.map(|n| n.saturating_sub(1));
        let high = [0, 1, 2].map(|a| (first[a] + SIDE + 1).min(size[a]));
        let mut values = samples.of_box(low, high);
        let [width, depth, height] = [0, 1, 2].map(|a| high[a] - low[a]);
        interpolate(&mut values, [width, depth, height]);
        // Beyond the end of the grid there are none, and no cell needs them.
        let mut coefficients = Box::new([f32::INFINITY; SIDE.pow(3)]);
        let [left, front, below] = [0, 1, 2].map(|a| first[a] - low[a]);
        let [rows, layers] = [depth - front, height - below].map(|n| n.min(SIDE));
        for (k, j) in (0..layers).flat_map(|k| (0..rows).map(move |j| (k, j))) {
            let from = ((k + below) * depth + j + front) * width + left;
            let row = &values[from..from + (width - left).min(SIDE)];
            coefficients[(k * SIDE + j) * SIDE..][..row.len()].copy_from_slice(row);
        }
        Self { least: least_of_parts(&coefficients), coefficients }
    }

    /// The coefficients from the first of a cell on, up to its last.
    #[inline]
    fn stencil(&self, first: [usize; 3]) -> &[f32; STENCIL] {
        let [i, j, k] = first.map(|n| n % BLOCK);
        let rest = &self.coefficients[(k * SIDE + j) * SIDE + i..];
        rest.first_chunk().expect("a cell's coefficients are in its block")
    }
}

/// Coefficients of a block from the first to the last of a cell.
const STENCIL: usize = 3 * (SIDE * SIDE + SIDE) + 4;

/// Row `n` of the sixteen rows of a stencil.
#[inline]
fn row_of(stencil: &[f32; STENCIL], n: usize) -> [f64; 4] {
    let at = (n / 4 * SIDE + n % 4) * SIDE;
    [0, 1, 2, 3].map(|i| stencil[at + i].into())
}

/// Weighted sum along x of a row, with its first two derivatives.
#[inline]
fn row_and_slopes(row: [f64; 4], weights: &Weights) -> [f64; 3] {
    weights.map(|w| row[0] * w[0] + row[1] * w[1] + row[2] * w[2] + row[3] * w[3])
}

/// One where a coordinate moves the nearest point of the box, zero where it is held by a side.
fn free(beyond: DVec3) -> DVec3 {
    DVec3::from_array(beyond.to_array().map(|d| if d == 0.0 { 1.0 } else { 0.0 }))
}

/// Hessian of the length of `beyond`, in the coordinates that are not zero.
fn length_hessian(beyond: DVec3) -> DMat3 {
    let Some(u) = beyond.try_normalize() else { return DMat3::ZERO };
    // (I − u uᵀ)/|d| in the held coordinates.
    let held = DMat3::from_diagonal(DVec3::ONE - free(beyond));
    (held - DMat3::from_cols(u * u.x, u * u.y, u * u.z)) * beyond.length().recip()
}

/// The uniform cubic B-spline at `t` in 0..1 of a cell of width `h`, with two derivatives.
fn cubic(t: f64, h: f64) -> Weights {
    // The derivatives by position divide by h and by h².
    let s = 1.0 - t;
    let slope = [-s * s, t * (3.0 * t - 4.0), s * (4.0 - 3.0 * s), t * t];
    let bend = [s, 3.0 * t - 2.0, 3.0 * s - 2.0, t];
    [values(t), slope.map(|w| w / (2.0 * h)), bend.map(|w| w / (h * h))]
}

/// The uniform cubic B-spline at `t` in 0..1 of a cell.
#[inline]
fn values(t: f64) -> [f64; 4] {
    // ⅙ (1 − t)³, ⅙ (4 − 6t² + 3t³), the same mirrored, ⅙ t³.
    let s = 1.0 - t;
    [s * s * s, 4.0 - 3.0 * t * t * (2.0 - t), 4.0 - 3.0 * s * s * (2.0 - s), t * t * t]
        .map(|w| w / 6.0)
}

/// The least coefficient that each part of a block uses.
fn least_of_parts(coefficients: &[f32; SIDE.pow(3)]) -> [f32; (BLOCK / PART).pow(3)] {
    let parts = BLOCK / PART;
    std::array::from_fn(|part| {
        let [i, j, k] =
            [part % parts, part / parts % parts, part / parts / parts].map(|n| n * PART);
        // A cell uses four coefficients along each axis from its own index on.
        let used = |n: usize| n..n + PART + 3;
        let rows = used(k).flat_map(|k| used(j).map(move |j| (k * SIDE + j) * SIDE));
        rows.flat_map(|row| &coefficients[row..][used(i)]).copied().fold(f32::INFINITY, f32::min)
    })
}

/// Turns samples into coefficients whose spline passes by them to fourth order.
///
/// Those at the sides of the box keep their values: they are at the end of the grid, or are not needed.
/// The local rule `c = f − δ²f/6` is enough here: an exact interpolation would ring at the creases
/// of the distance.
fn interpolate(values: &mut [f32], [nx, ny, _]: [usize; 3]) {
    for stride in [1, nx, nx * ny] {
        // Each axis in turn; a node at the end of a row keeps its value.
        let length = match stride {
            1 => nx,
            s if s == nx => ny,
            s => values.len() / s,
        };
        filter_axis(values, stride, length);
    }
}

fn filter_axis(values: &mut [f32], stride: usize, length: usize) {
    for block in values.chunks_mut(stride * length) {
        let mut before: Vec<f32> = block[..stride].to_vec();
        for row in 1..length - 1 {
            for (lane, before) in before.iter_mut().enumerate() {
                let at = row * stride + lane;
                let here = block[at];
                // The spline at a node is (c₋ + 4c + c₊)/6 = c + δ²c/6; `before` keeps the sample that was overwritten.
                block[at] = here - (*before - 2.0 * here + block[at + stride]) / 6.0;
                *before = here;
            }
        }
    }
}
