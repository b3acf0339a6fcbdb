//! Hairs near each point, found once for many searches.

use glam::DVec3;

use super::layout::Layout;
use super::segment_grid::SegmentGrid;
use crate::parallel;

/// Segments of other hairs near each point, to a reach that leaves room for motion.
#[derive(Default)]
pub(super) struct Candidates {
    /// Where the points were (m).
    at: Vec<DVec3>,
    /// By point, where its candidates begin; one more than points. And hair and segment of each, in order.
    starts: Vec<u32>,
    near: Vec<(u32, u32)>,
}

impl Candidates {
    /// Share of hairs of which a point has moved by more than `skin` (m) since.
    pub(super) fn outdated(&self, layout: &Layout, points: &[DVec3], skin: f64) -> f64 {
        if self.at.len() != points.len() {
            return 1.0;
        }
        let far = |strand: usize| {
            let mut range = layout.points(strand);
            range.any(|k| self.at[k].distance_squared(points[k]) > skin * skin)
        };
        let count = parallel::map(layout.strands(), far).into_iter().filter(|far| *far).count();
        count as f64 / layout.strands() as f64
    }

    /// Finds the segments within `reach` (m) of each point.
    pub(super) fn new(layout: &Layout, points: &[DVec3], reach: f64) -> Self {
        let grid = SegmentGrid::new(layout, points, reach);
        let of_chunk = |chunk: &std::ops::Range<usize>| {
            let (mut counts, mut near): (Vec<u32>, Vec<(u32, u32)>) = (Vec::new(), Vec::new());
            let mut found = Vec::new();
            for strand in chunk.clone() {
                for point in layout.points(strand) {
                    found.clear();
                    // The first point does not move, and touches nothing.
                    if point > layout.points(strand).start {
                        grid.find(points, points[point], reach, &mut found);
                        found.retain(|&(other, _)| other != strand as u32);
                        found.sort_unstable();
                        found.dedup();
                    }
                    counts.push(found.len() as u32);
                    near.extend_from_slice(&found);
                }
            }
            (counts, near)
        };
        let parts = parallel::map_slice(layout.chunks(), of_chunk);
        let mut all = Self { at: points.to_vec(), starts: vec![0], near: Vec::new() };
        for (counts, near) in parts {
            let mut end = all.near.len() as u32;
            for count in counts {
                end += count;
                all.starts.push(end);
            }
            all.near.extend(near);
        }
        all
    }

    /// Hair and segment of what is near a point.
    pub(super) fn of(&self, point: usize) -> &[(u32, u32)] {
        &self.near[self.starts[point] as usize..self.starts[point + 1] as usize]
    }
}
