//! Density at a point, summed over several points at once.
//!
//! A sum is the same to the bit whatever the instruction set: no operation is fused with another.

use fearless_simd::{
    Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f64x4, mask64x4,
};

use super::kernel::WENDLAND;
use super::site::Site;
use crate::contact::sieve;

/// Points that are summed at once: half of those of a run.
const LANES: usize = 4;

/// What the density at other points needs of all points, quantity by quantity; after the last point there are as many more as are
/// summed at once.
pub(super) struct SiteLanes {
    level: Level,
    /// Coordinates (m).
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
    /// [`Site::half_reach`] (m)
    half_reach: Vec<f64>,
    /// [`Site::volume`] (m³)
    volume: Vec<f64>,
}

/// Points in a row, and which of them count: bit i is set for point i.
#[derive(Clone, Copy)]
pub(super) struct CloseRun {
    pub(super) first: usize,
    pub(super) close: u8,
}

impl SiteLanes {
    pub(super) fn new(sites: &[Site]) -> Self {
        let zero = || vec![0.0; sites.len() + sieve::LANES];
        let [x, y, z, half_reach, volume] = [zero(), zero(), zero(), zero(), zero()];
        let mut lanes = Self { level: Level::new(), x, y, z, half_reach, volume };
        for (k, site) in sites.iter().enumerate() {
            lanes.half_reach[k] = site.half_reach;
            lanes.volume[k] = site.volume;
            lanes.place_point(k, site);
        }
        lanes
    }

    /// Moves a point to where its site is.
    pub(super) fn place_point(&mut self, k: usize, site: &Site) {
        [self.x[k], self.y[k], self.z[k]] = site.position.to_array();
    }

    /// Fraction of space that the hair of the runs takes at a site: Σ V W. docs/theory.md (D1)
    pub(super) fn density(&self, own: &Site, runs: &[CloseRun]) -> f64 {
        dispatch!(self.level, simd => self.sum(simd, own, runs))
    }

    /// The same with the instruction set that `dispatch!` selects; `inline(always)` is what makes it so.
    #[inline(always)]
    fn sum<S: Simd>(&self, simd: S, own: &Site, runs: &[CloseRun]) -> f64 {
        let [x, y, z] = own.position.to_array().map(
            #[inline(always)]
            |c| f64x4::splat(simd, c),
        );
        let (none, one) = (f64x4::splat(simd, 0.0), f64x4::splat(simd, 1.0));
        let mut sum = none;
        for run in runs {
            for half in 0..sieve::LANES / LANES {
                let close = u64::from(run.close) >> (half * LANES) & 0b1111;
                if close == 0 {
                    continue;
                }
                let from = run.first + half * LANES;
                let lanes = from..from + LANES;
                let x = x - f64x4::from_slice(simd, &self.x[lanes.clone()]);
                let y = y - f64x4::from_slice(simd, &self.y[lanes.clone()]);
                let z = z - f64x4::from_slice(simd, &self.z[lanes.clone()]);
                let half_reach = f64x4::from_slice(simd, &self.half_reach[lanes.clone()]);
                let volume = f64x4::from_slice(simd, &self.volume[lanes]);
                // [`super::kernel::Kernel::value`]
                let per_reach = one / (half_reach + own.half_reach);
                let t = (x * x + y * y + z * z).sqrt() * per_reach;
                let left = (one - t).max(none);
                let square = left * left;
                let value = per_reach * per_reach * per_reach * square * square * (t * 4.0 + 1.0);
                let counted = mask64x4::from_bitmask(simd, close);
                sum += counted.select(volume * value, none);
            }
        }
        (sum[0] + sum[1] + sum[2] + sum[3]) * WENDLAND
    }
}
