//! Which vertices of a mesh are one, and which of its parts hang together.

use std::collections::BTreeMap;

use glam::DVec3;

/// Vertices nearer to each other (m) are one: meshes have seams, where vertices are written twice.
const SEAM: f64 = 5e-5;

/// For each vertex the first one at its place.
pub(super) fn joined(places: &[DVec3]) -> Vec<u32> {
    let cell = |p: DVec3| (p / (2.0 * SEAM)).floor().as_ivec3().to_array();
    let mut cells: BTreeMap<[i32; 3], Vec<u32>> = BTreeMap::new();
    let mut same = Vec::with_capacity(places.len());
    for (i, &p) in places.iter().enumerate() {
        // A vertex within `SEAM` lies in one of the eight cells about the corner that is nearest.
        let [x, y, z] = cell(p - SEAM);
        let near = (0..8).flat_map(|k| {
            let at = [x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)];
            cells.get(&at).into_iter().flatten()
        });
        let found = near.copied().find(|&v| places[v as usize].distance_squared(p) <= SEAM * SEAM);
        let first = found.unwrap_or(i as u32);
        if found.is_none() {
            cells.entry(cell(p)).or_default().push(i as u32);
        }
        same.push(first);
    }
    same
}

/// Disjoint sets of numbers.
pub(super) struct Sets(Vec<u32>);

impl Sets {
    pub(super) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The number that stands for the set of another.
    pub(super) fn of(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let above = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = above;
            i = above;
        }
        i
    }

    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
