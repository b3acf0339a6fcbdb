//! Sums over the points that are close to one, several of them at once: density, how it changes, and the force of that.
//!
//! A sum is the same to the bit whatever the instruction set: no operation is fused with another. What is common to the sums is
//! `inline(always)`, so that it is compiled with the instruction set that `dispatch!` selects.

use fearless_simd::{
    Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f64x4, mask64x4,
};
use glam::DVec3;

use super::hair::Site;
use super::kernel::{SLOPE, WENDLAND};
use crate::contact::sieve;

/// Points that are summed at once: half of those of a run.
const LANES: usize = 4;

/// Distance (m) below which two points count as that far apart, so that no quotient is infinite: far below what moves any force.
const SAME_PLACE: f64 = 1e-9;

/// The sites of all points, quantity by quantity; after the last point there are as many more as are summed at once.
#[derive(Clone)]
pub(super) struct SiteLanes {
    level: Level,
    /// Coordinates (m).
    positions: VectorLanes,
    /// [`Site::half_reach`] (m)
    half_reach: Vec<f64>,
    /// [`Site::volume`] (m³)
    volume: Vec<f64>,
}

/// A vector of each point, coordinate by coordinate.
#[derive(Clone)]
pub(super) struct VectorLanes {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
}

/// Points in a row, and which of them count: bit i is set for point i.
#[derive(Clone, Copy)]
pub(super) struct CloseRun {
    pub(super) first: u32,
    pub(super) close: u8,
}

/// A point that feels others, with what its neighbours feel of it.
pub(super) struct Pressed<'a> {
    pub(super) site: &'a Site,
    /// Displacement (m).
    pub(super) moved: DVec3,
    /// Derivative (J) of its energy by its density, and how the displacements of all points change it.
    pub(super) pressure: f64,
    pub(super) change: f64,
}

impl VectorLanes {
    /// Vectors in the order of points.
    pub(super) fn new(vectors: impl Iterator<Item = DVec3>, count: usize) -> Self {
        let list = || Vec::with_capacity(count + sieve::LANES);
        let mut lanes = Self { x: list(), y: list(), z: list() };
        let beyond = std::iter::repeat_n(DVec3::ZERO, sieve::LANES);
        for vector in vectors.chain(beyond) {
            lanes.x.push(vector.x);
            lanes.y.push(vector.y);
            lanes.z.push(vector.z);
        }
        lanes
    }

    /// How far those at four points are from a vector.
    #[inline(always)]
    fn from<S: Simd>(&self, simd: S, own: DVec3, at: usize) -> Away<S> {
        let lanes = at..at + LANES;
        Away {
            x: f64x4::splat(simd, own.x) - f64x4::from_slice(simd, &self.x[lanes.clone()]),
            y: f64x4::splat(simd, own.y) - f64x4::from_slice(simd, &self.y[lanes.clone()]),
            z: f64x4::splat(simd, own.z) - f64x4::from_slice(simd, &self.z[lanes]),
        }
    }
}

/// Four vectors.
#[derive(Clone, Copy)]
struct Away<S: Simd> {
    x: f64x4<S>,
    y: f64x4<S>,
    z: f64x4<S>,
}

impl<S: Simd> Away<S> {
    #[inline(always)]
    fn dot(self, other: Self) -> f64x4<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
}

/// Four kernels of a point.
struct Kernels<S: Simd> {
    away: Away<S>,
    /// r, 1/r and 1/R; r is at least [`SAME_PLACE`].
    distance: f64x4<S>,
    per_distance: f64x4<S>,
    per_reach: f64x4<S>,
    /// 1 − r/R, 0 beyond the reach.
    left: f64x4<S>,
}

#[inline(always)]
fn sum<S: Simd>(lanes: f64x4<S>) -> f64 {
    lanes[0] + lanes[1] + lanes[2] + lanes[3]
}

/// Calls `add` with the first point of each four of which some count, and which.
#[inline(always)]
fn for_each_four<S: Simd>(simd: S, runs: &[CloseRun], mut add: impl FnMut(usize, mask64x4<S>)) {
    for run in runs {
        for half in 0..sieve::LANES / LANES {
            let close = u64::from(run.close) >> (half * LANES) & 0b1111;
            if close != 0 {
                add(run.first as usize + half * LANES, mask64x4::from_bitmask(simd, close));
            }
        }
    }
}

impl SiteLanes {
    pub(super) fn new(sites: &[Site]) -> Self {
        let positions = VectorLanes::new(sites.iter().map(|site| site.position), sites.len());
        let beyond = std::iter::repeat_n(0.0, sieve::LANES);
        Self {
            level: Level::new(),
            positions,
            half_reach: sites.iter().map(|site| site.half_reach).chain(beyond.clone()).collect(),
            volume: sites.iter().map(|site| site.volume).chain(beyond).collect(),
        }
    }

    /// Moves a point to where its site is.
    pub(super) fn place_point(&mut self, k: usize, site: &Site) {
        let VectorLanes { x, y, z } = &mut self.positions;
        [x[k], y[k], z[k]] = site.position.to_array();
    }

