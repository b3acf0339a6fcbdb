//! Vectors and 3×3 matrices of [`Lanes`], one per rod.

use std::ops::{Add, Mul, Sub};

use super::lanes::Lanes;

/// A vector per rod.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vec3<F> {
    pub(super) x: F,
    pub(super) y: F,
    pub(super) z: F,
}

/// A matrix per rod, by columns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mat3<F> {
    pub(super) x: Vec3<F>,
    pub(super) y: Vec3<F>,
    pub(super) z: Vec3<F>,
}

/// A symmetric matrix per rod.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sym3<F> {
    pub(super) xx: F,
    pub(super) xy: F,
    pub(super) xz: F,
    pub(super) yy: F,
    pub(super) yz: F,
    pub(super) zz: F,
}

impl<F: Lanes> Add for Vec3<F> {
    type Output = Self;

    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl<F: Lanes> Sub for Vec3<F> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl<F: Lanes> Mul<F> for Vec3<F> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, k: F) -> Self {
        Self::new(self.x * k, self.y * k, self.z * k)
    }
}

impl<F: Lanes> Add for Sym3<F> {
    type Output = Self;

    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            xx: self.xx + o.xx,
            xy: self.xy + o.xy,
            xz: self.xz + o.xz,
            yy: self.yy + o.yy,
            yz: self.yz + o.yz,
            zz: self.zz + o.zz,
        }
    }
}

impl<F: Lanes> Vec3<F> {
    #[inline(always)]
    pub(super) fn new(x: F, y: F, z: F) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub(super) fn splat(x: F) -> Self {
        Self { x, y: x, z: x }
    }

    /// Component by component.
    #[inline(always)]
    pub(super) fn component_mul(self, o: Self) -> Self {
        Self::new(self.x * o.x, self.y * o.y, self.z * o.z)
    }

    /// `self × k + o`.
    #[inline(always)]
    pub(super) fn mul_add(self, k: F, o: Self) -> Self {
        Self::new(self.x.mul_add(k, o.x), self.y.mul_add(k, o.y), self.z.mul_add(k, o.z))
    }

    #[inline(always)]
    pub(super) fn dot(self, o: Self) -> F {
        self.x.mul_add(o.x, self.y.mul_add(o.y, self.z * o.z))
    }

    #[inline(always)]
    pub(super) fn cross(self, o: Self) -> Self {
        Self::new(
            self.y.mul_add(o.z, -(self.z * o.y)),
            self.z.mul_add(o.x, -(self.x * o.z)),
            self.x.mul_add(o.y, -(self.y * o.x)),
        )
    }

