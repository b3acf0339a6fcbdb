//! The 3×3 pivots of the Hessian: `L D Lᵀ` factors and the lowest eigenvector.

use glam::{DMat3, DVec3};

/// `L D Lᵀ` of a symmetric positive definite matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockFactor {
    d: DVec3,
    l21: f64,
    l31: f64,
    l32: f64,
}

impl BlockFactor {
    /// `None` unless the matrix is positive definite beyond rounding.
    #[inline]
    pub(crate) fn new(m: &DMat3) -> Option<Self> {
        // A pivot this small relative to its diagonal is zero to rounding: some hundred times that of f64, since the block is
        // a sum of products that cancel.
        const ROUNDING: f64 = 1e-13;
        // Column by column: d_k and the column of L below it.
        let d1 = m.x_axis.x;
        let (l21, l31) = (m.x_axis.y / d1, m.x_axis.z / d1);
        let d2 = m.y_axis.y - l21 * m.x_axis.y;
        let e = m.y_axis.z - l31 * m.x_axis.y;
        let l32 = e / d2;
        let d3 = m.z_axis.z - l31 * m.x_axis.z - l32 * e;
        // The comparisons are false for NaN, which so has no factor either.
        let positive =
            d1 > 0.0 && d2 > ROUNDING * m.y_axis.y.abs() && d3 > ROUNDING * m.z_axis.z.abs();
        positive.then_some(Self { d: DVec3::new(d1, d2, d3), l21, l31, l32 })
    }

    #[inline]
    pub(crate) fn solve(&self, b: DVec3) -> DVec3 {
        // L y = b forwards, then D Lᵀ x = y backwards.
        let y2 = b.y - self.l21 * b.x;
        let y3 = b.z - self.l31 * b.x - self.l32 * y2;
        let z = y3 / self.d.z;
        let y = y2 / self.d.y - self.l32 * z;
        let x = b.x / self.d.x - self.l21 * y - self.l31 * z;
        DVec3::new(x, y, z)
    }

    /// `M⁻¹ Bᵀ`.
    #[inline]
    pub(crate) fn solve_transposed(&self, b: &DMat3) -> DMat3 {
        let t = b.transpose();
        DMat3::from_cols(self.solve(t.x_axis), self.solve(t.y_axis), self.solve(t.z_axis))
    }
}

/// The eigenvector (unit) of the smallest eigenvalue of a symmetric matrix, and that eigenvalue.
pub(crate) fn lowest_eigenpair(m: &DMat3) -> (f64, DVec3) {
    // Cyclic Jacobi rotations: rare, small, and exact enough for a direction. They converge quadratically; twelve sweeps
    // are chosen, where a 3×3 matrix takes about five.
    let (mut a, mut v) = (*m, DMat3::IDENTITY);
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let apq = a.col(q)[p];
            if apq == 0.0 {
                continue;
            }
            // The rotation in the plane p, q that makes a_pq zero: tan 2θ = 2 a_pq/(a_qq − a_pp).
            let theta = 0.5 * (2.0 * apq).atan2(a.col(q)[q] - a.col(p)[p]);
            let (s, c) = theta.sin_cos();
            let mut g = DMat3::IDENTITY;
            g.col_mut(p)[p] = c;
            g.col_mut(q)[q] = c;
            g.col_mut(q)[p] = s;
            g.col_mut(p)[q] = -s;
            a = g.transpose() * a * g;
            v *= g;
        }
    }
    let values = [a.x_axis.x, a.y_axis.y, a.z_axis.z];
    let lowest = (0..3).min_by(|&i, &j| values[i].total_cmp(&values[j])).unwrap_or(0);
    (values[lowest], v.col(lowest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spd() -> DMat3 {
        DMat3::from_cols_array(&[4.0, 1.0, -0.5, 1.0, 3.0, 0.2, -0.5, 0.2, 2.0])
    }

    #[test]
    fn factors_solve_linear_systems() {
        let (m, b) = (spd(), DVec3::new(1.0, -2.0, 0.5));
        let p = BlockFactor::new(&m).unwrap();
        assert!((m * p.solve(b)).abs_diff_eq(b, 1e-14));
        let n = DMat3::from_cols(b, b.yzx(), b.zxy());
        assert!((m * p.solve_transposed(&n)).abs_diff_eq(n.transpose(), 1e-13));
    }

    #[test]
    fn a_block_that_is_not_positive_definite_has_no_factor() {
        let m = spd() - DMat3::from_diagonal(DVec3::splat(2.5));
        assert!(BlockFactor::new(&m).is_none());
        assert!(BlockFactor::new(&DMat3::from_diagonal(DVec3::new(f64::NAN, 1.0, 1.0))).is_none());
    }

    #[test]
    fn finds_the_lowest_eigenvector() {
        let m = spd();
        let (value, vector) = lowest_eigenpair(&m);
        assert!((m * vector).abs_diff_eq(vector * value, 1e-12));
        assert!(value < 2.0);
    }

    use glam::Vec3Swizzles;
}