    #[inline(always)]
    fn kernels<S: Simd>(&self, simd: S, own: &Site, at: usize) -> Kernels<S> {
        let away = self.positions.from(simd, own.position, at);
        let half_reach = f64x4::from_slice(simd, &self.half_reach[at..at + LANES]);
        let one = f64x4::splat(simd, 1.0);
        let reach = half_reach + own.half_reach;
        let distance = away.dot(away).sqrt().max(f64x4::splat(simd, SAME_PLACE));
        // One division for both.
        let quotient = one / (reach * distance);
        let (per_distance, per_reach) = (quotient * reach, quotient * distance);
        let left = (one - distance * per_reach).max(f64x4::splat(simd, 0.0));
        Kernels { away, distance, per_distance, per_reach, left }
    }

    #[inline(always)]
    fn volume<S: Simd>(&self, simd: S, at: usize) -> f64x4<S> {
        f64x4::from_slice(simd, &self.volume[at..at + LANES])
    }

    /// Fraction of space that the hair of the runs takes at a site: Σ V W. docs/theory.md (D1)
    pub(super) fn density(&self, own: &Site, runs: &[CloseRun]) -> f64 {
        dispatch!(self.level, simd => self.density_in(simd, own, runs))
    }

    #[inline(always)]
    fn density_in<S: Simd>(&self, simd: S, own: &Site, runs: &[CloseRun]) -> f64 {
        let none = f64x4::splat(simd, 0.0);
        let mut density = none;
        for_each_four(
            simd,
            runs,
            #[inline(always)]
            |at, counted| {
                let Kernels { distance, per_reach, left, .. } = self.kernels(simd, own, at);
                // [`super::kernel::Kernel::value`]
                let square = left * left;
                let cube = per_reach * per_reach * per_reach;
                let value = cube * square * square * (distance * per_reach * 4.0 + 1.0);
                density += counted.select(self.volume(simd, at) * value, none);
            },
        );
        sum(density) * WENDLAND
    }

    /// By how much displacements (m) of all points change the density at one: Σ V ∇W · (u − v).
    pub(super) fn density_change(
        &self,
        own: &Site,
        moved: (DVec3, &VectorLanes),
        runs: &[CloseRun],
    ) -> f64 {
        dispatch!(self.level, simd => self.density_change_in(simd, own, moved, runs))
    }

    #[inline(always)]
    fn density_change_in<S: Simd>(
        &self,
        simd: S,
        own: &Site,
        (moved, all): (DVec3, &VectorLanes),
        runs: &[CloseRun],
    ) -> f64 {
        let none = f64x4::splat(simd, 0.0);
        let mut change = none;
        for_each_four(
            simd,
            runs,
            #[inline(always)]
            |at, counted| {
                let Kernels { away, per_reach, left, .. } = self.kernels(simd, own, at);
                let apart = all.from(simd, moved, at);
                // W′/r of [`super::kernel::Kernel::derivatives`], but for its constant.
                let square = per_reach * per_reach;
                let slope = square * square * per_reach * left * left * left;
                let volume = self.volume(simd, at);
                change += counted.select(volume * slope * away.dot(apart), none);
            },
        );
        sum(change) * SLOPE
    }

    /// The change of force (N) at a point, of displacements of all points: of pairs that turn and come nearer under the pressure there is,
    /// and of the change of pressure. `pressures` and `changes` are those of all points, see [`Pressed`].
    pub(super) fn force(
        &self,
        own: &Pressed<'_>,
        moved: &VectorLanes,
        [pressures, changes]: [&[f64]; 2],
        runs: &[CloseRun],
    ) -> DVec3 {
        dispatch!(self.level, simd => self.force_in(simd, own, moved, [pressures, changes], runs))
    }

    #[inline(always)]
    fn force_in<S: Simd>(
        &self,
        simd: S,
        own: &Pressed<'_>,
        moved: &VectorLanes,
        [pressures, changes]: [&[f64]; 2],
        runs: &[CloseRun],
    ) -> DVec3 {
        let none = f64x4::splat(simd, 0.0);
        let (mut x, mut y, mut z) = (none, none, none);
        for_each_four(
            simd,
            runs,
            #[inline(always)]
            |at, counted| {
                let Kernels { away, per_distance, per_reach, left, .. } =
                    self.kernels(simd, own.site, at);
                let apart = moved.from(simd, own.moved, at);
                let volume = self.volume(simd, at);
                let theirs = f64x4::from_slice(simd, &pressures[at..at + LANES]);
                let change = f64x4::from_slice(simd, &changes[at..at + LANES]);
                // Each feels the volume of the other: E′_k V_l + E′_l V_k.
                let pressure = volume * own.pressure + theirs * own.site.volume;
                let change = volume * own.change + change * own.site.volume;
                // W′/r and (W″ − W′/r)/r² of [`super::kernel::Kernel::derivatives`], but for their constant.
                let square = per_reach * per_reach;
                let scale = counted.select(square * square * per_reach * left * left, none);
                let slope = scale * left;
                // Times away ∘ away, which vanishes at the same place.
                let bend = scale * per_reach * per_distance * -3.0;
                let along = bend * pressure * away.dot(apart) + slope * change;
                let across = slope * pressure;
                x += apart.x * across + away.x * along;
                y += apart.y * across + away.y * along;
                z += apart.z * across + away.z * along;
            },
        );
        DVec3::new(sum(x), sum(y), sum(z)) * SLOPE
    }
}
