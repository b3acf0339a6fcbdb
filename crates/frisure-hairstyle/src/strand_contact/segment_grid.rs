//! Segments of hairs sorted into the cells of a grid, to find those near a point.

use glam::{DVec3, IVec3};

use super::layout::{Layout, bounds};
use crate::parallel;

/// A grid with the segments that cross each cell.
pub(super) struct SegmentGrid {
    cell: f64,
    low: DVec3,
    size: IVec3,
    /// Where the segments of each cell begin, x fastest; one more than cells.
    starts: Vec<u32>,
    /// Hair and segment.
    segments: Vec<(u32, u32)>,
}

/// Most cells per segment: hairs that are far apart get wider cells. A guard on memory; no result depends on it.
const CELLS_PER_SEGMENT: f64 = 64.0;

impl SegmentGrid {
    /// Sorts the segments between the points (m) of hairs for searches within `reach` (m).
    pub(super) fn new(layout: &Layout, points: &[DVec3], reach: f64) -> Self {
        let (low, high) = bounds(points);
        // A ball of the reach is in eight cells at most.
        let mut cell = (2.0 * reach).max(1e-6);
        let count = |cell: f64| ((high - low) / cell).floor() + DVec3::ONE;
        let most = CELLS_PER_SEGMENT * points.len() as f64 + 64.0;
        while count(cell).element_product() > most {
            cell *= 1.1;
        }
        let size = count(cell).as_ivec3();
        let mut grid = Self { cell, low, size, starts: Vec::new(), segments: Vec::new() };
        grid.sort(layout, points);
        grid
    }

    /// Counting sort.
    fn sort(&mut self, layout: &Layout, points: &[DVec3]) {
        let of_chunk = |chunk: &std::ops::Range<usize>| {
            let mut crossed: Vec<(u32, u32, u32)> = Vec::new();
            for strand in chunk.clone() {
                let range = layout.points(strand);
                for segment in range.start..range.end - 1 {
                    let (a, b) = (points[segment], points[segment + 1]);
                    self.crossed(a, b, |cell| {
                        crossed.push((cell, strand as u32, segment as u32));
                    });
                }
            }
            crossed
        };
        let crossed = parallel::map_slice(layout.chunks(), of_chunk);
        let cells = self.size.as_i64vec3().element_product() as usize;
        let mut starts = vec![0_u32; cells + 2];
        for (cell, ..) in crossed.iter().flatten() {
            starts[*cell as usize + 2] += 1;
        }
        for k in 2..starts.len() {
            starts[k] += starts[k - 1];
        }
        self.segments = vec![(0, 0); starts[cells + 1] as usize];
        for (cell, strand, segment) in crossed.iter().flatten() {
            let at = &mut starts[*cell as usize + 1];
            self.segments[*at as usize] = (*strand, *segment);
            *at += 1;
        }
        starts.pop();
        self.starts = starts;
    }

    /// The cells that a segment crosses, one after the other ([Amanatides & Woo 1987]).
    fn crossed(&self, a: DVec3, b: DVec3, mut act: impl FnMut(u32)) {
        let last = self.size - IVec3::ONE;
        let key =
            |p: DVec3| ((p - self.low) / self.cell).floor().as_ivec3().clamp(IVec3::ZERO, last);
        let (mut at, end) = (key(a).to_array(), key(b).to_array());
        let along = (b - a).to_array();
        let from = ((a - self.low) / self.cell).to_array();
        // Share of the segment at the next border of each axis, and between borders.
        let (mut next, mut apart) = ([f64::INFINITY; 3], [f64::INFINITY; 3]);
        for k in 0..3 {
            if at[k] != end[k] {
                apart[k] = self.cell / along[k].abs();
                let border = f64::from(at[k]) + if along[k] > 0.0 { 1.0 } else { 0.0 };
                next[k] = (border - from[k]) / (along[k] / self.cell);
            }
        }
        act(self.index(IVec3::from_array(at)));
        let steps: i32 = (0..3).map(|k| (end[k] - at[k]).abs()).sum();
        for _ in 0..steps {
            let mut axis = 0;
            for k in 1..3 {
                if next[k] < next[axis] {
                    axis = k;
                }
            }
            at[axis] += (end[axis] - at[axis]).signum();
            next[axis] =
                if at[axis] == end[axis] { f64::INFINITY } else { next[axis] + apart[axis] };
            act(self.index(IVec3::from_array(at)));
        }
    }

    fn index(&self, key: IVec3) -> u32 {
        ((key.z * self.size.y + key.y) * self.size.x + key.x) as u32
    }

    /// Adds hair and segment of everything within `reach` (m) of a place to `found`, some of it more than once.
    pub(super) fn find(&self, points: &[DVec3], x: DVec3, reach: f64, found: &mut Vec<(u32, u32)>) {
        let last = self.size - IVec3::ONE;
        let key =
            |p: DVec3| ((p - self.low) / self.cell).floor().as_ivec3().clamp(IVec3::ZERO, last);
        let (from, to) = (key(x - reach), key(x + reach));
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                // A row of cells lies in one piece.
                let first = self.starts[self.index(IVec3::new(from.x, y, z)) as usize];
                let end = self.starts[self.index(IVec3::new(to.x, y, z)) as usize + 1];
                for &(strand, segment) in &self.segments[first as usize..end as usize] {
                    let (a, b) = (points[segment as usize], points[segment as usize + 1]);
                    let along = b - a;
                    let share =
                        ((x - a).dot(along) / along.length_squared().max(1e-30)).clamp(0.0, 1.0);
                    if (a + along * share).distance_squared(x) < reach * reach {
                        found.push((strand, segment));
                    }
                }
            }
        }
    }
}
