//! Signed distances at the nodes of a grid: known near the mesh, and computed elsewhere where they are asked for.

use super::far::Coarse;
use super::triangles::Soup;
use super::voxel_grid::{Grid, NONE, Node};

/// Samples at the nodes of a grid, i fastest (m).
#[derive(Debug, PartialEq)]
pub(crate) struct Samples {
    pub(crate) grid: Grid,
    /// The signed distance (m) of a node near the mesh; of another one infinity, with its sign.
    near: Vec<f32>,
    /// How far the others are at least (m).
    reach: f32,
    far: Coarse,
}

impl Samples {
    /// What is known of the `nodes`, which lie `outside` or inside; those that no face came near are at least `reach` (m) away.
    pub(crate) fn new(
        grid: Grid,
        nodes: &[Node],
        outside: &[bool],
        soup: Soup,
        reach: f64,
    ) -> Self {
        let far = Coarse::around(&grid, nodes, soup);
        let near = nodes.iter().zip(outside).map(|(node, &outside)| {
            let distance = if node.face == NONE { f32::INFINITY } else { node.distance };
            if outside { distance } else { -distance }
        });
        Self { near: near.collect(), grid, reach: reach as f32, far }
    }

    /// The samples at the nodes of a box, from `low` to before `high`.
    pub(crate) fn of_box(&self, low: [usize; 3], high: [usize; 3]) -> Vec<f32> {
        let [width, depth, height] = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        let mut values = Vec::with_capacity(width * depth * height);
        for (k, j) in (low[2]..high[2]).flat_map(|k| (low[1]..high[1]).map(move |j| (k, j))) {
            let row = (k * self.grid.size[1] + j) * self.grid.size[0];
            values.extend_from_slice(&self.near[row + low[0]..row + high[0]]);
        }
        if values.iter().all(|value| value.is_finite()) {
            return values;
        }
        let outside = |at: usize| self.near[at] > 0.0;
        let known = |at: usize| Some(self.near[at]).filter(|value| value.is_finite());
        let far = self.far.interpolated(&self.grid, (low, high), known, outside);
        for (value, far) in values.iter_mut().zip(far).filter(|(value, _)| value.is_infinite()) {
            *value = if *value > 0.0 { far.max(self.reach) } else { far.min(-self.reach) };
        }
        values
    }
}
