//! Numbers side by side, one per hair, and their vectors and matrices.
//!
//! All functions are inlined into the one that knows the processor's instructions; see
//! `fearless_simd`'s notes on inlining.

use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask};

/// A number as processors have it.
pub(super) trait Scalar: Copy + Send + Sync + 'static {
    fn of(x: f64) -> Self;
    fn wide(self) -> f64;
    /// Relative error of an energy.
    const NOISE: f64;
    /// Terms of a series of 1/k! that count.
    const TERMS: usize;
}

impl Scalar for f64 {
    const NOISE: f64 = 1e-14;
    const TERMS: usize = 13;

    #[inline(always)]
    fn of(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn wide(self) -> f64 {
        self
    }
}

impl Scalar for f32 {
    const NOISE: f64 = 1e-6;
    const TERMS: usize = 8;

    #[inline(always)]
    fn of(x: f64) -> Self {
        x as f32
    }

    #[inline(always)]
    fn wide(self) -> f64 {
        f64::from(self)
    }
}

/// One number per hair.
pub(super) trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// One truth per hair.
    type Truth: Copy;

    /// How many hairs.
    const COUNT: usize;
    /// Relative error of an energy.
    const NOISE: f64;
    /// Terms that the series of [`super::turn`] need.
    const TERMS: usize;

    /// The same number for all.
    fn all(self, x: f64) -> Self;
    /// `self × b + c`.
    fn times_plus(self, b: Self, c: Self) -> Self;
    fn root(self) -> Self;
    fn less(self, other: Self) -> Self::Truth;
    fn choose(truth: Self::Truth, yes: Self, no: Self) -> Self;
    fn any(truth: Self::Truth) -> bool;
    /// One truth per bit.
    fn truth(self, bits: u64) -> Self::Truth;
    fn largest(self, other: Self) -> Self;
    fn smallest(self, other: Self) -> Self;
    fn get(&self, lane: usize) -> f64;
    fn set(&mut self, lane: usize, x: f64);
}

/// A vector of the processor's as [`Lanes`].
#[derive(Clone, Copy)]
pub(super) struct Wide<S, V> {
    token: S,
    v: V,
}

type Element<S, V> = <V as SimdBase<S>>::Element;

impl<S: Simd, V: SimdFloat<S>> Wide<S, V> {
    #[inline(always)]
    pub(super) fn new(token: S, v: V) -> Self {
        Self { token, v }
    }

    #[inline(always)]
    fn with(self, v: V) -> Self {
        Self { v, ..self }
    }
}

impl<S: Simd, V: SimdFloat<S>> Add for Wide<S, V> {
    type Output = Self;

