//! Points sorted into cells of a coarse grid, to find near ones.

use std::ops::Range;

use glam::{DVec3, IVec3};

/// A grid whose cells are at least as wide as the reach of a search.
pub(crate) struct Grid {
    cell: f64,
    low: DVec3,
    size: IVec3,
    /// Where the indices of each cell begin, x fastest; one more than cells.
    starts: Vec<u32>,
    indices: Vec<u32>,
}

/// Most cells per point: points that are far apart get wider cells. A guard on memory; no result depends on it.
const CELLS_PER_POINT: f64 = 16.0;

impl Grid {
    /// Sorts points (m) for searches within `reach` (m).
    pub(crate) fn new(points: &[DVec3], reach: f64) -> Self {
        let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let (low, extent) =
            if points.is_empty() { (DVec3::ZERO, DVec3::ZERO) } else { (low, high - low) };
        let most = CELLS_PER_POINT * points.len() as f64 + 64.0;
        let mut cell = reach.max(1e-6);
        let count = |cell: f64| (extent / cell).floor() + DVec3::ONE;
        while count(cell).element_product() > most {
            cell *= 1.25;
        }
        let size = count(cell).as_ivec3();
        let mut grid = Self { cell, low, size, starts: Vec::new(), indices: Vec::new() };
        grid.sort(points);
        grid
    }

    /// Counting sort.
    fn sort(&mut self, points: &[DVec3]) {
        let cells = (self.size.x * self.size.y * self.size.z) as usize;
        let keys: Vec<usize> = points.iter().map(|&p| self.index(self.key(p))).collect();
        self.starts = vec![0; cells + 1];
        for &k in &keys {
            self.starts[k + 1] += 1;
        }
        for k in 0..cells {
            self.starts[k + 1] += self.starts[k];
        }
        let mut next = self.starts.clone();
        self.indices = vec![0; points.len()];
        for (i, &k) in keys.iter().enumerate() {
            self.indices[next[k] as usize] = i as u32;
            next[k] += 1;
        }
    }

    fn key(&self, p: DVec3) -> IVec3 {
        ((p - self.low) / self.cell).floor().as_ivec3()
    }

    fn index(&self, key: IVec3) -> usize {
        ((key.z * self.size.y + key.y) * self.size.x + key.x) as usize
    }

