//! Rotations of joints, for all hairs at once; the formulas are those of [`crate::rotation`].

use super::lanes::{Lanes, Mat3, Sym3, Vec3};

/// Largest square of a joint's turn (rad²) up to which the series are exact: a little more than half a
/// turn.
pub(super) const LARGEST_SQUARE: f64 = 9.9;

/// Terms of the series of c₄ and c₅ up to [`LARGEST_SQUARE`] in double precision.
const TERMS: usize = 13;

/// `c_1` to `c_5` of a turn's square.
#[derive(Clone, Copy)]
pub(super) struct Table<F> {
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

impl<F: Lanes> Table<F> {
    #[inline(always)]
    pub(super) fn of(c: Vec3<F>) -> Self {
        let square = c.dot(c);
        let down = -square;
        let last = SERIES[F::TERMS - 1];
        let (mut c4, mut c5) = (square.all(last.0), square.all(last.1));
        for &(even, odd) in SERIES[..F::TERMS - 1].iter().rev() {
            c4 = down.times_plus(c4, square.all(even));
            c5 = down.times_plus(c5, square.all(odd));
        }
        let c3 = down.times_plus(c5, square.all(1.0 / 6.0));
        let c2 = down.times_plus(c4, square.all(0.5));
        let c1 = down.times_plus(c3, square.all(1.0));
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
        let rest = (-self.square).times_plus(b, c.x.all(1.0));
        let (bc, ac) = (c.scaled(b), c.scaled(a));
        let (xy, xz, yz) = (bc.x * c.y, bc.x * c.z, bc.y * c.z);
        Mat3 {
            x: Vec3::new(bc.x.times_plus(c.x, rest), xy + ac.z, xz - ac.y),
            y: Vec3::new(xy - ac.z, bc.y.times_plus(c.y, rest), yz + ac.x),
            z: Vec3::new(xz + ac.y, yz - ac.x, bc.z.times_plus(c.z, rest)),
        }
    }

    /// Adds the second derivative of the turn, contracted with `lambda`.
    #[inline(always)]
    pub(super) fn add_second(&self, c: Vec3<F>, lambda: Vec3<F>, sum: Sym3<F>) -> Sym3<F> {
        let half = c.x.all(0.5);
        let d2 = (-half).times_plus(self.c3, self.c4);
        let d3 = half * c.x.all(3.0).times_plus(self.c5, -self.c4);
        let turned = c.cross(lambda);
        let swirl = c.cross(turned).scaled_plus(d3, turned.scaled(d2));
        let other = lambda.scaled_plus(-(half * self.c3), swirl);
        let along = self.c3 * lambda.dot(c);
        sum.plus_outer(c, other).plus_diagonal(Vec3::all(along))
    }

    /// `exp(−[c]×) v`.
    #[inline(always)]
    pub(super) fn back(&self, c: Vec3<F>, v: Vec3<F>) -> Vec3<F> {
        let once = c.cross(v);
        c.cross(once).scaled_plus(self.c2, once.scaled_plus(-self.c1, v))
    }
}
