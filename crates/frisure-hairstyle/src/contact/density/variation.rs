//! The second derivative of the energy of density, as an operator.

use crate::parallel;
use glam::{DMat3, DVec3};

use super::hair::{Density, Pair};

/// The second derivative of the energy of density at one state of the head.
pub(crate) struct DensityVariation {
    starts: Vec<usize>,
    /// The pairs of each point.
    pairs: Vec<Pairs>,
    volume: Vec<f64>,
    /// Second derivative of a point's energy by its density (J).
    bulk: Vec<f64>,
    /// The part of it that each guide has in its own second variation (N/m).
    blocks: Vec<DMat3>,
}

/// The pairs of one point: what the change of density needs of them apart from the rest, since memory is what limits a product.
#[derive(Default)]
struct Pairs {
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

    /// The others and the slopes.
    fn iter(&self) -> impl Iterator<Item = (usize, DVec3)> + '_ {
        self.others.iter().map(|&l| l as usize).zip(self.slopes.iter().copied())
    }
}

impl Density {
    /// The second derivative where hair is now.
    pub(crate) fn variation(&self) -> DensityVariation {
        let count = self.points.len();
        let pairs = parallel::map(count, |k| {
            let mut pairs = Pairs::default();
            self.for_each_pair(k, |pair| pairs.push(pair));
            pairs
        });
        let block = |k: usize| self.derivatives(k).map_or(DMat3::ZERO, |(_, block)| block);
        DensityVariation {
            starts: self.starts.clone(),
            pairs,
            volume: self.points.sites.iter().map(|site| site.volume).collect(),
            bulk: (0..count).map(|k| self.by_density(k).1).collect(),
            blocks: parallel::map(count, block),
        }
    }
}

impl DensityVariation {
    /// For displacements (m) of all points, the change of force (N) at each that the second variations of guides do not have.
    pub(crate) fn forces(&self, moved: &[&[DVec3]]) -> Vec<Vec<DVec3>> {
        let moved: Vec<DVec3> = moved.iter().flat_map(|points| points.iter().copied()).collect();
        // 1. How density changes at each point, and with it the pressure.
        let pressure = |k: usize| {
            if self.bulk[k] == 0.0 {
                return 0.0;
            }
            let of = |(l, slope): (usize, DVec3)| self.volume[l] * slope.dot(moved[k] - moved[l]);
            self.bulk[k] * self.pairs[k].iter().map(of).sum::<f64>()
        };
        let pressures = parallel::map(moved.len(), pressure);
        // 2. The force of that, and of pairs that turn and come nearer.
        let force = |k: usize| {
            let mut sum = DVec3::ZERO;
            for ((l, slope), [across, along]) in self.pairs[k].iter().zip(&self.pairs[k].pressed) {
                let apart = moved[k] - moved[l];
                let squeezed = pressures[k] * self.volume[l] + pressures[l] * self.volume[k];
                sum += apart * *across + slope * (along * slope.dot(apart) + squeezed);
            }
            sum - self.blocks[k] * moved[k]
        };
        let forces = parallel::map(moved.len(), force);
        self.starts.windows(2).map(|w| forces[w[0]..w[1]].to_vec()).collect()
    }
}
