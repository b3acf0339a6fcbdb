//! Eight numbers at once: the few operations that tracing needs, portable and with AVX2.

/// How many numbers are computed with at once.
pub(super) const LANES: usize = 8;

/// Eight numbers in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(super) struct Lanes(pub(super) [f32; LANES]);

/// Arithmetic on eight numbers. A value of an implementing type is the leave to use its instructions.
///
/// Minimum and maximum give `b` where a number is not one; comparisons are then false.
pub(super) trait Simd: Copy {
    /// Eight numbers in a register.
    type F: Copy;
    /// Eight truths.
    type M: Copy;

    fn splat(self, x: f32) -> Self::F;
    fn load(self, x: &Lanes) -> Self::F;
    fn load_u16(self, x: &[u16; LANES]) -> Self::F;
    fn load_i16(self, x: &[i16; LANES]) -> Self::F;
    fn store(self, x: Self::F) -> Lanes;
    fn add(self, a: Self::F, b: Self::F) -> Self::F;
    fn sub(self, a: Self::F, b: Self::F) -> Self::F;
    fn mul(self, a: Self::F, b: Self::F) -> Self::F;
    fn div(self, a: Self::F, b: Self::F) -> Self::F;
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    fn sqrt(self, a: Self::F) -> Self::F;
    /// `a b + c`, rounded once or twice.
    fn mul_add(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    /// `c − a b`, rounded once or twice.
    fn sub_mul(self, c: Self::F, a: Self::F, b: Self::F) -> Self::F;
    fn less(self, a: Self::F, b: Self::F) -> Self::M;
    fn at_most(self, a: Self::F, b: Self::F) -> Self::M;
    fn both(self, a: Self::M, b: Self::M) -> Self::M;
    /// Bit `i` is truth `i`.
    fn bits(self, m: Self::M) -> u32;
}

/// Plain Rust, for every machine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable;

#[inline(always)]
fn each(f: impl Fn(usize) -> f32) -> Lanes {
    Lanes(std::array::from_fn(f))
}

#[inline(always)]
fn truths(f: impl Fn(usize) -> bool) -> u32 {
    (0..LANES).fold(0, |bits, i| bits | u32::from(f(i)) << i)
}

impl Simd for Portable {
    type F = Lanes;
    type M = u32;

    #[inline(always)]
    fn splat(self, x: f32) -> Lanes {
        Lanes([x; LANES])
    }
    #[inline(always)]
    fn load(self, x: &Lanes) -> Lanes {
        *x
    }
    #[inline(always)]
    fn load_u16(self, x: &[u16; LANES]) -> Lanes {
        each(|i| f32::from(x[i]))
    }
    #[inline(always)]
    fn load_i16(self, x: &[i16; LANES]) -> Lanes {
        each(|i| f32::from(x[i]))
    }
    #[inline(always)]
    fn store(self, x: Lanes) -> Lanes {
        x
    }
    #[inline(always)]
    fn add(self, a: Lanes, b: Lanes) -> Lanes {
        each(|i| a.0[i] + b.0[i])
    }
    #[inline(always)]
    fn sub(self, a: Lanes, b: Lanes) -> Lanes {
        each(|i| a.0[i] - b.0[i])
    }
    #[inline(always)]
    fn mul(self, a: Lanes, b: Lanes) -> Lanes {
        each(|i| a.0[i] * b.0[i])
    }
    #[inline(always)]
    fn div(self, a: Lanes, b: Lanes) -> Lanes {
        each(|i| a.0[i] / b.0[i])
    }
    #[inline(always)]
    fn min(self, a: Lanes, b: Lanes) -> Lanes {
        each(|i| if a.0[i] < b.0[i] { a.0[i] } else { b.0[i] })
    }
    #[inline(always)]
    fn max(self, a: Lanes, b: Lanes) -> Lanes {
        each(|i| if a.0[i] > b.0[i] { a.0[i] } else { b.0[i] })
    }
    #[inline(always)]
    fn sqrt(self, a: Lanes) -> Lanes {
        each(|i| a.0[i].sqrt())
    }
    // Not `f32::mul_add`: without the instruction that is a slow function.
    #[inline(always)]
    fn mul_add(self, a: Lanes, b: Lanes, c: Lanes) -> Lanes {
        each(|i| a.0[i] * b.0[i] + c.0[i])
    }
    #[inline(always)]
    fn sub_mul(self, c: Lanes, a: Lanes, b: Lanes) -> Lanes {
        each(|i| c.0[i] - a.0[i] * b.0[i])
    }
    #[inline(always)]
    fn less(self, a: Lanes, b: Lanes) -> u32 {
        truths(|i| a.0[i] < b.0[i])
    }
    #[inline(always)]
    fn at_most(self, a: Lanes, b: Lanes) -> u32 {
        truths(|i| a.0[i] <= b.0[i])
    }
    #[inline(always)]
    fn both(self, a: u32, b: u32) -> u32 {
        a & b
    }
    #[inline(always)]
    fn bits(self, m: u32) -> u32 {
        m
    }
}

#[cfg(target_arch = "x86_64")]
pub(super) use avx2::Avx2;

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::*;

