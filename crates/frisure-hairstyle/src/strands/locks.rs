//! The locks into which wet hair gathers: their sizes and where hairs meet, from the law of capillarity.

use super::splits::{Plan, Splits};
use crate::capillary::Coalescence;
use crate::hairstyle::COUNTED;
use crate::implantation::Root;
use crate::math::smooth_step;

/// Most sizes of locks: from pairs of hairs to the largest by equal factors.
const LEVELS: usize = 3;

/// Least number of hairs of a lock that is drawn. Chosen: two hairs make none.
const LEAST: f64 = 3.0;

/// Over which stretch hairs come together, in distances from the root to where they meet. Chosen: the shape of a beam that is
/// drawn to another, most of whose way is in the half before they touch.
const COMING: (f64, f64) = (0.4, 1.1);

/// Locks of all sizes, the largest first.
pub(super) struct Locks {
    pub(super) splits: Splits,
    /// Of each guide.
    guides: Vec<Option<WetGuide>>,
}

/// How hair of one guide gathers.
struct WetGuide {
    /// Distance (m) from the root at which locks of each level form; none where they do not.
    meeting: [Option<f64>; LEVELS],
    /// Distance of hairs in a lock over that of their roots.
    closeness: f64,
}

/// How a hair gathers to a lock.
#[derive(Clone, Copy)]
pub(super) struct WetGathering {
    meeting: f64,
    closeness: f64,
}

impl WetGathering {
    /// How much of the way to the middle of its lock a hair has come at the arc length `along` (m), where `width` is the distance
    /// of hairs over that of their roots without water.
    pub(super) fn share(self, along: f64, width: f64) -> f64 {
        let come = smooth_step(COMING.0 * self.meeting, COMING.1 * self.meeting, along);
        come * (1.0 - self.closeness / width.max(self.closeness))
    }
}

impl Locks {
    pub(super) const NONE: Self = Self { splits: Splits::NONE, guides: Vec::new() };

    /// Locks of hairs of which `water` tells how those of each guide gather, `grown` of them on the whole head; the largest have
    /// the size at [`COUNTED`]. `soaked`, how they would if all were soaked, says how hair is divided: locks open and close
    /// while hair dries, and do not change places.
    pub(super) fn new(
        plan: &Plan<'_>,
        grown: f64,
        water: &[Option<Coalescence>],
        soaked: impl Iterator<Item = Coalescence>,
        place: impl Fn(&Root) -> Root,
    ) -> Self {
        if water.iter().all(Option::is_none) {
            return Self::NONE;
        }
        // The mean of logarithms: sizes vary by factors.
        let sizes: Vec<f64> = soaked.map(|law| law.lock(COUNTED * law.length).ln()).collect();
        let mean = sizes.iter().sum::<f64>() / sizes.len().max(1) as f64;
        let size = |level: usize| (mean * (LEVELS - level) as f64 / LEVELS as f64).exp();
        let hairs = plan.hairs.len() as f64;
        // A lock that has fewer than two drawn hairs is none.
        let drawn = |size: &f64| *size > LEAST && grown / size < 0.5 * hairs;
        let sizes: Vec<f64> = (0..LEVELS).map(size).filter(drawn).collect();
        if sizes.is_empty() {
            return Self::NONE;
        }
        let counts: Vec<usize> =
            sizes.iter().map(|size| (grown / size).ceil().max(1.0) as usize).collect();
        let guide = |law: &Coalescence| {
            let mut meeting = [None; LEVELS];
            for (meeting, size) in meeting.iter_mut().zip(&sizes) {
                *meeting = law.meeting(Coalescence::bundle(*size));
            }
            WetGuide { meeting, closeness: law.area_per_hair().sqrt() / law.spacing }
        };
        Self {
            splits: Splits::of(plan, &counts, place),
            guides: water.iter().map(|law| law.as_ref().map(guide)).collect(),
        }
    }

    /// How hair of a guide gathers to locks of a level; none if it does not.
    pub(super) fn gathering(&self, guide: usize, level: usize) -> Option<WetGathering> {
        let WetGuide { meeting, closeness } = self.guides.get(guide)?.as_ref()?;
        Some(WetGathering { meeting: (*meeting.get(level)?)?, closeness: *closeness })
    }
}
