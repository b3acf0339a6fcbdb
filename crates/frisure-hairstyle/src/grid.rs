//! Points sorted into cells of a coarse grid, to find near ones.

use std::collections::BTreeMap;

use glam::{DVec3, IVec3};

/// A grid whose cells are as wide as the reach of a search.
pub(crate) struct Grid {
    cell: f64,
    cells: BTreeMap<[i32; 3], Vec<usize>>,
}

impl Grid {
    /// Sorts points (m) for searches within `reach` (m).
    pub(crate) fn new(points: impl Iterator<Item = DVec3>, reach: f64) -> Self {
        let cell = reach.max(1e-6);
        let mut cells: BTreeMap<[i32; 3], Vec<usize>> = BTreeMap::new();
        for (i, p) in points.enumerate() {
            cells.entry(key(p, cell).to_array()).or_default().push(i);
        }
        Self { cell, cells }
    }

    /// Indices of all points within reach of `p`, and of some that are farther.
    pub(crate) fn near(&self, p: DVec3) -> impl Iterator<Item = usize> + '_ {
        self.within(p, 1)
    }

    /// Indices of all points within `rings` reaches of `p`, and of some that are farther.
    pub(crate) fn within(&self, p: DVec3, rings: i32) -> impl Iterator<Item = usize> + '_ {
        let centre = key(p, self.cell);
        let range = move || -rings..=rings;
        range()
            .flat_map(move |x| range().flat_map(move |y| range().map(move |z| IVec3::new(x, y, z))))
            .filter_map(move |d| self.cells.get(&(centre + d).to_array()))
            .flatten()
            .copied()
    }

    /// The `count` points nearest to `p`, nearest first; fewer if there are fewer.
    pub(crate) fn nearest(&self, p: DVec3, count: usize, points: &[DVec3]) -> Vec<usize> {
        let mut rings = 1;
        loop {
            let mut found: Vec<_> =
                self.within(p, rings).map(|i| (points[i].distance_squared(p), i)).collect();
            let reach = (self.cell * f64::from(rings)).powi(2);
            let sure = found.iter().filter(|f| f.0 <= reach).count();
            if sure >= count.min(points.len()) || rings > 64 {
                found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                found.truncate(count);
                return found.into_iter().map(|f| f.1).collect();
            }
            rings *= 2;
        }
    }
}

fn key(p: DVec3, cell: f64) -> IVec3 {
    (p / cell).floor().as_ivec3()
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
        let grid = Grid::new(points.iter().copied(), 0.1);
        let p = DVec3::new(0.3, -0.2, 0.4);
        let mut all: Vec<usize> = (0..points.len()).collect();
        all.sort_by(|&a, &b| points[a].distance(p).total_cmp(&points[b].distance(p)));
        assert_eq!(grid.nearest(p, 5, &points), all[..5]);
        assert_eq!(grid.nearest(p, 500, &points).len(), 200);
    }
}
