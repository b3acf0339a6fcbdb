//! The way that hair lies over the skin, and how much of it is over skin that grows hair.

use glam::DVec3;

use super::Layout;
use super::roots::Root;
use crate::head::{Edge, Head};
use crate::math::Grid;
use crate::spec::HairstyleSpec;

/// Length (m) of a step along the skin: a third of the distance of guides. Chosen; no result depends on it much.
const STEP: f64 = 5e-3;

/// Longest way (m): a quarter of the great circle of a head, which is the way down from the crown and the most that Lee & Ko's
/// altitude gives. Hair that is combed over the crown lies on no more than hair of the crown itself.
const LONGEST: f64 = 0.15;

/// Way (m) without hair after which no more of it is looked for: an ear is narrower. Chosen by eye.
const LEFT: f64 = 0.05;

/// Where hair grows on a head.
enum Growth<'a> {
    /// Inside a natural hairline.
    Line(Box<Edge>),
    /// As vertices have it.
    Vertices { grid: Grid, positions: &'a [DVec3], weights: &'a [f64] },
}

/// The ways of hair over a head.
pub(crate) struct Ways<'a> {
    head: &'a Head,
    layout: &'a Layout,
    growth: Growth<'a>,
}

impl<'a> Ways<'a> {
    pub(crate) fn new(spec: &HairstyleSpec, head: &'a Head, layout: &'a Layout) -> Self {
        let growth = head.edge(&spec.implantation.hairline, spec.seed).map_or_else(
            || {
                let positions = head.surface().positions();
                Growth::Vertices {
                    grid: Grid::new(positions, STEP),
                    positions,
                    weights: head.scalp(),
                }
            },
            |edge| Growth::Line(Box::new(edge)),
        );
        Self { head, layout, growth }
    }

    /// How much (m) of the way of a hair of some `length` (m) is over skin that grows hair, if it lies as its neighbours do: along the
    /// flow of the hair, step by step. What is rooted there lies beneath it.
    pub(crate) fn over_hair(&self, root: &Root, length: f64) -> f64 {
        let skin = self.head.signed_distance();
        let (mut at, mut over, mut bare) = (*root, 0.0, 0.0);
        // The last step is what is left, so that the way is a continuous function of the length.
        let mut left = length.min(LONGEST);
        while left > 0.0 && bare < LEFT {
            let step = STEP.min(left);
            left -= step;
            let along = self.layout.along(&at).0;
            // Where the flow has no direction, hair stands up.
            let Some(along) = along.try_normalize() else { break };
            let ahead = at.position + along * step;
            let (distance, away) = skin.value_gradient(ahead);
            let normal = away.normalize_or(at.normal);
            at = Root { position: ahead - normal * distance, normal };
            let here = self.density(at.position);
            over += here * step;
            bare = if here > 0.0 { 0.0 } else { bare + step };
        }
        over
    }

    /// How densely hair grows at a point (m) of the skin, 0 to 1.
    fn density(&self, p: DVec3) -> f64 {
        match &self.growth {
            Growth::Line(edge) => edge.density(p),
            Growth::Vertices { grid, positions, weights } => {
                weights[grid.nearest(p, 1, positions)[0]]
            }
        }
    }
}
