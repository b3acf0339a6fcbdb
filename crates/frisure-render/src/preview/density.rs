//! How much hair lies between a point and a lamp: the light-oriented density map of Bertails, Ménier
//! & Cani 2005, "A practical self-shadowing algorithm for interactive hair animation".
//!
//! Hair is spread over a grid whose columns run along the light; summing each column from the lamp
//! on gives, at every node, the mean number of hairs that a ray of light has met there. Unlike the
//! paper, which stores densities and sums at lookup over discrete slices, sums are stored and read
//! with trilinear weights, so that shadows have no slices.

use glam::{UVec3, Vec3};

use super::geometry::{frame, split};
use super::lumps::Lumps;

/// Finest cell (m): a lock is several cells wide, and a cell has several hairs in it. Chosen by trial.
pub(super) const MIN_CELL: f32 = 2.2e-3;
/// Most cells along a side; chosen by trial for speed.
pub(super) const MAX_CELLS: f32 = 168.0;
/// Distance towards the lamp at which a point looks up its shadow, in cells: the filters spread a hair over four
/// cells, and would shade itself. Chosen by trial.
const LIFT: f32 = 1.3;

/// Mean number of hairs between each point and a lamp.
pub(super) struct DensityMap {
    /// Across, across, and *away from* the lamp.
    axes: [Vec3; 3],
    low: Vec3,
    cell: f32,
    size: UVec3,
    /// Hairs met, the third index fastest.
    met: Vec<f32>,
}

/// A place among the columns of a grid, along each of which the light runs.
struct Column {
    /// Indices of the first nodes of the four columns around it.
    first: [usize; 4],
    /// Where it lies between them.
    f: Vec3,
    /// Cells from the first node on, and the most.
    depth: f32,
    deepest: f32,
}

