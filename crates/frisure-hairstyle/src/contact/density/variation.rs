//! The second derivative of the energy of density, as an operator.

use crate::parallel;
use glam::{DMat3, DVec3};

use super::hair::{Density, Pair};

/// The second derivative of the energy of density at one state of the head.
pub(crate) struct DensityVariation {
    starts: Vec<usize>,
    /// Where the pairs of each point begin; one more than points.
    firsts: Vec<u32>,
    pairs: Vec<Pair>,
    volume: Vec<f64>,
    /// Second derivative of a point's energy by its density (J).
    bulk: Vec<f64>,
    /// The part of it that each guide has in its own second variation (N/m).
    blocks: Vec<DMat3>,
}

impl Density {
    /// The second derivative where hair is now.
    pub(crate) fn variation(&self) -> DensityVariation {
        let count = self.points.len();
        let pairs = parallel::map(count, |k| {
            let mut pairs = Vec::new();
            self.for_each_pair(k, |pair| pairs.push(*pair));
            pairs
        });
        let mut firsts = Vec::with_capacity(count + 1);
        firsts.push(0);
        let mut total = 0;
        for pairs in &pairs {
            total += pairs.len() as u32;
            firsts.push(total);
        }
        let block = |k: usize| self.derivatives(k).map_or(DMat3::ZERO, |(_, block)| block);
        DensityVariation {
            starts: self.starts.clone(),
            firsts,
            pairs: pairs.concat(),
            volume: self.points.volume.clone(),
            bulk: (0..count).map(|k| self.by_density(k).1).collect(),
            blocks: parallel::map(count, block),
        }
    }
}

impl DensityVariation {
    fn of(&self, k: usize) -> &[Pair] {
        &self.pairs[self.firsts[k] as usize..self.firsts[k + 1] as usize]
    }

    /// For displacements (m) of all points, the change of force (N) at each that the second variations of guides do not have.
    pub(crate) fn forces(&self, moved: &[&[DVec3]]) -> Vec<Vec<DVec3>> {
        let moved: Vec<DVec3> = moved.iter().flat_map(|points| points.iter().copied()).collect();
        // 1. How density changes at each point, and with it the pressure.
        let pressure = |k: usize| {
            if self.bulk[k] == 0.0 {
                return 0.0;
            }
            let of = |pair: &Pair| {
                let l = pair.other as usize;
                self.volume[l] * pair.slope.dot(moved[k] - moved[l])
            };
            self.bulk[k] * self.of(k).iter().map(of).sum::<f64>()
        };
        let pressures = parallel::map(moved.len(), pressure);
        // 2. The force of that, and of pairs that turn and come nearer.
        let force = |k: usize| {
            let mut sum = DVec3::ZERO;
            for pair in self.of(k) {
                let l = pair.other as usize;
                let apart = moved[k] - moved[l];
                let squeezed = pressures[k] * self.volume[l] + pressures[l] * self.volume[k];
                let along = pair.along * pair.slope.dot(apart);
                sum += apart * pair.across + pair.slope * (along + squeezed);
            }
            sum - self.blocks[k] * moved[k]
        };
        let forces = parallel::map(moved.len(), force);
        self.starts.windows(2).map(|w| forces[w[0]..w[1]].to_vec()).collect()
    }
}
