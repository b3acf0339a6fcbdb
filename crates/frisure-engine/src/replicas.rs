//! How far guides move when the scene changes by next to nothing: replicas of a hairstyle whose
//! lengths and curl are changed by a millionth.

use frisure::hairstyle::{Hairstyle, HairstyleSpec, RegionLength};
use frisure::progress::Progress;
use glam::DVec3;
use serde::Serialize;

use crate::error::Error;
use crate::hairstyles::{HairstyleCache, Input};
use crate::runner::{LoadedScene, Runner};

/// Largest relative change of the lengths and of the curl of a replica. Chosen: a quarter of a micrometre of 25 cm, which nobody can measure.
const CHANGE: f64 = 1e-6;

/// Distance (m) above which a guide has jumped to another place. Chosen: what the eye can see of a strand.
const JUMP: f64 = 5e-4;

/// Points at which a guide is compared. Chosen: every centimetre of long hair.
const POINTS: usize = 65;

/// How far guides lie from each other in replicas of a hairstyle.
#[derive(Clone, Debug, Serialize)]
pub struct ReplicaReport {
    /// Number of replicas.
    pub count: usize,
    /// Largest relative change of all lengths and of the natural curl: those of the replicas are spread between it and its negative.
    pub change: f64,
    /// Median over the guides of the spread (m).
    pub median: f64,
    /// The spread (m) that 99 of 100 guides stay below.
    pub percentile_99: f64,
    /// Largest spread (m).
    pub largest: f64,
    /// Number of guides whose spread is above 0.5 mm: they rest in another minimum.
    pub jumped: usize,
    /// Those guides, in their order: each snaps from one minimum to another.
    pub snaps: Vec<usize>,
    /// The spread (m) of each guide: the largest distance of a point of it in a replica from the point at the same part of its
    /// length in the hairstyle.
    pub spread: Vec<f64>,
}

impl Runner {
    /// Computes `count` replicas of a hairstyle, each with all lengths and the natural curl changed by another part of a millionth, and compares
    /// their guides with those of the hairstyle. Each takes as long as the hairstyle did.
    ///
    /// # Errors
    /// [`Error::Invalid`] for hair that comes from a groom, whose lengths are not described; those of the prediction and its
    /// steps; [`Error::Cancelled`].
    pub fn replicas(
        &self,
        loaded: &LoadedScene,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<ReplicaReport, Error> {
        let LoadedScene { scene, head, hairstyle, .. } = loaded;
        if scene.groom.is_some() {
            let problem =
                "replicas change the lengths of hair, and those of a groom are not described";
            return Err(Error::invalid(problem, "leave out `--replicas`"));
        }
        let lines = centre_lines(hairstyle);
        let mut spread = vec![0.0_f64; lines.len()];
        for replica in 0..count {
            let part = Part { of: progress, replica, count };
            let spec = changed(scene.hairstyle_spec()?, change(replica, count));
            let done = scene.steps().len();
            let input = Input { scene, spec, head, done, files: &self.files };
            // Of its own: a replica is computed from the start, and evicts nothing.
            let other = HairstyleCache::default().exact(&input, &part)?;
            for (most, (a, b)) in spread.iter_mut().zip(lines.iter().zip(centre_lines(&other))) {
                *most = a.iter().zip(b).map(|(a, b)| a.distance(b)).fold(*most, f64::max);
            }
        }
        Ok(ReplicaReport::of(count, spread))
    }
}

impl ReplicaReport {
    fn of(count: usize, spread: Vec<f64>) -> Self {
        let mut sorted = spread.clone();
        sorted.sort_by(f64::total_cmp);
        // The nearest rank: the smallest spread that this part of the guides does not exceed.
        let rank = |part: f64| {
            let rank = (part * sorted.len() as f64).ceil() as usize;
            sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
        };
        let snaps: Vec<usize> = (0..spread.len()).filter(|&i| spread[i] > JUMP).collect();
        Self {
            count,
            change: CHANGE,
            median: rank(0.5),
            percentile_99: rank(0.99),
            largest: rank(1.0),
            jumped: snaps.len(),
            snaps,
            spread,
        }
    }
}

/// The relative change of the lengths and of the curl of a replica: evenly spread, longer and shorter in turn, the last one the largest.
fn change(replica: usize, count: usize) -> f64 {
    let size = CHANGE * (replica + 1) as f64 / count as f64;
    if (count - replica).is_multiple_of(2) { -size } else { size }
}

/// The description with all lengths and the natural curl changed: hair that reaches down to a level has no length of its own.
fn changed(mut spec: HairstyleSpec, change: f64) -> HairstyleSpec {
    spec.length.mean *= 1.0 + change;
    spec.curl.strain *= 1.0 + change;
    for region in &mut spec.regions {
        if let Some(RegionLength::Mean(length)) = &mut region.length {
            *length *= 1.0 + change;
        }
    }
    spec
}

fn centre_lines(hairstyle: &Hairstyle) -> Vec<Vec<DVec3>> {
    hairstyle.equilibria().iter().map(|guide| guide.centre_line(POINTS)).collect()
}

/// The progress of one of several replicas.
struct Part<'a> {
    of: &'a dyn Progress,
    replica: usize,
    count: usize,
}

impl Progress for Part<'_> {
    fn report(&self, stage: &str, fraction: f64) {
        let Self { of, replica, count } = self;
        of.report(&format!("replica {} of {count}: {stage}", replica + 1), fraction);
    }

    fn is_cancelled(&self) -> bool {
        self.of.is_cancelled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    use crate::quality::Quality;
    use frisure::scene::Scene;

    fn replicas(contact: &str) -> (ReplicaReport, Arc<Hairstyle>) {
        let text = format!(
            "[hair]\ntype = 'wavy'\nlength = '10 cm'\n[wisps]\ncount = 12\nhairs = 30\n[contact]\nhair = '{contact}'\n[[step]]\nwet = {{}}\n"
        );
        let scene = Arc::new(Scene::parse("short", &text, "".as_ref()).unwrap());
        let mut runner = Runner::default();
        let loaded = runner.load(&scene, 1, Quality::Exact, &()).unwrap();
        (runner.replicas(&loaded, 3, &()).unwrap(), loaded.hairstyle)
    }

    #[test]
    fn guides_that_do_not_touch_move_by_the_change_of_their_length() {
        let (report, hairstyle) = replicas("none");
        let longest = hairstyle.guides().iter().map(|g| g.rod.length()).fold(0.0, f64::max);
        assert_eq!((report.count, report.spread.len(), report.jumped), (3, 12, 0));
        assert!(report.median > 0.0 && report.median <= report.percentile_99);
        // A hair that is longer by δ L is bent by about as much more, unless it is near a fold: some times δ L.
        assert!(report.largest < 30.0 * CHANGE * longest, "{report:?}");
    }

    #[test]
    fn changes_are_spread_and_none_is_zero() {
        let changes: Vec<f64> = (0..4).map(|i| change(i, 4)).collect();
        assert_eq!(changes, [-0.25e-6, 0.5e-6, -0.75e-6, 1e-6].map(|x: f64| x * CHANGE / 1e-6));
        assert_eq!(change(0, 1), CHANGE);
    }

    #[test]
    fn ranks_are_the_nearest() {
        let report = ReplicaReport::of(1, vec![3e-3, 1e-6, 2e-6]);
        assert_eq!((report.median, report.percentile_99, report.largest), (2e-6, 3e-3, 3e-3));
        assert_eq!((report.jumped, report.snaps), (1, vec![0]));
    }
}