    #[inline(always)]
    pub(super) fn select(mask: F::Mask, yes: Self, no: Self) -> Self {
        Self::new(
            F::select(mask, yes.x, no.x),
            F::select(mask, yes.y, no.y),
            F::select(mask, yes.z, no.z),
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
    pub(super) fn splat(x: F) -> Self {
        let x = Vec3::splat(x);
        Self { x, y: x, z: x }
    }

    #[inline(always)]
    pub(super) fn mul_vec(self, v: Vec3<F>) -> Vec3<F> {
        self.x.mul_add(v.x, self.y.mul_add(v.y, self.z * v.z))
    }

    /// The transpose times a vector.
    #[inline(always)]
    pub(super) fn transpose_mul(self, v: Vec3<F>) -> Vec3<F> {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }

    /// The product of this matrix with one whose rows are the columns of `o`, likewise with its rows as columns.
    #[inline(always)]
    pub(super) fn transpose_mul_mat(self, o: Self) -> Self {
        Self { x: self.transpose_mul(o.x), y: self.transpose_mul(o.y), z: self.transpose_mul(o.z) }
    }

    #[inline(always)]
    pub(super) fn rows_of(self, o: Self) -> Self {
        let row = |x: F, y: F, z: F| o.x.mul_add(x, o.y.mul_add(y, o.z * z));
        Self {
            x: row(self.x.x, self.y.x, self.z.x),
            y: row(self.x.y, self.y.y, self.z.y),
            z: row(self.x.z, self.y.z, self.z.z),
        }
    }

    /// The turn from this frame to another, as a vector in it: `2 sin(θ/2)` along the axis, as
    /// [`crate::rotation::deviation`].
    #[inline(always)]
    pub(super) fn deviation(self, to: Self) -> Vec3<F> {
        let (x, y, z) =
            (self.transpose_mul(to.x), self.transpose_mul(to.y), self.transpose_mul(to.z));
        let skew = Vec3::new(y.z - z.y, z.x - x.z, x.y - y.x);
        let one = x.x.splat(1.0);
        let trace = one + x.x + y.y + z.z;
        // 2 sin θ over 2 cos(θ/2); the bound 0.04 of crate::rotation::deviation keeps it finite near half a turn.
        skew * (one / trace.max(one.splat(0.04)).sqrt())
    }

    #[inline(always)]
    pub(super) fn select(mask: F::Mask, yes: Self, no: Self) -> Self {
        Self {
            x: Vec3::select(mask, yes.x, no.x),
            y: Vec3::select(mask, yes.y, no.y),
            z: Vec3::select(mask, yes.z, no.z),
        }
    }

    #[inline(always)]
    pub(super) fn mul_mat(self, o: Self) -> Self {
        Self { x: self.mul_vec(o.x), y: self.mul_vec(o.y), z: self.mul_vec(o.z) }
    }

    /// `M S Mᵀ`.
    #[inline(always)]
    pub(super) fn congruence(self, s: Sym3<F>) -> Sym3<F> {
        let row = |x: F, y: F, z: F| Vec3::new(x, y, z);
        let (a, b, c) = (
            row(self.x.x, self.y.x, self.z.x),
            row(self.x.y, self.y.y, self.z.y),
            row(self.x.z, self.y.z, self.z.z),
        );
        // Rows a, b, c of M: entry ij is row i times S times row j, six of nine by symmetry.
        let (sa, sb, sc) = (s.mul_vec(a), s.mul_vec(b), s.mul_vec(c));
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
    pub(super) fn splat(x: F) -> Self {
        Self { xx: x, xy: x, xz: x, yy: x, yz: x, zz: x }
    }

    #[inline(always)]
    pub(super) fn mul_vec(self, v: Vec3<F>) -> Vec3<F> {
        Vec3::new(
            Vec3::new(self.xx, self.xy, self.xz).dot(v),
            Vec3::new(self.xy, self.yy, self.yz).dot(v),
            Vec3::new(self.xz, self.yz, self.zz).dot(v),
        )
    }

    /// Adds `a bᵀ + b aᵀ`.
    #[inline(always)]
    pub(super) fn add_outer(self, a: Vec3<F>, b: Vec3<F>) -> Self {
        // Fused: one rounding per product and sum, where the processor has it.
        let mixed = |p: F, q: F, r: F, s: F, m: F| p.mul_add(q, r.mul_add(s, m));
        Self {
            xx: mixed(a.x, b.x, a.x, b.x, self.xx),
            xy: mixed(a.x, b.y, a.y, b.x, self.xy),
            xz: mixed(a.x, b.z, a.z, b.x, self.xz),
            yy: mixed(a.y, b.y, a.y, b.y, self.yy),
            yz: mixed(a.y, b.z, a.z, b.y, self.yz),
            zz: mixed(a.z, b.z, a.z, b.z, self.zz),
        }
    }

    /// Subtracts `k v vᵀ`.
    #[inline(always)]
    pub(super) fn sub_square(self, k: F, v: Vec3<F>) -> Self {
        let w = v * -k;
        Self {
            xx: w.x.mul_add(v.x, self.xx),
            xy: w.x.mul_add(v.y, self.xy),
            xz: w.x.mul_add(v.z, self.xz),
            yy: w.y.mul_add(v.y, self.yy),
            yz: w.y.mul_add(v.z, self.yz),
            zz: w.z.mul_add(v.z, self.zz),
        }
    }

    #[inline(always)]
    pub(super) fn select(mask: F::Mask, yes: Self, no: Self) -> Self {
        Self {
            xx: F::select(mask, yes.xx, no.xx),
            xy: F::select(mask, yes.xy, no.xy),
            xz: F::select(mask, yes.xz, no.xz),
            yy: F::select(mask, yes.yy, no.yy),
            yz: F::select(mask, yes.yz, no.yz),
            zz: F::select(mask, yes.zz, no.zz),
        }
    }

    /// Adds to the matrix of one rod.
    #[inline(always)]
    pub(super) fn add_to(&mut self, lane: usize, m: &glam::DMat3) {
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
    pub(super) fn add_diagonal(self, d: Vec3<F>) -> Self {
        Self { xx: self.xx + d.x, yy: self.yy + d.y, zz: self.zz + d.z, ..self }
    }
}