impl DensityMap {
    /// The map for a lamp in unit direction `to_light`; `None` if there is no hair.
    pub(super) fn new(hair: &Lumps, to_light: Vec3) -> Option<Self> {
        let (u, v) = frame(-to_light);
        let axes = [u, v, -to_light];
        let local = |p: Vec3| Vec3::new(p.dot(u), p.dot(v), -p.dot(to_light));
        let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) = hair.iter().fold(empty, |(low, high), lump| {
            let p = local(lump.position);
            (low.min(p), high.max(p))
        });
        if !low.is_finite() || !high.is_finite() {
            return None;
        }
        let cell = ((high - low).max_element() / MAX_CELLS).max(MIN_CELL);
        // Two empty cells all around: what is outside reads zero, or the whole column behind it.
        let low = low - Vec3::splat(2.5 * cell);
        let size = ((high - low) / cell).ceil().as_uvec3() + UVec3::splat(4);
        let n = size.x as usize * size.y as usize * size.z as usize;
        let mut map = Self { axes, low, cell, size, met: vec![0.0; n] };
        map.spread(hair, to_light);
        map.smooth();
        map.sum_columns();
        Some(map)
    }

    /// Mean number of hairs between `point` and the lamp.
    pub(super) fn hairs_before(&self, point: Vec3) -> f32 {
        let column = self.column(self.grid(point));
        self.hairs_up_to(&column, LIFT)
    }

    /// The same, and what gives the mean number of hairs in the cell around `point`, along the light.
    pub(super) fn hairs_around(&self, point: Vec3) -> (f32, impl Fn() -> f32) {
        let column = self.column(self.grid(point));
        let before = self.hairs_up_to(&column, LIFT);
        let around = move || self.hairs_up_to(&column, -0.5) - self.hairs_up_to(&column, 0.5);
        (before, around)
    }

    /// Where a place on the grid lies among the columns.
    fn column(&self, place: Vec3) -> Column {
        let top = self.size.as_vec3() - Vec3::splat(1.001);
        let across = place.clamp(Vec3::ZERO, top).with_z(0.0);
        let (base, f) = split(across);
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
        let first = corners.map(|(du, dv)| self.index(base.x + du, base.y + dv, 0));
        Column { first, f, depth: place.z, deepest: top.z }
    }

    /// Mean number of hairs between the lamp and the place `lift` cells nearer to it than that of the column.
    fn hairs_up_to(&self, column: &Column, lift: f32) -> f32 {
        let depth = (column.depth - lift).clamp(0.0, column.deepest);
        let base = depth as usize;
        let part = depth - base as f32;
        let [a, b, c, d] = column.first.map(|first| {
            let i = first + base;
            self.met[i] + (self.met[i + 1] - self.met[i]) * part
        });
        let near = a * (1.0 - column.f.x) + b * column.f.x;
        let far = c * (1.0 - column.f.x) + d * column.f.x;
        near * (1.0 - column.f.y) + far * column.f.y
    }

    /// Position in cells from the low corner.
    fn grid(&self, p: Vec3) -> Vec3 {
        let [u, v, w] = self.axes;
        (Vec3::new(p.dot(u), p.dot(v), p.dot(w)) - self.low) / self.cell
    }

    fn index(&self, u: u32, v: u32, w: u32) -> usize {
        (u as usize * self.size.y as usize + v as usize) * self.size.z as usize + w as usize
    }

    /// Adds the shadow of all hair, as area per area of a cell, to the eight nodes around.
    fn spread(&mut self, hair: &Lumps, to_light: Vec3) {
        let per_cell = 1.0 / (self.cell * self.cell);
        for lump in hair.iter() {
            // The shadow of hair on a plane across the light: width times the length of its part across it.
            let across = lump.area - to_light * lump.area.dot(to_light);
            self.add(lump.position, across.length() * per_cell);
        }
    }

    /// Shares a value between the eight nodes around a point.
    fn add(&mut self, point: Vec3, value: f32) {
        let g = self.grid(point);
        let (base, f) = split(g);
        // A column along v is next to this one, and one along u is a layer of them away.
        let next = self.size.z as usize;
        let layer = next * self.size.y as usize;
        let first = self.index(base.x, base.y, base.z);
        for (u, wu) in [(first, 1.0 - f.x), (first + layer, f.x)] {
            for (i, wv) in [(u, 1.0 - f.y), (u + next, f.y)] {
                let part = value * wu * wv;
                let nodes = &mut self.met[i..i + 2];
                nodes[0] += part * (1.0 - f.z);
                nodes[1] += part * f.z;
            }
        }
    }

    /// Filters with (1, 2, 1)/4 along each axis: a thin sheet of hair at a grazing angle would
    /// otherwise show the cells as bands.
    fn smooth(&mut self) {
        let [nu, nv, nw] = self.size.to_array().map(|n| n as usize);
        for (stride, along) in [(1, nw), (nw, nv), (nw * nv, nu)] {
            let block = stride * along;
            for part in self.met.chunks_exact_mut(block) {
                for first in 0..stride {
                    let mut before = 0.0;
                    let mut i = first;
                    for k in 0..along {
                        let here = part[i];
                        let after = if k + 1 < along { part[i + stride] } else { 0.0 };
                        part[i] = 0.25 * before + 0.5 * here + 0.25 * after;
                        before = here;
                        i += stride;
                    }
                }
            }
        }
    }

    /// Turns hairs at each node into hairs met up to its middle.
    fn sum_columns(&mut self) {
        for column in self.met.chunks_exact_mut(self.size.z as usize) {
            let mut before = 0.0;
            for node in column {
                let here = *node;
                // To the middle of the node's own cell: half of its hair.
                *node = before + 0.5 * here;
                before += here;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preview::curves::Curves;
    use crate::preview::projection::Projection;
    use frisure_strands::Strands;

    #[test]
    fn a_sheet_of_hair_is_counted_once() {
        // Hairs 0.1 mm wide, 1 mm apart, in the plane z = 0: a tenth of the light is met.
        let mut strands = Strands::new();
        for i in 0..100 {
            let y = i as f32 * 1e-3;
            strands.push(&[Vec3::new(0.0, y, 0.0), Vec3::new(0.1, y, 0.0)], &[5e-5; 2]);
        }
        let view = Projection::new(&frisure_look::Camera::default(), 256, 256);
        let curves = Curves::new(&strands, &view, 1.0);
        let hair = Lumps::new(&curves, MIN_CELL, MAX_CELLS);
        let map = DensityMap::new(&hair, Vec3::Z).unwrap();
        let at = |z: f32| map.hairs_before(Vec3::new(0.05, 0.05, z));
        assert!(at(0.02).abs() < 1e-6, "lit side: {}", at(0.02));
        assert!((at(-0.02) - 0.1).abs() < 0.01, "behind: {}", at(-0.02));
        assert!((at(-0.5) - 0.1).abs() < 0.01, "far behind: {}", at(-0.5));
        assert!(map.hairs_before(Vec3::new(0.3, 0.05, -0.02)) < 1e-6, "beside");
    }

    #[test]
    fn no_hair_has_no_map() {
        let view = Projection::new(&frisure_look::Camera::default(), 8, 8);
        let curves = Curves::new(&Strands::new(), &view, 1.0);
        let hair = Lumps::new(&curves, MIN_CELL, MAX_CELLS);
        assert!(DensityMap::new(&hair, Vec3::Z).is_none());
    }
}
