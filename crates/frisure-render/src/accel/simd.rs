//! Eight numbers at once: vectors of `fearless_simd`, and three coordinates of eight points.
//!
//! All functions are `inline(always)`, so that they are compiled with the instruction set that `dispatch!` selects; see
//! `fearless_simd`'s notes on inlining. Minimum and maximum give the second number where one is not a number;
//! comparisons are then false.

use std::ops::{Mul, Sub};

use fearless_simd::{
    Bytes, Simd, SimdBase, SimdCombine, SimdFloat, SimdInt, SimdMask, SimdWiden, f32x8, i16x8,
    i32x8, mask32x8, u16x8,
};
use glam::Vec3;

/// How many numbers are computed with at once.
pub(super) const LANES: usize = 8;

/// Eight numbers in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(super) struct Lanes(pub(super) [f32; LANES]);

impl Lanes {
    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S) -> f32x8<S> {
        f32x8::load_array_ref(simd, &self.0)
    }
}

/// Integers without a sign as floating-point numbers.
#[inline(always)]
pub(super) fn from_u16<S: Simd>(simd: S, x: &[u16; LANES]) -> f32x8<S> {
    let (low, high) = u16x8::load_array_ref(simd, x).widen();
    low.combine(high).bitcast::<i32x8<S>>().to_float()
}

/// Integers with a sign as floating-point numbers.
#[inline(always)]
pub(super) fn from_i16<S: Simd>(simd: S, x: &[i16; LANES]) -> f32x8<S> {
    let (low, high) = i16x8::load_array_ref(simd, x).widen();
    low.combine(high).to_float()
}

/// `c − a b`, rounded once or twice.
#[inline(always)]
pub(super) fn sub_mul<S: Simd>(c: f32x8<S>, a: f32x8<S>, b: f32x8<S>) -> f32x8<S> {
    (-a).mul_add(b, c)
}

/// Bit `i` is truth `i`.
#[inline(always)]
pub(super) fn bits<S: Simd>(mask: mask32x8<S>) -> u32 {
    mask.to_bitmask() as u32
}

/// Three coordinates of eight points.
#[derive(Clone, Copy)]
pub(super) struct Wide3<S: Simd> {
    pub(super) x: f32x8<S>,
    pub(super) y: f32x8<S>,
    pub(super) z: f32x8<S>,
}

impl<S: Simd> Wide3<S> {
    #[inline(always)]
    pub(super) fn splat(simd: S, v: Vec3) -> Self {
        Self { x: f32x8::splat(simd, v.x), y: f32x8::splat(simd, v.y), z: f32x8::splat(simd, v.z) }
    }

    #[inline(always)]
    pub(super) fn load(simd: S, [x, y, z]: &[Lanes; 3]) -> Self {
        Self { x: x.load(simd), y: y.load(simd), z: z.load(simd) }
    }

    #[inline(always)]
    pub(super) fn from_u16(simd: S, [x, y, z]: &[[u16; LANES]; 3]) -> Self {
        Self { x: from_u16(simd, x), y: from_u16(simd, y), z: from_u16(simd, z) }
    }

    #[inline(always)]
    pub(super) fn from_i16(simd: S, [x, y, z]: &[[i16; LANES]; 3]) -> Self {
        Self { x: from_i16(simd, x), y: from_i16(simd, y), z: from_i16(simd, z) }
    }

    /// `self + t d`
    #[inline(always)]
    pub(super) fn along(self, t: f32x8<S>, d: Self) -> Self {
        Self { x: t.mul_add(d.x, self.x), y: t.mul_add(d.y, self.y), z: t.mul_add(d.z, self.z) }
    }

    /// `self − a b`, coordinate by coordinate.
    #[inline(always)]
    pub(super) fn sub_mul(self, a: Self, b: Self) -> Self {
        Self {
            x: sub_mul(self.x, a.x, b.x),
            y: sub_mul(self.y, a.y, b.y),
            z: sub_mul(self.z, a.z, b.z),
        }
    }

    /// `self − t d`
    #[inline(always)]
    pub(super) fn against(self, t: f32x8<S>, d: Self) -> Self {
        self.sub_mul(Self { x: t, y: t, z: t }, d)
    }

    #[inline(always)]
    pub(super) fn dot(self, b: Self) -> f32x8<S> {
        self.x.mul_add(b.x, self.y.mul_add(b.y, self.z * b.z))
    }

    #[inline(always)]
    pub(super) fn cross(self, b: Self) -> Self {
        Self {
            x: sub_mul(self.y * b.z, self.z, b.y),
            y: sub_mul(self.z * b.x, self.x, b.z),
            z: sub_mul(self.x * b.y, self.y, b.x),
        }
    }
}

impl<S: Simd> Sub for Wide3<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self { x: self.x - b.x, y: self.y - b.y, z: self.z - b.z }
    }
}

impl<S: Simd> Mul<f32> for Wide3<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f32) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