    use super::{Lanes, Simd};

    /// Proof that this machine has AVX2 and FMA: [`Avx2::detect`] is the only way to one.
    #[derive(Clone, Copy, Debug)]
    pub(in super::super) struct Avx2(());

    impl Avx2 {
        pub(in super::super) fn detect() -> Option<Self> {
            (is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"))
                .then_some(Self(()))
        }
    }

    /// An instruction of AVX2 or FMA that has no precondition but that the machine knows it.
    macro_rules! instruction {
        ($call:expr) => {
            // SAFETY: `self` exists, so the machine has AVX2 and FMA (see `Avx2`), which is all that
            // arithmetic in registers asks for.
            unsafe { $call }
        };
    }

    impl Simd for Avx2 {
        type F = __m256;
        type M = __m256;

        #[inline(always)]
        fn splat(self, x: f32) -> __m256 {
            instruction!(_mm256_set1_ps(x))
        }
        #[inline(always)]
        fn load(self, x: &Lanes) -> __m256 {
            // SAFETY: as above; and `Lanes` is eight floats (repr(C)) aligned to 32 bytes.
            unsafe { _mm256_load_ps(x.0.as_ptr()) }
        }
        #[inline(always)]
        fn load_u16(self, x: &[u16; 8]) -> __m256 {
            // SAFETY: as above; the load asks for no alignment, and eight halves are sixteen bytes.
            unsafe {
                let halves = _mm_loadu_si128(x.as_ptr().cast());
                _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(halves))
            }
        }
        #[inline(always)]
        fn load_i16(self, x: &[i16; 8]) -> __m256 {
            // SAFETY: as above; the load asks for no alignment, and eight halves are sixteen bytes.
            unsafe {
                let halves = _mm_loadu_si128(x.as_ptr().cast());
                _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(halves))
            }
        }
        #[inline(always)]
        fn store(self, x: __m256) -> Lanes {
            let mut lanes = Lanes([0.0; 8]);
            // SAFETY: as above; and `Lanes` is eight floats (repr(C)) aligned to 32 bytes.
            unsafe { _mm256_store_ps(lanes.0.as_mut_ptr(), x) };
            lanes
        }
        #[inline(always)]
        fn add(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_add_ps(a, b))
        }
        #[inline(always)]
        fn sub(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_sub_ps(a, b))
        }
        #[inline(always)]
        fn mul(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_mul_ps(a, b))
        }
        #[inline(always)]
        fn div(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_div_ps(a, b))
        }
        #[inline(always)]
        fn min(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_min_ps(a, b))
        }
        #[inline(always)]
        fn max(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_max_ps(a, b))
        }
        #[inline(always)]
        fn sqrt(self, a: __m256) -> __m256 {
            instruction!(_mm256_sqrt_ps(a))
        }
        #[inline(always)]
        fn mul_add(self, a: __m256, b: __m256, c: __m256) -> __m256 {
            instruction!(_mm256_fmadd_ps(a, b, c))
        }
        #[inline(always)]
        fn sub_mul(self, c: __m256, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_fnmadd_ps(a, b, c))
        }
        #[inline(always)]
        fn less(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b))
        }
        #[inline(always)]
        fn at_most(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b))
        }
        #[inline(always)]
        fn both(self, a: __m256, b: __m256) -> __m256 {
            instruction!(_mm256_and_ps(a, b))
        }
        #[inline(always)]
        fn bits(self, m: __m256) -> u32 {
            instruction!(_mm256_movemask_ps(m)).cast_unsigned()
        }
    }
}

