//! Rotations of joints in lanes; the formulas are those of [`crate::rotation`], docs/theory.md (L1).

use super::lanes::Lanes;
use super::linear::{Mat3, Sym3, Vec3};

/// Largest square of a joint's turn (rad²) for which the series are exact to rounding: a little more than half a turn.
pub(super) const LARGEST_SQUARE: f64 = 9.9;

/// Terms of the series of c₄ and c₅ up to [`LARGEST_SQUARE`] in double precision.
const TERMS: usize = 13;

/// The Stumpff functions `c_1` to `c_5` of the square of a joint's turn.
#[derive(Clone, Copy)]
pub(super) struct RotationTable<F> {
    square: F,
    c1: F,
    c2: F,
    c3: F,
    c4: F,
    c5: F,
}

const fn inverse_factorial(n: usize) -> f64 {
    let (mut product, mut k) = (1.0, 2);
    while k <= n {
        product *= k as f64;
        k += 1;
    }
    1.0 / product
}

const SERIES: [(f64, f64); TERMS] = {
    let mut table = [(0.0, 0.0); TERMS];
    let mut j = 0;
    while j < TERMS {
        table[j] = (inverse_factorial(2 * j + 4), inverse_factorial(2 * j + 5));
        j += 1;
    }
    table
};

impl<F: Lanes> RotationTable<F> {
    #[inline(always)]
    pub(super) fn of(c: Vec3<F>) -> Self {
        // c_4 and c_5 by their power series, c_3 to c_1 by the downward recurrence c_k = 1/k! − θ² c_{k+2}.
        let square = c.dot(c);
        let down = -square;
        // Series alone, without a branch for large turns: lanes would have to take both, and joints turn by less than half a turn.
        let last = SERIES[F::SERIES_TERMS - 1];
        let (mut c4, mut c5) = (square.splat(last.0), square.splat(last.1));
        for &(even, odd) in SERIES[..F::SERIES_TERMS - 1].iter().rev() {
            c4 = down.mul_add(c4, square.splat(even));
            c5 = down.mul_add(c5, square.splat(odd));
        }
        let c3 = down.mul_add(c5, square.splat(1.0 / 6.0));
        let c2 = down.mul_add(c4, square.splat(0.5));
        let c1 = down.mul_add(c3, square.splat(1.0));
        Self { square, c1, c2, c3, c4, c5 }
    }

    /// `exp([c]×)`.
    #[inline(always)]
    pub(super) fn rotation(&self, c: Vec3<F>) -> Mat3<F> {
        self.matrix(c, self.c1, self.c2)
    }

    /// The right Jacobian of the exponential.
    #[inline(always)]
    pub(super) fn jacobian(&self, c: Vec3<F>) -> Mat3<F> {
        self.matrix(c, -self.c2, self.c3)
    }

    /// `I + a [c]× + b [c]×²`.
    #[inline(always)]
    fn matrix(&self, c: Vec3<F>, a: F, b: F) -> Mat3<F> {
        let rest = (-self.square).mul_add(b, c.x.splat(1.0));
        let (bc, ac) = (c * b, c * a);
        let (xy, xz, yz) = (bc.x * c.y, bc.x * c.z, bc.y * c.z);
        Mat3 {
            x: Vec3::new(bc.x.mul_add(c.x, rest), xy + ac.z, xz - ac.y),
            y: Vec3::new(xy - ac.z, bc.y.mul_add(c.y, rest), yz + ac.x),
            z: Vec3::new(xz + ac.y, yz - ac.x, bc.z.mul_add(c.z, rest)),
        }
    }

    /// Adds `D(λ)`, the second derivative of the turn contracted with `lambda`, to a symmetric matrix.
    #[inline(always)]
    pub(super) fn add_second(&self, c: Vec3<F>, lambda: Vec3<F>, sum: Sym3<F>) -> Sym3<F> {
        // Derivatives of c_2 and c_3 by θ²: dc_k/dθ² = (k c_{k+2} − c_{k+1}) / 2.
        let half = c.x.splat(0.5);
        let d2 = (-half).mul_add(self.c3, self.c4);
        let d3 = half * c.x.splat(3.0).mul_add(self.c5, -self.c4);
        // (E4): D = c vᵀ + v cᵀ + c_3 ((λ·c) I − ½ (λ cᵀ + c λᵀ)) with v = c_3′ c×(c×λ) + c_2′ c×λ.
        let turned = c.cross(lambda);
        let swirl = c.cross(turned).mul_add(d3, turned * d2);
        let other = lambda.mul_add(-(half * self.c3), swirl);
        let along = self.c3 * lambda.dot(c);
        sum.add_outer(c, other).add_diagonal(Vec3::splat(along))
    }

    /// `exp(−[c]×) v`.
    #[inline(always)]
    pub(super) fn back(&self, c: Vec3<F>, v: Vec3<F>) -> Vec3<F> {
        let once = c.cross(v);
        c.cross(once).mul_add(self.c2, once.mul_add(-self.c1, v))
    }
}
