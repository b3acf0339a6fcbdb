//! The thinner wisps into which hair splits: two levels, of sizes that vary, each a strand that hairs gather to.
//!
//! Splits lie on the scalp and not in wisps: one between two guides follows both, so that hair does not part where the
//! patches of two wisps meet. Real hair gathers at several sizes (Choe & Ko 2005 have one, Ward et al. 2007, *A survey on
//! hair modeling*, §3, name the hierarchies of wisps that others use).

use std::f64::consts::PI;
use std::sync::OnceLock;

use glam::{DVec3, Vec3};

use super::winding::{OwnCurl, Winding};
use crate::implantation::{Layout, Root};
use crate::math::Grid;
use crate::random::{Purpose, Stream};
use crate::spec::Wisps;
use crate::wisps::Waves;

/// How far a split strays from its place, as a fraction of fuzziness times the radius of its patch.
/// Chosen by eye; not measured.
const STRAY: f64 = 0.5;

/// How many splits near a root are looked at: with widths that vary the nearest may be thin. Chosen by trial; not measured
/// further.
const SOUGHT: usize = 8;

/// The loosest split's share of the gathering that is asked for; others are even between it and all. Chosen by eye; not
/// measured.
const LOOSEST: f64 = 0.4;

/// How far the curls of small splits are out of step with those of the large split that they are in, as a share of how far
/// the latter are among each other. Chosen by eye; not measured.
const WITHIN: f64 = 0.35;

/// One split.
pub(super) struct Split {
    pub(super) root: Root,
    /// How much wider than others it is.
    width: f64,
    /// How much of the way to its middle hair has come at the tip.
    pub(super) clumping: f64,
    pub(super) curl: OwnCurl,
    /// Deviation in the frame of the head.
    pub(super) waves: Waves,
    /// Its line, once it was computed.
    pub(super) line: OnceLock<SplitLine>,
}

/// The line of a split.
pub(super) struct SplitLine {
    /// The guide that it follows most.
    pub(super) followed: usize,
    /// How it curls.
    pub(super) winding: Winding,
    /// How far along its guides it is known, 1 for the tip.
    end: f64,
    points: Box<[Vec3]>,
}

impl SplitLine {
    /// The line through evenly spaced points, from the root to `end` of the length of its guides, with the guide that it follows most.
    pub(super) fn new(followed: usize, winding: Winding, end: f64, points: Box<[Vec3]>) -> Self {
        Self { followed, winding, end, points }
    }

    /// Where (m) it is at `x` of the length of its guides.
    pub(super) fn at(&self, x: f64) -> DVec3 {
        let last = self.points.len() - 1;
        let place = (x / self.end).clamp(0.0, 1.0) * last as f64;
        let i = (place as usize).min(last - 1);
        self.points[i].as_dvec3().lerp(self.points[i + 1].as_dvec3(), place - i as f64)
    }
}

/// Splits of one size.
pub(super) struct Level {
    splits: Vec<Split>,
    roots: Vec<DVec3>,
    grid: Grid,
}

/// Of which level a split is, and which it is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SplitId {
    pub(super) level: usize,
    index: usize,
}

/// All splits of a head, the largest first: none, large ones, or large and small ones; of wet hair its locks.
pub(super) struct Splits(Vec<Level>);

/// What the splits of a head are made from.
pub(super) struct Plan<'a> {
    pub(super) wisps: &'a Wisps,
    pub(super) seed: u64,
    /// Where drawn hairs are rooted.
    pub(super) hairs: &'a [Root],
    /// Weighted area of the scalp (m²).
    pub(super) area: f64,
    /// Mean length of guides (m).
    pub(super) length: f64,
    /// What is drawn at random.
    pub(super) purpose: Purpose,
}

impl Splits {
    /// No splits.
    pub(super) const NONE: Self = Self(Vec::new());

    pub(super) fn new(plan: &Plan<'_>, place: impl Fn(&Root) -> Root) -> Self {
        let Plan { wisps, hairs, .. } = plan;
        if wisps.splits < 2 || hairs.is_empty() {
            return Self::NONE;
        }
        let large = wisps.count.saturating_mul(wisps.splits).min(hairs.len());
        let small = large.saturating_mul(wisps.subsplits).min(hairs.len());
        let counts = if small > large { vec![large, small] } else { vec![large] };
        Self::of(plan, &counts, place)
    }

