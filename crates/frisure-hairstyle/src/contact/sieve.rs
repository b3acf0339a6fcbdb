//! A first look, in single precision, at which points are close enough to touch.
//!
//! Most of what may touch does not: of the lists that [`super::neighbours`] keeps while guides move, one point in twelve touches.

use std::ops::Range;

use fearless_simd::{Level, Simd, SimdBase, SimdMask, dispatch, f32x8};
use glam::DVec3;

/// Points of a run at most: as many as are compared at once.
pub(super) const LANES: usize = 8;

/// Runs that are looked at before what was found in them is used. Chosen; no result depends on it.
const RUNS: usize = 32;

/// Points `first` to `end − 1` of a guide, at most [`LANES`] of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) guide: u32,
    pub(super) first: u32,
    pub(super) end: u32,
}

impl Run {
    /// A range of points of a guide in runs.
    pub(super) fn of_guide(guide: u32, points: Range<usize>) -> impl Iterator<Item = Self> {
        let end = points.end as u32;
        let firsts = points.step_by(LANES).map(|first| first as u32);
        firsts.map(move |first| Self { guide, first, end: end.min(first + LANES as u32) })
    }
}

/// What rounding to single precision may add to a distance, in its coordinates and in itself. A step of single precision is 6e-8; a
/// difference of two coordinates has three such errors, in space √3 times as much.
const ROUNDING: f64 = 1e-6;

/// The points of all guides, coordinate by coordinate, so that a processor compares several at once.
pub(super) struct Sieve {
    level: Level,
    /// Where the points of each guide begin.
    starts: Vec<u32>,
    /// Coordinates (m); after the last point there are as many more as are compared at once.
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    /// Radii (m), larger by what rounding may take.
    reach: Vec<f32>,
}

/// A point that is compared with others.
#[derive(Clone, Copy)]
pub(super) struct SievePoint {
    place: [f32; 3],
    reach: f32,
}

impl Sieve {
    /// Positions and radii (m) of the points of each guide.
    pub(super) fn new<'a>(guides: impl Iterator<Item = (&'a [DVec3], &'a [f64])> + Clone) -> Self {
        let mut starts = Vec::new();
        let mut count = 0;
        for (positions, _) in guides.clone() {
            starts.push(count as u32);
            count += positions.len();
        }
        let zero = || vec![0.0; count + LANES];
        let (level, [x, y, z, reach]) = (Level::new(), [zero(), zero(), zero(), zero()]);
        let mut sieve = Self { level, starts, x, y, z, reach };
        for (guide, (positions, radii)) in guides.enumerate() {
            sieve.place(guide, positions, radii);
        }
        sieve
    }

    /// Moves the points of a guide.
    pub(super) fn place(&mut self, guide: usize, positions: &[DVec3], radii: &[f64]) {
        let first = self.starts[guide] as usize;
        for (k, (&p, &radius)) in positions.iter().zip(radii).enumerate() {
            self.place_point(first + k, p, radius);
        }
    }

    /// Moves the point `at`, counted over all guides.
    pub(super) fn place_point(&mut self, at: usize, p: DVec3, radius: f64) {
        let SievePoint { place, reach } = SievePoint::new(p, radius);
        [self.x[at], self.y[at], self.z[at]] = place;
        self.reach[at] = reach;
    }

    /// Calls `found` with the index of each point of the runs that is nearer to `own` than the radii of both, and of some that hardly are
    /// not, in their order.
    #[inline]
    pub(super) fn for_each_close(
        &self,
        own: SievePoint,
        runs: &[Run],
        mut found: impl FnMut(&Run, usize),
    ) {
        self.for_each_close_run(own, runs, |run, close| {
            let mut left = close;
            while left != 0 {
                found(run, run.first as usize + left.trailing_zeros() as usize);
                left &= left - 1;
            }
        });
    }

    /// Calls `found` with the runs that have points as close, in their order, and which points of a run these are: bit i is set for its
    /// point i.
    #[inline]
    pub(super) fn for_each_close_run(
        &self,
        own: SievePoint,
        runs: &[Run],
        mut found: impl FnMut(&Run, u8),
    ) {
        for runs in runs.chunks(RUNS) {
            for (run, close) in runs.iter().zip(self.close(own, runs)) {
                if close != 0 {
                    found(run, close);
                }
            }
        }
    }

    /// For each of at most [`RUNS`] runs: bit i is set if its point i is nearer to `own` than the radii of both, or hardly farther.
    fn close(&self, own: SievePoint, runs: &[Run]) -> [u8; RUNS] {
        let mut close = [0; RUNS];
        dispatch!(self.level, simd => self.compare(simd, own, runs, &mut close));
        close
    }

    /// [`Self::close`] with the instruction set that `dispatch!` selects; `inline(always)` is what makes it so.
    #[inline(always)]
    fn compare<S: Simd>(&self, simd: S, own: SievePoint, runs: &[Run], close: &mut [u8; RUNS]) {
        let [x, y, z] = own.place.map(|c| f32x8::splat(simd, c));
        let own_reach = f32x8::splat(simd, own.reach);
        for (run, close) in runs.iter().zip(close) {
            let from = (self.starts[run.guide as usize] + run.first) as usize;
            let lanes = from..from + LANES;
            let x = x - f32x8::from_slice(simd, &self.x[lanes.clone()]);
            let y = y - f32x8::from_slice(simd, &self.y[lanes.clone()]);
            let z = z - f32x8::from_slice(simd, &self.z[lanes.clone()]);
            let reach = own_reach + f32x8::from_slice(simd, &self.reach[lanes]);
            let near = (x * x + y * y + z * z).simd_le(reach * reach);
            // Those beyond the end of the run do not count.
            *close = near.to_bitmask() as u8 & (0xff >> (LANES as u32 - (run.end - run.first)));
        }
    }
}

