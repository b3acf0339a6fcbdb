//! The second derivative of the energy of density, as an operator.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::parallel;
use glam::{DMat3, DVec3};

use super::hair::{Density, Site};
use super::lanes::{CloseRun, Pressed, SiteLanes, VectorLanes};
use crate::contact::sieve;

/// The derivatives of the energy of density at one state of the head.
pub(crate) struct DensityVariation {
    starts: Vec<usize>,
    sites: Vec<Site>,
    lanes: SiteLanes,
    /// What the points of each guide press on.
    pairs: Vec<Pairs>,
    /// First and second derivative of a point's energy by its density (J); after the last point there are as many more as are summed at once.
    pressure: Vec<f64>,
    bulk: Vec<f64>,
    /// [`Density::derivatives`] of each point.
    derivatives: Vec<Option<(DVec3, DMat3)>>,
}

/// What the points of one guide press on. What a pair does is computed each time: it takes less than to read it from memory.
#[derive(Default)]
struct Pairs {
    /// Where the runs of each point begin; one more than points.
    starts: Vec<u32>,
    runs: Vec<CloseRun>,
}

impl Pairs {
    /// Adds to what the last point presses on.
    fn push(&mut self, other: u32) {
        let begins = self.starts.last().is_none_or(|&start| self.runs.len() == start as usize);
        match self.runs.last_mut() {
            Some(last)
                if !begins && (last.first..last.first + sieve::LANES as u32).contains(&other) =>
            {
                last.close |= 1 << (other - last.first);
            }
            _ => self.runs.push(CloseRun { first: other, close: 1 }),
        }
    }

    /// What is pushed from now on is of the next point.
    fn begin_point(&mut self) {
        self.starts.push(self.runs.len() as u32);
    }

    fn finish(mut self) -> Self {
        self.begin_point();
        self.runs.shrink_to_fit();
        self
    }

    /// What a point of the guide presses on.
    fn of_point(&self, i: usize) -> &[CloseRun] {
        &self.runs[self.starts[i] as usize..self.starts[i + 1] as usize]
    }
}

impl Density {
    /// The derivatives where hair is now.
    pub(crate) fn variation(&self) -> DensityVariation {
        let (count, felt) = (self.points.len(), self.felt());
        let of_guide = |guide: usize| {
            let mut pairs = Pairs::default();
            let derivatives = self.of_guide(guide).map(|k| {
                pairs.begin_point();
                let felt = felt[k].load(Ordering::Relaxed);
                felt.then(|| self.derivatives_with(k, |pair| pairs.push(pair.other))).flatten()
            });
            let derivatives: Vec<_> = derivatives.collect();
            (pairs.finish(), derivatives)
        };
        let (pairs, derivatives): (Vec<_>, Vec<_>) =
            parallel::map(self.starts.len() - 1, of_guide).into_iter().unzip();
        DensityVariation {
            starts: self.starts.clone(),
            sites: self.points.sites.clone(),
            lanes: self.lanes.clone(),
            pairs,
            pressure: padded(self.pressure.clone()),
            bulk: (0..count).map(|k| self.by_density(k).1).collect(),
            derivatives: derivatives.concat(),
        }
    }

    /// Which points are pressed, or close to one that is: of most heads a small part.
    fn felt(&self) -> Vec<AtomicBool> {
        let felt: Vec<AtomicBool> =
            (0..self.points.len()).map(|_| AtomicBool::new(false)).collect();
        parallel::map(self.starts.len() - 1, |guide| {
            for k in self.of_guide(guide).filter(|&k| self.by_density(k).0 > 0.0) {
                // No order of threads matters: all write the same.
                felt[k].store(true, Ordering::Relaxed);
                self.for_each_close(k, |l| felt[l].store(true, Ordering::Relaxed));
            }
        });
        felt
    }
}

impl DensityVariation {
    /// [`Density::derivatives`] of a point.
    pub(super) fn derivatives(&self, k: usize) -> Option<(DVec3, DMat3)> {
        self.derivatives[k]
    }

    /// For displacements (m) of all points, the change of force (N) at each that the second variations of guides do not have.
    pub(crate) fn forces(&self, moved: &[&[DVec3]]) -> Vec<Vec<DVec3>> {
        let all = moved.iter().flat_map(|points| points.iter().copied());
        let all = VectorLanes::new(all, self.sites.len());
        let points = |guide: usize| (self.starts[guide]..self.starts[guide + 1]).enumerate();
        // 1. How density changes at each point, and with it the pressure.
        let changes = parallel::map(self.pairs.len(), |guide| {
            let change = |(i, k): (usize, usize)| {
                if self.bulk[k] == 0.0 {
                    return 0.0;
                }
                let (moved, runs) = ((moved[guide][i], &all), self.pairs[guide].of_point(i));
                self.bulk[k] * self.lanes.density_change(&self.sites[k], moved, runs)
            };
            points(guide).map(change).collect::<Vec<f64>>()
        });
        let changes = padded(changes.concat());
        // 2. The force of that, and of pairs that turn and come nearer.
        parallel::map(self.pairs.len(), |guide| {
            let force = |(i, k): (usize, usize)| {
                let Some((_, block)) = self.derivatives[k] else { return DVec3::ZERO };
                let own = Pressed {
                    site: &self.sites[k],
                    moved: moved[guide][i],
                    pressure: self.pressure[k],
                    change: changes[k],
                };
                let runs = self.pairs[guide].of_point(i);
                self.lanes.force(&own, &all, [&self.pressure, &changes], runs) - block * own.moved
            };
            points(guide).map(force).collect()
        })
    }
}

/// The numbers of all points, with as many more as are summed at once.
fn padded(mut numbers: Vec<f64>) -> Vec<f64> {
    numbers.resize(numbers.len() + sieve::LANES, 0.0);
    numbers
}
