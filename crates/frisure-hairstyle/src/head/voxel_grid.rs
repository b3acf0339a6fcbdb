//! The nodes of a grid around a mesh, and what is known at those near it.

use glam::DVec3;

/// No face.
pub(crate) const NONE: u32 = u32::MAX;

/// The nodes.
#[derive(Debug, PartialEq)]
pub(crate) struct Grid {
    pub(crate) origin: DVec3,
    pub(crate) spacing: f64,
    pub(crate) size: [usize; 3],
}

/// What is known at one node near the mesh.
#[derive(Clone, Copy)]
pub(crate) struct Node {
    pub(crate) distance: f32,
    pub(crate) face: u32,
    /// Bit a: a face crosses the edge to the next node along axis a.
    pub(crate) crossed: u8,
}

/// A node that no face is near.
pub(crate) const FAR: Node = Node { distance: f32::INFINITY, face: NONE, crossed: 0 };

impl Grid {
    pub(crate) fn position(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        self.origin + self.spacing * DVec3::new(i as f64, j as f64, k as f64)
    }

    pub(crate) fn unravel(&self, at: usize) -> [usize; 3] {
        [at % self.size[0], at / self.size[0] % self.size[1], at / self.layer()]
    }

    /// Nodes of one layer.
    pub(crate) fn layer(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// Nodes of all layers.
    pub(crate) fn len(&self) -> usize {
        self.layer() * self.size[2]
    }
}