impl SievePoint {
    /// A point of this position and radius (m).
    #[inline]
    pub(super) fn new(p: DVec3, radius: f64) -> Self {
        let reach = radius * (1.0 + ROUNDING) + p.abs().max_element() * ROUNDING;
        Self { place: p.as_vec3().to_array(), reach: reach as f32 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which of points `first` to `first + count − 1` of guide 1 are close.
    fn close(sieve: &Sieve, own: SievePoint, first: u32, count: u32) -> u8 {
        sieve.close(own, &[Run { guide: 1, first, end: first + count }])[0]
    }

    #[test]
    fn what_touches_is_close_and_little_else() {
        let at = |i: u32| {
            let a = f64::from(i);
            DVec3::new((1.3 * a).sin(), (0.7 * a).cos(), (2.1 * a).sin()) * 0.01 + DVec3::Z * 0.8
        };
        let positions: Vec<DVec3> = (0..200).map(at).collect();
        let radii: Vec<f64> = (0..200).map(|i| 1e-3 + 1e-5 * f64::from(i)).collect();
        let guides = [(&positions[..3], &radii[..3]), (&positions[..], &radii[..])];
        let sieve = Sieve::new(guides.into_iter());
        let touches = |k: usize, l: usize, slack: f64| {
            positions[k].distance(positions[l]) < radii[k] + radii[l] + slack
        };
        let mut count = 0;
        for (k, l) in (0..200).flat_map(|k| (0..200).map(move |l| (k, l))) {
            let found = close(&sieve, SievePoint::new(positions[k], radii[k]), l as u32, 1) == 1;
            assert!(found || !touches(k, l, 0.0), "{k} {l}");
            assert!(!found || touches(k, l, 1e-5), "{k} {l}");
            count += usize::from(found);
        }
        assert!((1000..20_000).contains(&count), "{count}");
        // Eight at once, and some of them, are the same as one after the other.
        let own = SievePoint::new(positions[7], radii[7]);
        let each: u8 = (0..8).map(|i| close(&sieve, own, 30 + i, 1) << i).sum();
        assert_eq!(close(&sieve, own, 30, 8), each);
        assert_eq!(close(&sieve, own, 30, 5), each & 0b11111);
        // Two that just touch, and the last point of all.
        let beside = positions[3] + DVec3::X * (2.0 * radii[3]);
        assert_eq!(close(&sieve, SievePoint::new(beside, radii[3]), 3, 1), 1);
        assert_eq!(close(&sieve, SievePoint::new(positions[199], 1e-9), 199, 1), 1);
    }
}