    /// Indices of all points within reach of `p`, and of some that are farther.
    pub(crate) fn near(&self, p: DVec3) -> impl Iterator<Item = usize> + '_ {
        self.within(p, 1)
    }

    /// All points in the order of their cells.
    pub(crate) fn order(&self) -> &[u32] {
        &self.indices
    }

    /// Indices of all points within `rings` cells of `p`, and of some that are farther.
    pub(crate) fn within(&self, p: DVec3, rings: i32) -> impl Iterator<Item = usize> + '_ {
        self.rows(p, rings).flat_map(|row| self.indices[row].iter().map(|&i| i as usize))
    }

    /// The points of [`Self::within`], as pieces of [`Self::order`].
    pub(crate) fn rows(&self, p: DVec3, rings: i32) -> impl Iterator<Item = Range<usize>> + '_ {
        let last = self.size - IVec3::ONE;
        let centre = self.key(p).clamp(IVec3::splat(-rings - 1), last + IVec3::splat(rings + 1));
        let (from, to) = ((centre - rings).max(IVec3::ZERO), (centre + rings).min(last));
        // A row of cells lies in one piece.
        let row = move |y: i32, z: i32| {
            let first = self.starts[self.index(IVec3::new(from.x, y, z))] as usize;
            first..self.starts[self.index(IVec3::new(to.x, y, z)) + 1] as usize
        };
        let inside = from.x <= to.x;
        (from.z..=to.z)
            .filter(move |_| inside)
            .flat_map(move |z| (from.y..=to.y).map(move |y| (y, z)))
            .map(move |(y, z)| row(y, z))
    }

    /// Pieces of [`Self::order`] with all points within `reach` (m) of `p`, and some that are farther.
    pub(crate) fn rows_within(
        &self,
        p: DVec3,
        reach: f64,
    ) -> impl Iterator<Item = Range<usize>> + '_ {
        // A little more, for rounding.
        let reach = reach * (1.0 + 1e-9) + 1e-12;
        let last = self.size - IVec3::ONE;
        let key = move |p: DVec3| self.key(p).clamp(IVec3::NEG_ONE, last + IVec3::ONE);
        let (from, to) = (key(p - reach).max(IVec3::ZERO), key(p + reach).min(last));
        // How far a coordinate is from a layer of cells.
        let beside = move |place: f64, low: f64, cell: i32| {
            let from = low + f64::from(cell) * self.cell;
            (from - place).max(place - from - self.cell).max(0.0)
        };
        let row = move |y: i32, z: i32| {
            let (dy, dz) = (beside(p.y, self.low.y, y), beside(p.z, self.low.z, z));
            let left = reach * reach - dy * dy - dz * dz;
            // Cells of the row that a sphere of that radius may meet.
            let half = DVec3::X * left.max(0.0).sqrt();
            let (from, to) = (key(p - half).x.max(0), key(p + half).x.min(last.x));
            (left >= 0.0 && from <= to).then(|| {
                let first = self.starts[self.index(IVec3::new(from, y, z))] as usize;
                first..self.starts[self.index(IVec3::new(to, y, z)) + 1] as usize
            })
        };
        (from.z..=to.z)
            .flat_map(move |z| (from.y..=to.y).map(move |y| (y, z)))
            .filter_map(move |(y, z)| row(y, z))
    }

    /// The `count` points nearest to `p`, nearest first; fewer if there are fewer.
    pub(crate) fn nearest(&self, p: DVec3, count: usize, points: &[DVec3]) -> Vec<usize> {
        let mut rings = 1;
        loop {
            let mut found: Vec<_> =
                self.within(p, rings).map(|i| (points[i].distance_squared(p), i)).collect();
            // All points within `rings` cells of the one of p have been found; farther ones may be missing.
            let reach = (self.cell * f64::from(rings)).powi(2);
            let sure = found.iter().filter(|f| f.0 <= reach).count();
            if sure >= count.min(points.len()) || found.len() == points.len() {
                found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                found.truncate(count);
                return found.into_iter().map(|f| f.1).collect();
            }
            rings *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_are_the_nearest() {
        let points: Vec<DVec3> = (0..200)
            .map(|i| {
                let x = f64::from(i);
                DVec3::new((x * 1.7).sin(), (x * 2.9).cos(), (x * 0.3).sin())
            })
            .collect();
        for reach in [0.01, 0.1, 3.0] {
            let grid = Grid::new(&points, reach);
            for p in [DVec3::new(0.3, -0.2, 0.4), DVec3::new(9.0, 0.0, -7.0)] {
                let mut all: Vec<usize> = (0..points.len()).collect();
                all.sort_by(|&a, &b| points[a].distance(p).total_cmp(&points[b].distance(p)));
                assert_eq!(grid.nearest(p, 5, &points), all[..5]);
                assert_eq!(grid.nearest(p, 500, &points).len(), 200);
                let near: Vec<usize> = grid.near(p).collect();
                let rows: Vec<u32> = grid
                    .rows_within(p, 1.7 * reach)
                    .flat_map(|row| grid.order()[row].to_vec())
                    .collect();
                for (i, point) in points.iter().enumerate() {
                    let distance = point.distance(p);
                    assert!(distance > reach || near.contains(&i));
                    assert!(distance > 1.7 * reach || rows.contains(&(i as u32)));
                }
            }
        }
    }

    #[test]
    fn no_points_and_points_far_apart() {
        assert_eq!(Grid::new(&[], 0.1).near(DVec3::ONE).count(), 0);
        let far = [DVec3::ZERO, DVec3::splat(100.0), DVec3::new(0.0, 50.0, -3.0)];
        assert_eq!(Grid::new(&far, 1e-3).nearest(DVec3::splat(99.0), 1, &far), [1]);
    }
}
