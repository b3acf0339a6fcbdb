//! Segments of hairs sorted into the cells of a grid, to find those near a point.

use glam::DVec3;

use super::layout::Layout;
use crate::math::Grid;

/// Points on all segments, dense enough to find every segment within reach.
pub(super) struct SegmentGrid {
    grid: Grid,
    /// Hair and segment of each.
    owners: Vec<(u32, u32)>,
}

/// Width of a cell over the reach: with a point on a segment every half a cell, one is within a quarter of a cell of any place on it,
/// and what is within reach of that place is in the cells around it.
const CELL: f64 = 4.0 / 3.0;

/// Least width of a cell (m): narrower ones take more time and memory to sort than they save. Chosen by trial; no result depends on it.
const LEAST_CELL: f64 = 1.5e-3;

impl SegmentGrid {
    /// Sorts the segments between the points (m) of hairs for searches within `reach` (m).
    pub(super) fn new(layout: &Layout, points: &[DVec3], reach: f64) -> Self {
        let cell = (CELL * reach).max(LEAST_CELL);
        let (mut samples, mut owners) = (Vec::new(), Vec::new());
        for strand in 0..layout.strands() {
            let range = layout.points(strand);
            for segment in range.start..range.end - 1 {
                let (a, b) = (points[segment], points[segment + 1]);
                let count = (a.distance(b) / (0.5 * cell)).ceil().clamp(1.0, 1e4) as usize;
                for k in 0..count {
                    samples.push(a.lerp(b, (k as f64 + 0.5) / count as f64));
                    owners.push((strand as u32, segment as u32));
                }
            }
        }
        Self { grid: Grid::new(&samples, cell), owners }
    }

    /// Hair and segment of everything within reach of a point (m), of some things more than once, and of some that are farther.
    pub(super) fn near(&self, x: DVec3) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.grid.near(x).map(|k| self.owners[k])
    }
}