    #[inline(always)]
    fn add(self, o: Self) -> Self {
        self.with(self.v + o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Sub for Wide<S, V> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self.with(self.v - o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Mul for Wide<S, V> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        self.with(self.v * o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Div for Wide<S, V> {
    type Output = Self;

    #[inline(always)]
    fn div(self, o: Self) -> Self {
        self.with(self.v / o.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Neg for Wide<S, V> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(-self.v)
    }
}

impl<S: Simd, V: SimdFloat<S>> Lanes for Wide<S, V>
where
    Element<S, V>: Scalar,
{
    type Truth = V::Mask;

    const COUNT: usize = V::LEN;
    const NOISE: f64 = Element::<S, V>::NOISE;
    const TERMS: usize = Element::<S, V>::TERMS;

    #[inline(always)]
    fn all(self, x: f64) -> Self {
        self.with(V::simd_from(self.token, Element::<S, V>::of(x)))
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        self.with(self.v.mul_add(b.v, c.v))
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.with(self.v.sqrt())
    }

    #[inline(always)]
    fn less(self, other: Self) -> V::Mask {
        self.v.simd_lt(other.v)
    }

    #[inline(always)]
    fn choose(truth: V::Mask, yes: Self, no: Self) -> Self {
        yes.with(truth.select(yes.v, no.v))
    }

    #[inline(always)]
    fn any(truth: V::Mask) -> bool {
        truth.any_true()
    }

    #[inline(always)]
    fn truth(self, bits: u64) -> V::Mask {
        V::Mask::from_bitmask(self.token, bits)
    }

    #[inline(always)]
    fn largest(self, other: Self) -> Self {
        self.with(self.v.max(other.v))
    }

    #[inline(always)]
    fn smallest(self, other: Self) -> Self {
        self.with(self.v.min(other.v))
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> f64 {
        self.v[lane].wide()
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, x: f64) {
        self.v[lane] = Element::<S, V>::of(x);
    }
}

/// A vector per hair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vec3<F> {
    pub(super) x: F,
    pub(super) y: F,
    pub(super) z: F,
}

/// A matrix per hair, by columns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mat3<F> {
    pub(super) x: Vec3<F>,
    pub(super) y: Vec3<F>,
    pub(super) z: Vec3<F>,
}

/// A symmetric matrix per hair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sym3<F> {
    pub(super) xx: F,
    pub(super) xy: F,
    pub(super) xz: F,
    pub(super) yy: F,
    pub(super) yz: F,
    pub(super) zz: F,
}

impl<F: Lanes> Vec3<F> {
    #[inline(always)]
    pub(super) fn new(x: F, y: F, z: F) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub(super) fn all(x: F) -> Self {
        Self { x, y: x, z: x }
    }

    #[inline(always)]
    pub(super) fn plus(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }

    #[inline(always)]
    pub(super) fn minus(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }

    /// Component by component.
    #[inline(always)]
    pub(super) fn each(self, o: Self) -> Self {
        Self::new(self.x * o.x, self.y * o.y, self.z * o.z)
    }

    #[inline(always)]
    pub(super) fn scaled(self, k: F) -> Self {
        Self::new(self.x * k, self.y * k, self.z * k)
    }

    /// `self × k + o`.
    #[inline(always)]
    pub(super) fn scaled_plus(self, k: F, o: Self) -> Self {
        Self::new(self.x.times_plus(k, o.x), self.y.times_plus(k, o.y), self.z.times_plus(k, o.z))
    }

    #[inline(always)]
    pub(super) fn dot(self, o: Self) -> F {
        self.x.times_plus(o.x, self.y.times_plus(o.y, self.z * o.z))
    }

    #[inline(always)]
    pub(super) fn cross(self, o: Self) -> Self {
        Self::new(
            self.y.times_plus(o.z, -(self.z * o.y)),
            self.z.times_plus(o.x, -(self.x * o.z)),
            self.x.times_plus(o.y, -(self.y * o.x)),
        )
    }

    #[inline(always)]
    pub(super) fn choose(truth: F::Truth, yes: Self, no: Self) -> Self {
        Self::new(
            F::choose(truth, yes.x, no.x),
            F::choose(truth, yes.y, no.y),
            F::choose(truth, yes.z, no.z),
        )
    }

    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, v: glam::DVec3) {
        self.x.set(lane, v.x);
        self.y.set(lane, v.y);
        self.z.set(lane, v.z);
    }

    #[inline(always)]
    pub(super) fn get(&self, lane: usize) -> glam::DVec3 {
        glam::DVec3::new(self.x.get(lane), self.y.get(lane), self.z.get(lane))
    }
}

impl<F: Lanes> Mat3<F> {
    #[inline(always)]
    pub(super) fn all(x: F) -> Self {
        let x = Vec3::all(x);
        Self { x, y: x, z: x }
    }

    #[inline(always)]
    pub(super) fn times(self, v: Vec3<F>) -> Vec3<F> {
        self.x.scaled_plus(v.x, self.y.scaled_plus(v.y, self.z.scaled(v.z)))
    }

    /// The transpose times a vector.
    #[inline(always)]
    pub(super) fn transposed_times(self, v: Vec3<F>) -> Vec3<F> {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }

    /// Of a matrix whose rows are the columns of `o`, this one times it, likewise by rows.
    #[inline(always)]
    pub(super) fn rows_of(self, o: Self) -> Self {
        let row = |x: F, y: F, z: F| o.x.scaled_plus(x, o.y.scaled_plus(y, o.z.scaled(z)));
        Self {
            x: row(self.x.x, self.y.x, self.z.x),
            y: row(self.x.y, self.y.y, self.z.y),
            z: row(self.x.z, self.y.z, self.z.z),
        }
    }

    /// The turn from this frame to another, as a vector in it: `2 sin(θ/2)` along the axis, which is smooth up
    /// to half a turn.
    #[inline(always)]
    pub(super) fn deviation(self, to: Self) -> Vec3<F> {
        let (x, y, z) =
            (self.transposed_times(to.x), self.transposed_times(to.y), self.transposed_times(to.z));
        let skew = Vec3::new(y.z - z.y, z.x - x.z, x.y - y.x);
        let one = x.x.all(1.0);
        let trace = one + x.x + y.y + z.z;
        skew.scaled(one / trace.largest(one.all(0.04)).root())
    }

    #[inline(always)]
    pub(super) fn choose(truth: F::Truth, yes: Self, no: Self) -> Self {
        Self {
            x: Vec3::choose(truth, yes.x, no.x),
            y: Vec3::choose(truth, yes.y, no.y),
            z: Vec3::choose(truth, yes.z, no.z),
        }
    }

    #[inline(always)]
    pub(super) fn product(self, o: Self) -> Self {
        Self { x: self.times(o.x), y: self.times(o.y), z: self.times(o.z) }
    }

    /// `M S Mᵀ`.
    #[inline(always)]
    pub(super) fn turned(self, s: Sym3<F>) -> Sym3<F> {
        let row = |x: F, y: F, z: F| Vec3::new(x, y, z);
        let (a, b, c) = (
            row(self.x.x, self.y.x, self.z.x),
            row(self.x.y, self.y.y, self.z.y),
            row(self.x.z, self.y.z, self.z.z),
        );
        let (sa, sb, sc) = (s.times(a), s.times(b), s.times(c));
        Sym3 {
            xx: a.dot(sa),
            xy: a.dot(sb),
            xz: a.dot(sc),
            yy: b.dot(sb),
            yz: b.dot(sc),
            zz: c.dot(sc),
        }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, m: &glam::DMat3) {
        self.x.set(lane, m.x_axis);
        self.y.set(lane, m.y_axis);
        self.z.set(lane, m.z_axis);
    }

    #[inline(always)]
    pub(super) fn get(&self, lane: usize) -> glam::DMat3 {
        glam::DMat3::from_cols(self.x.get(lane), self.y.get(lane), self.z.get(lane))
    }
}

impl<F: Lanes> Sym3<F> {
    #[inline(always)]
    pub(super) fn all(x: F) -> Self {
        Self { xx: x, xy: x, xz: x, yy: x, yz: x, zz: x }
    }

    #[inline(always)]
    pub(super) fn times(self, v: Vec3<F>) -> Vec3<F> {
        Vec3::new(
            Vec3::new(self.xx, self.xy, self.xz).dot(v),
            Vec3::new(self.xy, self.yy, self.yz).dot(v),
            Vec3::new(self.xz, self.yz, self.zz).dot(v),
        )
    }

    /// Plus `a bᵀ + b aᵀ`.
    #[inline(always)]
    pub(super) fn plus_outer(self, a: Vec3<F>, b: Vec3<F>) -> Self {
        let mixed = |p: F, q: F, r: F, s: F, m: F| p.times_plus(q, r.times_plus(s, m));
        Self {
            xx: mixed(a.x, b.x, a.x, b.x, self.xx),
            xy: mixed(a.x, b.y, a.y, b.x, self.xy),
            xz: mixed(a.x, b.z, a.z, b.x, self.xz),
            yy: mixed(a.y, b.y, a.y, b.y, self.yy),
            yz: mixed(a.y, b.z, a.z, b.y, self.yz),
            zz: mixed(a.z, b.z, a.z, b.z, self.zz),
        }
    }

    /// Minus `k v vᵀ`.
    #[inline(always)]
    pub(super) fn minus_square(self, k: F, v: Vec3<F>) -> Self {
        let w = v.scaled(-k);
        Self {
            xx: w.x.times_plus(v.x, self.xx),
            xy: w.x.times_plus(v.y, self.xy),
            xz: w.x.times_plus(v.z, self.xz),
            yy: w.y.times_plus(v.y, self.yy),
            yz: w.y.times_plus(v.z, self.yz),
            zz: w.z.times_plus(v.z, self.zz),
        }
    }

    #[inline(always)]
    pub(super) fn plus(self, o: Self) -> Self {
        Self {
            xx: self.xx + o.xx,
            xy: self.xy + o.xy,
            xz: self.xz + o.xz,
            yy: self.yy + o.yy,
            yz: self.yz + o.yz,
            zz: self.zz + o.zz,
        }
    }

    #[inline(always)]
    pub(super) fn choose(truth: F::Truth, yes: Self, no: Self) -> Self {
        Self {
            xx: F::choose(truth, yes.xx, no.xx),
            xy: F::choose(truth, yes.xy, no.xy),
            xz: F::choose(truth, yes.xz, no.xz),
            yy: F::choose(truth, yes.yy, no.yy),
            yz: F::choose(truth, yes.yz, no.yz),
            zz: F::choose(truth, yes.zz, no.zz),
        }
    }

    /// Adds to one hair's.
    #[inline(always)]
    pub(super) fn add(&mut self, lane: usize, m: &glam::DMat3) {
        for (sum, more) in [
            (&mut self.xx, m.x_axis.x),
            (&mut self.xy, m.x_axis.y),
            (&mut self.xz, m.x_axis.z),
            (&mut self.yy, m.y_axis.y),
            (&mut self.yz, m.y_axis.z),
            (&mut self.zz, m.z_axis.z),
        ] {
            sum.set(lane, sum.get(lane) + more);
        }
    }

    #[inline(always)]
    pub(super) fn plus_diagonal(self, d: Vec3<F>) -> Self {
        Self { xx: self.xx + d.x, yy: self.yy + d.y, zz: self.zz + d.z, ..self }
    }
}