    /// Splits of as many of each level.
    pub(super) fn of(plan: &Plan<'_>, counts: &[usize], place: impl Fn(&Root) -> Root) -> Self {
        let level = |(level, &count): (usize, &usize)| {
            // Two numbers for each split: so it has been since there were two levels.
            plan.level(level, counts.len().max(2), count, &place)
        };
        Self(counts.iter().enumerate().map(level).collect())
    }

    /// The split of the smallest size that hair rooted at a point of the skin belongs to.
    pub(super) fn smallest(&self, layout: &Layout, p: DVec3) -> Option<SplitId> {
        self.of_level(self.0.len().checked_sub(1)?, layout, p)
    }

    /// The split of a level that hair rooted at a point of the skin belongs to.
    pub(super) fn of_level(&self, level: usize, layout: &Layout, p: DVec3) -> Option<SplitId> {
        let Level { splits, roots, grid } = &self.0[level];
        // A multiplicatively weighted Voronoi diagram: the wider a split, the farther it reaches.
        let far = |i: usize| roots[i].distance_squared(p) / (splits[i].width * splits[i].width);
        let near = grid.nearest(p, SOUGHT, roots).into_iter();
        let mut near: Vec<_> = near.map(|i| (far(i), i)).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let together = |i: usize| !layout.divides() || !layout.apart(p, p, roots[i]);
        let found = near.into_iter().map(|(_, i)| i).find(|&i| together(i))?;
        Some(SplitId { level, index: found })
    }

    pub(super) fn get(&self, id: SplitId) -> &Split {
        &self.0[id.level].splits[id.index]
    }
}

impl Plan<'_> {
    fn level(
        &self,
        level: usize,
        levels: usize,
        count: usize,
        place: &impl Fn(&Root) -> Root,
    ) -> Level {
        let hairs = self.hairs;
        // Roots of drawn hairs lie one in each of as many strata of equal area, neighbours one after the other.
        let root = |i: usize| place(&hairs[i * hairs.len() / count]);
        let patch = (self.area / count as f64 / PI).sqrt();
        let share = if level == 0 { 1.0 } else { WITHIN };
        let split = |i: usize| {
            let mut random = Stream::new(self.seed, self.purpose, levels * i + level);
            let w = self.wisps;
            Split {
                root: root(i),
                width: random.factor(w.split_variation),
                clumping: w.split_clumping * random.between(LOOSEST, 1.0),
                curl: OwnCurl::new(w.split_phase * share, w.radius_variation, &mut random),
                waves: Waves::new(STRAY * w.fuzziness * patch, self.length, &mut random),
                line: OnceLock::new(),
            }
        };
        let splits: Vec<Split> = (0..count).map(split).collect();
        let roots: Vec<DVec3> = splits.iter().map(|s| s.root.position).collect();
        let grid = Grid::new(&roots, (self.area / count as f64).sqrt());
        Level { splits, roots, grid }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::Head;
    use crate::{Hairs, preset};

    /// Numbers of hairs of all splits of a level.
    fn sizes(variation: f64, level: usize) -> Vec<f64> {
        let head = Head::mannequin();
        let mut spec = preset("wavy").unwrap().spec();
        spec.wisps.count = 50;
        spec.wisps.hairs = Hairs::Count(12_000);
        spec.wisps.split_variation = variation;
        let layout = Layout::new(&spec, &head).unwrap();
        let scalp = crate::implantation::Scalp::grown(&head, &spec);
        let hairs = scalp.stratified(12_000, 1, Purpose::HairRoots);
        let (area, length) = (scalp.area(), spec.length.mean);
        let purpose = Purpose::Split;
        let plan = Plan { wisps: &spec.wisps, seed: 1, hairs: &hairs, area, length, purpose };
        let splits = Splits::new(&plan, |root| *root);
        let mut sizes = vec![0.0; splits.0[level].splits.len()];
        for hair in &hairs {
            sizes[splits.of_level(level, &layout, hair.position).unwrap().index] += 1.0;
        }
        sizes
    }

    #[test]
    fn splits_have_the_asked_number_and_sizes_that_vary_as_asked() {
        for level in [0, 1] {
            let deviation = |variation: f64| {
                let sizes = sizes(variation, level);
                let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
                let square = sizes.iter().map(|n| (n / mean - 1.0).powi(2)).sum::<f64>();
                (sizes.len(), (square / sizes.len() as f64).sqrt())
            };
            let ((count, even), (_, varied)) = (deviation(0.0), deviation(0.5));
            assert_eq!(count, [50 * 8, 50 * 8 * 6][level]);
            assert!(varied > even + 0.2, "level {level}: {even} {varied}");
        }
    }
}
