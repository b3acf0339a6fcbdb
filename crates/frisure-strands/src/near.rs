//! Points near a point, on a surface.

use glam::{UVec3, Vec3};

/// Most cells along a side: with more the empty ones would take too much memory.
const MOST_CELLS: f32 = 128.0;

/// Points in a grid of cubes.
pub(crate) struct Near<'a> {
    points: &'a [Vec3],
    low: Vec3,
    /// Side of a cell (m).
    side: f32,
    cells: UVec3,
    /// Where the points of each cell begin in `items`.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl<'a> Near<'a> {
    /// Sorts points; none if they are all in one place.
    pub(crate) fn new(points: &'a [Vec3]) -> Option<Self> {
        let first = *points.first()?;
        let (low, high) = points.iter().fold((first, first), |(l, h), p| (l.min(*p), h.max(*p)));
        let extent = (high - low).max_element();
        // A head's worth of surface has then some two points in a cell.
        let side = extent / (0.5 * (points.len() as f32).sqrt()).clamp(1.0, MOST_CELLS);
        if !(side > 0.0) {
            return None;
        }
        let cells = ((high - low) / side).as_uvec3() + UVec3::ONE;
        let count = cells.to_array().map(|n| n as usize).iter().product();
        let mut near =
            Self { points, low, side, cells, starts: vec![0; count + 1], items: Vec::new() };
        let places: Vec<usize> = points.iter().map(|p| near.index(near.cell(*p))).collect();
        places.iter().for_each(|&at| near.starts[at + 1] += 1);
        (0..count).for_each(|i| near.starts[i + 1] += near.starts[i]);
        let mut next = near.starts.clone();
        near.items = vec![0; points.len()];
        for (i, &at) in places.iter().enumerate() {
            near.items[next[at] as usize] = i as u32;
            next[at] += 1;
        }
        Some(near)
    }

    fn cell(&self, p: Vec3) -> UVec3 {
        // The cast saturates: what is below the low corner is in the first cell.
        ((p - self.low) / self.side).as_uvec3().min(self.cells - 1)
    }

    fn index(&self, cell: UVec3) -> usize {
        let [x, y, z] = cell.to_array().map(|n| n as usize);
        (z * self.cells.y as usize + y) * self.cells.x as usize + x
    }

    /// Calls `visit` with each point within a distance (m), and its distance.
    pub(crate) fn within(&self, p: Vec3, reach: f32, mut visit: impl FnMut(usize, f32)) {
        let (from, to) = (self.cell(p - reach), self.cell(p + reach));
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                for x in from.x..=to.x {
                    let at = self.index(UVec3::new(x, y, z));
                    for &i in &self.items[self.starts[at] as usize..self.starts[at + 1] as usize] {
                        let distance = p.distance(self.points[i as usize]);
                        if distance <= reach {
                            visit(i as usize, distance);
                        }
                    }
                }
            }
        }
    }

    /// Area for each point around point `index` (m²): that of the disc to its `count`-th neighbour, over their number.
    pub(crate) fn area(&self, index: usize, count: usize) -> f32 {
        let count = count.min(self.points.len() - 1).max(1);
        let mut distances = Vec::new();
        let mut reach = self.side;
        let most = 2.0 * self.side * self.cells.max_element() as f32;
        loop {
            distances.clear();
            self.within(self.points[index], reach, |_, distance| distances.push(distance));
            // The point itself is one of them.
            if distances.len() > count || reach > most {
                break;
            }
            reach *= 1.6;
        }
        let at = count.min(distances.len() - 1);
        let distance = *distances.select_nth_unstable_by(at, f32::total_cmp).1;
        std::f32::consts::PI * distance * distance / count as f32
    }
}
