//! How far a root is from the edge of the hair.

use glam::DVec3;

use crate::head::{Edge, Head};
use crate::math::Grid;

/// The edge of the hair: a natural hairline, or the border of the scalp that a mesh came with.
pub(crate) enum Rim {
    /// The line itself.
    Line(Box<Edge>),
    /// Bald points of the skin (m) next to hair.
    Border {
        /// The points, sorted into cells.
        grid: Grid,
        /// The points.
        points: Vec<DVec3>,
    },
}

impl Rim {
    /// Finds the edge of the hair, for distances up to `reach` (m).
    pub(crate) fn new(head: &Head, edge: Option<Edge>, reach: f64) -> Self {
        if let Some(edge) = edge {
            return Self::Line(Box::new(edge));
        }
        let weights = head.scalp();
        let grows = |v: &u32| weights[*v as usize] >= 0.5;
        let mut bald = vec![false; weights.len()];
        for triangle in head.surface().triangles() {
            if triangle.iter().any(grows) {
                for v in triangle.iter().filter(|v| !grows(v)) {
                    bald[*v as usize] = true;
                }
            }
        }
        let positions = head.surface().positions().iter().zip(bald);
        let points: Vec<_> = positions.filter_map(|(p, bald)| bald.then_some(*p)).collect();
        Self::Border { grid: Grid::new(&points, reach), points }
    }

    /// Distance (m) of a point of the scalp from the edge, exact within the reach; `most` (m) or more where it is farther.
    pub(crate) fn distance(&self, p: DVec3, most: f64) -> f64 {
        match self {
            // The plain line may be nearer than the hairline by what that has receded.
            Self::Line(edge) => edge.inside_within(p, most + edge.reach).max(0.0),
            Self::Border { grid, points } => {
                grid.near(p).map(|i| points[i].distance(p)).fold(f64::INFINITY, f64::min)
            }
        }
    }
}
