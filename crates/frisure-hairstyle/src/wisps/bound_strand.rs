//! Strands of a groom that keep their own shapes: each is bound to the guides that are most like it.
//!
//! While guides are as the groom has them, each hair is where the groom has it, to the last point. When they
//! move, what a hair is away from each guide moves and turns with that guide's axis, as everywhere in a wisp.

use frisure_strands::Strands;
use glam::DVec3;

use super::wisp::Wisp;
use crate::math::Grid;
use crate::parallel;

/// Most guides that one strand is bound to, and among how many of the nearest they are searched. Chosen by trial.
const BINDINGS: usize = 3;
const SOUGHT: usize = 24;

/// Samples along guides as the groom has them. Chosen by trial; not measured further.
pub(crate) const WISP_SAMPLES: usize = 128;

/// Places along a hair at which it is compared with guides. Chosen by trial; not measured further.
const COMPARED: usize = 8;

/// Distance (m) below which a guide is as good as the hair itself. Chosen by trial; not measured further.
const ALIKE: f64 = 5e-4;

/// The hairs of a groom, with the guides that each is bound to.
#[derive(Debug)]
pub(crate) struct BoundStrands {
    hairs: Strands,
    /// Guides with weights that sum to one, the most alike first.
    bindings: Vec<Vec<(usize, f64)>>,
    /// The guides as the groom has them.
    pub(crate) wisps: Vec<Wisp>,
}

/// One hair of a groom, by arc length.
pub(crate) struct BoundStrand {
    points: Vec<DVec3>,
    /// Distance (m) from the root along the hair.
    arcs: Vec<f64>,
}

impl BoundStrand {
    fn new(points: impl Iterator<Item = DVec3>) -> Self {
        let points: Vec<DVec3> = points.collect();
        let mut s = 0.0;
        let arc = |k: usize| {
            s += if k > 0 { points[k - 1].distance(points[k]) } else { 0.0 };
            s
        };
        let arcs = (0..points.len()).map(arc).collect();
        Self { points, arcs }
    }

    /// Length along the hair (m).
    pub(crate) fn length(&self) -> f64 {
        self.arcs.last().copied().unwrap_or(0.0)
    }

    /// The point at a distance from the root (m), straight between those of the groom.
    pub(crate) fn at(&self, s: f64) -> DVec3 {
        let next = self.arcs.partition_point(|arc| *arc < s);
        if next == 0 {
            return self.points[0];
        }
        let Some(arc) = self.arcs.get(next) else { return self.points[next - 1] };
        let before = self.arcs[next - 1];
        self.points[next - 1].lerp(self.points[next], (s - before) / (arc - before).max(1e-12))
    }
}

impl BoundStrands {
    /// The hairs of a groom, and its guides as it has them.
    pub(crate) fn new(hairs: &Strands, wisps: Vec<Wisp>) -> Self {
        let roots: Vec<DVec3> = wisps.iter().map(|wisp| wisp.guide(&wisp.place(0.0))).collect();
        let (low, high) =
            roots.iter().fold((roots[0], roots[0]), |(l, h), p| (l.min(*p), h.max(*p)));
        let spacing = ((high - low).length() / (roots.len() as f64).sqrt()).max(1e-3);
        let grid = Grid::new(&roots, spacing);
        let bindings = parallel::map(hairs.len(), |hair| {
            let own = BoundStrand::new(hairs.strand(hair).points.iter().map(|p| p.as_dvec3()));
            bindings(&own, &grid.nearest(own.points[0], SOUGHT, &roots), &wisps)
        });
        Self { hairs: hairs.clone(), bindings, wisps }
    }

    pub(crate) fn len(&self) -> usize {
        self.hairs.len()
    }

    pub(crate) fn strand(&self, hair: usize) -> BoundStrand {
        BoundStrand::new(self.hairs.strand(hair).points.iter().map(|p| p.as_dvec3()))
    }

    pub(crate) fn bindings(&self, hair: usize) -> &[(usize, f64)] {
        &self.bindings[hair]
    }
}

/// The guides, of those given, whose curves are most like that of a hair, with weights.
fn bindings(own: &BoundStrand, near: &[usize], wisps: &[Wisp]) -> Vec<(usize, f64)> {
    let apart = |guide: usize| {
        let wisp = &wisps[guide];
        let square = |k: usize| {
            let s = own.length() * k as f64 / COMPARED as f64;
            own.at(s).distance_squared(wisp.guide(&wisp.place(s / wisp.length)))
        };
        let mean = (0..=COMPARED).map(square).sum::<f64>() / (COMPARED + 1) as f64;
        // The bound keeps a guide that is the hair itself from an infinite weight.
        (guide, mean + ALIKE * ALIKE)
    };
    let mut found: Vec<(usize, f64)> = near.iter().map(|&guide| apart(guide)).collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    found.truncate(BINDINGS);
    let nearest = found[0].1;
    // Inverse fourth power of the distance, relative to the nearest; what counts for less than a hundredth is left out.
    for binding in &mut found {
        binding.1 = (nearest / binding.1).powi(2);
    }
    found.retain(|binding| binding.1 > 1e-2);
    let sum: f64 = found.iter().map(|binding| binding.1).sum();
    found.iter_mut().for_each(|binding| binding.1 /= sum);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hair_by_arc_length() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::new(1.0, 2.0, 0.0)];
        let own = BoundStrand::new(points.into_iter());
        assert_eq!(own.length(), 3.0);
        assert_eq!(own.at(0.5), DVec3::new(0.5, 0.0, 0.0));
        assert_eq!(own.at(1.0), DVec3::X);
        assert_eq!(own.at(2.0), DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(own.at(9.0), points[3]);
        assert_eq!(own.at(-1.0), points[0]);
    }
}
