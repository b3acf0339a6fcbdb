//! The number of the batch solver: one value per rod, in the lanes of a SIMD vector.
//!
//! All functions are `inline(always)`, so that they are compiled with the instruction set that `dispatch!` selects;
//! see `fearless_simd`'s notes on inlining.

use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask};

/// A floating-point number in a lane.
pub(super) trait Scalar: Copy + Send + Sync + 'static {
    fn from_f64(x: f64) -> Self;
    fn to_f64(self) -> f64;
    /// Relative error of an energy.
    const ENERGY_ROUNDING: f64;
    /// Terms of a series in 1/k! that are above rounding.
    const SERIES_TERMS: usize;
}

impl Scalar for f64 {
    // That of f64, 1.1e-16, times about a hundred for the sum over joints; 9.9¹³ 4!/30! is below it.
    const ENERGY_ROUNDING: f64 = 1e-14;
    const SERIES_TERMS: usize = 13;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
}

impl Scalar for f32 {
    // That of f32, 6e-8, times about twenty; 9.9⁸ 4!/20! is below it.
    const ENERGY_ROUNDING: f64 = 1e-6;
    const SERIES_TERMS: usize = 8;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as f32
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

/// One number per rod.
pub(super) trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// One truth value per rod.
    type Mask: Copy;

    /// How many rods.
    const LANES: usize;
    /// Relative error of an energy.
    const ENERGY_ROUNDING: f64;
    /// Terms that the series of [`super::rotation`] need.
    const SERIES_TERMS: usize;

    /// The same number for all rods.
    fn splat(self, x: f64) -> Self;
    /// `self × b + c`.
    fn mul_add(self, b: Self, c: Self) -> Self;
    fn sqrt(self) -> Self;
    fn lt(self, other: Self) -> Self::Mask;
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    fn any_true(mask: Self::Mask) -> bool;
    /// One truth value per bit.
    fn mask(self, bits: u64) -> Self::Mask;
    fn max(self, other: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn get(&self, lane: usize) -> f64;
    fn set(&mut self, lane: usize, x: f64);
}

/// A SIMD vector as [`Lanes`].
#[derive(Clone, Copy)]
pub(super) struct SimdLanes<S, V> {
    token: S,
    v: V,
}

type Element<S, V> = <V as SimdBase<S>>::Element;

impl<S: Simd, V: SimdFloat<S>> SimdLanes<S, V> {
    #[inline(always)]
    pub(super) fn new(token: S, v: V) -> Self {
        Self { token, v }
    }

    #[inline(always)]
    fn with(self, v: V) -> Self {
        Self { v, ..self }
    }
}

impl<S: Simd, V: SimdFloat<S>> Add for SimdLanes<S, V> {
    type Output = Self;

    #[inline(always)]
    fn add(self, o: Self) -> Self {
        self.with(self.v + o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Sub for SimdLanes<S, V> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self.with(self.v - o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Mul for SimdLanes<S, V> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        self.with(self.v * o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Div for SimdLanes<S, V> {
    type Output = Self;

    #[inline(always)]
    fn div(self, o: Self) -> Self {
        self.with(self.v / o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Neg for SimdLanes<S, V> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(-self.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Lanes for SimdLanes<S, V>
where
    Element<S, V>: Scalar,
{
    type Mask = V::Mask;

    const LANES: usize = V::LEN;
    const ENERGY_ROUNDING: f64 = Element::<S, V>::ENERGY_ROUNDING;
    const SERIES_TERMS: usize = Element::<S, V>::SERIES_TERMS;

    #[inline(always)]
    fn splat(self, x: f64) -> Self {
        self.with(V::simd_from(self.token, Element::<S, V>::from_f64(x)))
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self.with(self.v.mul_add(b.v, c.v))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.v.sqrt())
    }

    #[inline(always)]
    fn lt(self, other: Self) -> V::Mask {
        self.v.simd_lt(other.v)
    }

    #[inline(always)]
    fn select(mask: V::Mask, yes: Self, no: Self) -> Self {
        yes.with(mask.select(yes.v, no.v))
    }

    #[inline(always)]
    fn any_true(mask: V::Mask) -> bool {
        mask.any_true()
    }

    #[inline(always)]
    fn mask(self, bits: u64) -> V::Mask {
        V::Mask::from_bitmask(self.token, bits)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(self.v.max(other.v))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.with(self.v.min(other.v))
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> f64 {
        self.v[lane].to_f64()
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, x: f64) {
        self.v[lane] = Element::<S, V>::from_f64(x);
    }
}