/// Three coordinates of eight points.
#[derive(Clone, Copy)]
pub(super) struct Wide3<F> {
    pub(super) x: F,
    pub(super) y: F,
    pub(super) z: F,
}

/// Vectors of eight lanes.
pub(super) trait Vectors: Simd {
    #[inline(always)]
    fn load3(self, [x, y, z]: &[Lanes; 3]) -> Wide3<Self::F> {
        Wide3 { x: self.load(x), y: self.load(y), z: self.load(z) }
    }
    #[inline(always)]
    fn splat3(self, v: glam::Vec3) -> Wide3<Self::F> {
        Wide3 { x: self.splat(v.x), y: self.splat(v.y), z: self.splat(v.z) }
    }
    #[inline(always)]
    fn wide3(self, [x, y, z]: [Self::F; 3]) -> Wide3<Self::F> {
        Wide3 { x, y, z }
    }
    /// Coordinate by coordinate.
    #[inline(always)]
    fn scale3(self, a: Wide3<Self::F>, b: Wide3<Self::F>) -> Wide3<Self::F> {
        Wide3 { x: self.mul(a.x, b.x), y: self.mul(a.y, b.y), z: self.mul(a.z, b.z) }
    }
    /// `p − a b`, coordinate by coordinate.
    #[inline(always)]
    fn against3(self, p: Wide3<Self::F>, a: Wide3<Self::F>, b: Wide3<Self::F>) -> Wide3<Self::F> {
        Wide3 {
            x: self.sub_mul(p.x, a.x, b.x),
            y: self.sub_mul(p.y, a.y, b.y),
            z: self.sub_mul(p.z, a.z, b.z),
        }
    }
    #[inline(always)]
    fn sub3(self, a: Wide3<Self::F>, b: Wide3<Self::F>) -> Wide3<Self::F> {
        Wide3 { x: self.sub(a.x, b.x), y: self.sub(a.y, b.y), z: self.sub(a.z, b.z) }
    }
    /// `p + t d`
    #[inline(always)]
    fn along(self, p: Wide3<Self::F>, t: Self::F, d: Wide3<Self::F>) -> Wide3<Self::F> {
        Wide3 {
            x: self.mul_add(t, d.x, p.x),
            y: self.mul_add(t, d.y, p.y),
            z: self.mul_add(t, d.z, p.z),
        }
    }
    /// `p − t d`
    #[inline(always)]
    fn against(self, p: Wide3<Self::F>, t: Self::F, d: Wide3<Self::F>) -> Wide3<Self::F> {
        Wide3 {
            x: self.sub_mul(p.x, t, d.x),
            y: self.sub_mul(p.y, t, d.y),
            z: self.sub_mul(p.z, t, d.z),
        }
    }
    #[inline(always)]
    fn dot(self, a: Wide3<Self::F>, b: Wide3<Self::F>) -> Self::F {
        self.mul_add(a.x, b.x, self.mul_add(a.y, b.y, self.mul(a.z, b.z)))
    }
    #[inline(always)]
    fn cross(self, a: Wide3<Self::F>, b: Wide3<Self::F>) -> Wide3<Self::F> {
        Wide3 {
            x: self.sub_mul(self.mul(a.y, b.z), a.z, b.y),
            y: self.sub_mul(self.mul(a.z, b.x), a.x, b.z),
            z: self.sub_mul(self.mul(a.x, b.y), a.y, b.x),
        }
    }
}

impl<S: Simd> Vectors for S {}
