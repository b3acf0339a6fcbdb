//! The second derivative of the energy of density, as an operator.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::parallel;
use glam::{DMat3, DVec3};

use super::hair::{Density, Pair};

/// The derivatives of the energy of density at one state of the head.
pub(crate) struct DensityVariation {
    starts: Vec<usize>,
    /// The pairs of the points of each guide.
    pairs: Vec<Pairs>,
    volume: Vec<f64>,
    /// Second derivative of a point's energy by its density (J).
    bulk: Vec<f64>,
    /// [`Density::derivatives`] of each point.
    derivatives: Vec<Option<(DVec3, DMat3)>>,
}

/// The pairs of the points of one guide: what the change of density needs of them apart from the rest, since memory is what limits a
/// product.
#[derive(Default)]
struct Pairs {
    /// Where those of each point begin; one more than points.
    starts: Vec<u32>,
    others: Vec<u32>,
    /// [`Pair::slope`]
    slopes: Vec<DVec3>,
    /// [`Pair::across`] and [`Pair::along`]
    pressed: Vec<[f64; 2]>,
}

impl Pairs {
    fn push(&mut self, pair: &Pair) {
        self.others.push(pair.other);
        self.slopes.push(pair.slope);
        self.pressed.push([pair.across, pair.along]);
    }

    /// What is pushed from now on is of the next point.
    fn begin_point(&mut self) {
        self.starts.push(self.others.len() as u32);
    }

    fn finish(mut self) -> Self {
        self.begin_point();
        // Where many guides press on each other these lists are the largest part of the memory.
        self.others.shrink_to_fit();
        self.slopes.shrink_to_fit();
        self.pressed.shrink_to_fit();
        self
    }

    /// The others of a point of the guide, their slopes and how they are pressed.
    fn of_point(&self, i: usize) -> impl Iterator<Item = (usize, DVec3, [f64; 2])> + '_ {
        let range = self.starts[i] as usize..self.starts[i + 1] as usize;
        let others = self.others[range.clone()].iter().map(|&l| l as usize);
        let slopes = self.slopes[range.clone()].iter().copied();
        others.zip(slopes).zip(&self.pressed[range]).map(|((l, slope), of)| (l, slope, *of))
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
                felt.then(|| self.derivatives_with(k, |pair| pairs.push(pair))).flatten()
            });
            let derivatives: Vec<_> = derivatives.collect();
            (pairs.finish(), derivatives)
        };
        let (pairs, derivatives): (Vec<_>, Vec<_>) =
            parallel::map(self.starts.len() - 1, of_guide).into_iter().unzip();
        DensityVariation {
            starts: self.starts.clone(),
            pairs,
            volume: self.points.sites.iter().map(|site| site.volume).collect(),
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
        let moved: Vec<DVec3> = moved.iter().flat_map(|points| points.iter().copied()).collect();
        let points = |guide: usize| (self.starts[guide]..self.starts[guide + 1]).enumerate();
        // 1. How density changes at each point, and with it the pressure.
        let pressures = parallel::map(self.pairs.len(), |guide| {
            let pressure = |(i, k): (usize, usize)| {
                if self.bulk[k] == 0.0 {
                    return 0.0;
                }
                let of = |(l, slope, _): (usize, DVec3, _)| {
                    self.volume[l] * slope.dot(moved[k] - moved[l])
                };
                self.bulk[k] * self.pairs[guide].of_point(i).map(of).sum::<f64>()
            };
            points(guide).map(pressure).collect::<Vec<f64>>()
        });
        let pressures = pressures.concat();
        // 2. The force of that, and of pairs that turn and come nearer.
        parallel::map(self.pairs.len(), |guide| {
            let force = |(i, k): (usize, usize)| {
                let Some((_, block)) = self.derivatives[k] else { return DVec3::ZERO };
                let mut sum = DVec3::ZERO;
                for (l, slope, [across, along]) in self.pairs[guide].of_point(i) {
                    let apart = moved[k] - moved[l];
                    let squeezed = pressures[k] * self.volume[l] + pressures[l] * self.volume[k];
                    sum += apart * across + slope * (along * slope.dot(apart) + squeezed);
                }
                sum - block * moved[k]
            };
            points(guide).map(force).collect()
        })
    }
}
