//! Rotation vectors, and the family of vector functions that helices are made of.
//!
//! With `φ_0(c) = exp([c]×)`, `φ_1 = ∫₀¹ exp(σ[c]×) dσ` and `φ_2 = ∫₀¹ φ_1(σc) σ dσ`, a helix turns by
//! `φ_0`, advances by `φ_1` and has the first moment `φ_2` (docs/theory.md, "Elements"). On a
//! fixed vector each is `a + c×B(y) + c×(c×C(y))` with y = |c|², so that one set of formulas serves
//! all, and sums of them.

use glam::{DMat3, DVec3};

use crate::stumpff::{ORDERS, first_derivative, second_derivative};

/// The matrix of `x ↦ v × x`.
#[inline]
pub(crate) fn cross_matrix(v: DVec3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(0.0, v.z, -v.y),
        DVec3::new(-v.z, 0.0, v.x),
        DVec3::new(v.y, -v.x, 0.0),
    )
}

/// `a bᵀ`.
#[inline]
pub(crate) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// `a bᵀ + b aᵀ`.
#[inline]
pub(crate) fn symmetric_outer(a: DVec3, b: DVec3) -> DMat3 {
    outer(a, b) + outer(b, a)
}

#[inline]
pub(crate) fn scaled_identity(x: f64) -> DMat3 {
    DMat3::from_diagonal(DVec3::splat(x))
}

/// `exp([c]×)` from the Stumpff table of |c|².
#[inline]
pub(crate) fn exponential(c: DVec3, table: &[f64; ORDERS]) -> DMat3 {
    // Rodrigues: sin θ/θ = c_1, (1 − cos θ)/θ² = c_2.
    let k = cross_matrix(c);
    // [c]×² = c cᵀ − |c|² I.
    let square = outer(c, c) - scaled_identity(c.length_squared());
    DMat3::IDENTITY + k * table[1] + square * table[2]
}

/// The right Jacobian J with `exp[c + x] = exp[c] exp[J x + …]`.
#[inline]
pub(crate) fn right_jacobian(c: DVec3, table: &[f64; ORDERS]) -> DMat3 {
    // J = ∫₀¹ exp(−σ[c]×) dσ = I − c_2 [c]× + c_3 [c]×². (L1)
    let square = outer(c, c) - scaled_identity(c.length_squared());
    DMat3::IDENTITY - cross_matrix(c) * table[2] + square * table[3]
}

/// The symmetric matrix D with `exp[c + x] = exp[c] exp[b]`, `λ·b = λ·J x + ½ xᵀ D x + …`.
#[inline]
pub(crate) fn right_jacobian_derivative(c: DVec3, table: &[f64; ORDERS], lambda: DVec3) -> DMat3 {
    // b″ = (d/dt J(c + t x)) x: the curve of body angular velocity has no further second-order
    // term, since b × b vanishes at the start. Terms with x × x vanish too; docs/theory.md (E4) has the rest.
    let (d2, d3) = (first_derivative(table, 2), first_derivative(table, 3));
    let swirl = c.cross(c.cross(lambda)) * d3 - lambda.cross(c) * d2;
    let gamma = table[3];
    symmetric_outer(c, swirl) + scaled_identity(gamma * lambda.dot(c))
        - symmetric_outer(lambda, c) * (0.5 * gamma)
}

/// The vector of an exact rotation that is smooth up to half a turn: `2 sin(θ/2)` along the axis.
#[inline]
pub(crate) fn deviation(m: &DMat3) -> DVec3 {
    let skew =
        DVec3::new(m.y_axis.z - m.z_axis.y, m.z_axis.x - m.x_axis.z, m.x_axis.y - m.y_axis.x);
    let trace = m.x_axis.x + m.y_axis.y + m.z_axis.z;
    // The skew part has the length 2 sin θ = 4 sin(θ/2) cos(θ/2), and 1 + tr = 4 cos²(θ/2). Near half a turn the direction
    // is arbitrary; the bound 4 cos² ≥ 0.04 (θ ≤ 169°) is chosen so that the length stays finite.
    skew / (1.0 + trace).max(0.04).sqrt()
}

/// The rotation vector (rad) nearest to `rest` among all those of the same rotation as `turn`: a
/// long element of a tight curl turns by more than half a turn.
pub(crate) fn nearest_turn(turn: DVec3, rest: DVec3) -> DVec3 {
    // All rotation vectors of a rotation are (θ + 2πk) along its axis; k minimises the distance along that axis. A turn
    // below rounding (1e-9 rad) has no axis of its own and takes that of `rest`.
    let angle = turn.length();
    let axis = if angle > 1e-9 { turn / angle } else { rest.normalize_or_zero() };
    let whole = ((rest.dot(axis) - angle) / std::f64::consts::TAU).round();
    turn + axis * (whole * std::f64::consts::TAU)
}

/// `F(c) = a + c×B(y) + c×(c×C(y))`, y = |c|², with the vectors B and C and their derivatives by y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RotationSeries {
    pub(crate) constant: DVec3,
    /// B, B′, B″.
    pub(crate) once: [DVec3; 3],
    /// C, C′, C″.
    pub(crate) twice: [DVec3; 3],
}

impl RotationSeries {
    /// `scale φ_k(c) e`, from the Stumpff table; k ≤ 2.
    #[inline]
    pub(crate) fn phi(k: usize, table: &[f64; ORDERS], scale: f64, e: DVec3) -> Self {
        let e = e * scale;
        let jet = |j: usize| {
            [e * table[j], e * first_derivative(table, j), e * second_derivative(table, j)]
        };
        // φ_k(c) e = e/k! + c_{k+1} c×e + c_{k+2} c×(c×e). (E1)
        let constant = if k == 2 { e * 0.5 } else { e };
        Self { constant, once: jet(k + 1), twice: jet(k + 2) }
    }

    #[inline]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        let add = |a: [DVec3; 3], b: [DVec3; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
        Self {
            constant: self.constant + other.constant,
            once: add(self.once, other.once),
            twice: add(self.twice, other.twice),
        }
    }

    /// `F(c)`.
    #[inline]
    pub(crate) fn value(&self, c: DVec3) -> DVec3 {
        self.constant + c.cross(self.once[0] + c.cross(self.twice[0]))
    }

    /// `∂F/∂c`.
    #[inline]
    pub(crate) fn jacobian(&self, c: DVec3) -> DMat3 {
        let (b, e) = (self.once[0], self.twice[0]);
        let slope = c.cross(self.once[1] + c.cross(self.twice[1])) * 2.0;
        // (E2): x×(c×C) + c×(x×C) = −[c×C]x + (c·C) x − (c·x) C, by the triple product, and dy = 2 c·x in B and C.
        scaled_identity(c.dot(e)) - outer(e, c) - cross_matrix(b + c.cross(e)) + outer(slope, c)
    }

    /// Gradient and Hessian of `ω·F(c)`.
    #[inline]
    pub(crate) fn contracted(&self, c: DVec3, omega: DVec3) -> (DVec3, DMat3) {
        // (E3): ω·F = c·n + q(C) + const with n = B×ω and q(e) = (ω·c)(c·e) − (ω·e)|c|²; n and C depend
        // on y, through which every further derivative is radial.
        let (oc, y) = (omega.dot(c), c.length_squared());
        let q = |e: DVec3| oc * c.dot(e) - omega.dot(e) * y;
        let dq = |e: DVec3| omega * c.dot(e) + e * oc - c * (2.0 * omega.dot(e));
        let n = |order: usize| self.once[order].cross(omega);
        let e = self.twice;
        let n1 = n(1);
        let radial = 2.0 * (c.dot(n1) + q(e[1]));
        // d²y = 2 |dc|², hence the radial term on the diagonal; (dy)² = 4 (c·dc)², hence the one along c cᵀ.
        let bent = 4.0 * (c.dot(n(2)) + q(e[2]));
        let gradient = n(0) + dq(e[0]) + c * radial;
        let hessian = scaled_identity(radial - 2.0 * omega.dot(e[0]))
            + outer(c, c) * bent
            + symmetric_outer(c, (n1 + dq(e[1])) * 2.0)
            + symmetric_outer(omega, e[0]);
        (gradient, hessian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stumpff::stumpff;

    const C: [DVec3; 4] = [
        DVec3::ZERO,
        DVec3::new(1e-5, -2e-5, 1e-5),
        DVec3::new(0.3, -0.5, 0.8),
        DVec3::new(2.0, 3.0, -4.0),
    ];
    const E: DVec3 = DVec3::new(0.2, -0.3, 0.9);
    const OMEGA: DVec3 = DVec3::new(-1.0, 0.4, 0.7);

    fn table(c: DVec3) -> [f64; ORDERS] {
        stumpff(c.length_squared())
    }

    fn difference<T>(f: impl Fn(DVec3) -> T, c: DVec3, axis: usize) -> T
    where
        T: std::ops::Sub<Output = T> + std::ops::Div<f64, Output = T>,
    {
        let h = 1e-5;
        let mut step = DVec3::ZERO;
        step[axis] = h;
        (f(c + step) - f(c - step)) / (2.0 * h)
    }

    #[test]
    fn exponentials_are_rotations() {
        for c in C {
            let r = exponential(c, &table(c));
            assert!((r.transpose() * r).abs_diff_eq(DMat3::IDENTITY, 1e-14));
            assert!(r.abs_diff_eq(DMat3::from_quat(glam::DQuat::from_scaled_axis(c)), 1e-14));
        }
    }

    #[test]
    fn integrals_of_the_exponential() {
        for c in C {
            let steps = 2000;
            let (mut first, mut second) = (DVec3::ZERO, DVec3::ZERO);
            for i in 0..steps {
                let sigma = (f64::from(i) + 0.5) / f64::from(steps);
                let turned = exponential(c * sigma, &table(c * sigma)) * E;
                first += turned / f64::from(steps);
                second += turned * (1.0 - sigma) / f64::from(steps);
            }
            let t = table(c);
            assert!(RotationSeries::phi(1, &t, 1.0, E).value(c).abs_diff_eq(first, 1e-5));
            assert!(RotationSeries::phi(2, &t, 1.0, E).value(c).abs_diff_eq(second, 1e-5));
        }
    }

    #[test]
    fn series_derivatives_agree_with_differences() {
        for c in C {
            for k in 0..3 {
                let series = |c: DVec3| RotationSeries::phi(k, &table(c), 1.0, E);
                let (gradient, hessian) = series(c).contracted(c, OMEGA);
                let jacobian = series(c).jacobian(c);
                for axis in 0..3 {
                    let column = difference(|c| series(c).value(c), c, axis);
                    assert!(jacobian.col(axis).abs_diff_eq(column, 1e-8));
                    assert!((gradient[axis] - OMEGA.dot(column)).abs() < 1e-8);
                    let row = difference(|c| series(c).contracted(c, OMEGA).0, c, axis);
                    assert!(hessian.col(axis).abs_diff_eq(row, 1e-8), "{k} {c}");
                }
            }
        }
    }

    #[test]
    fn right_jacobian_to_second_order() {
        let x = DVec3::new(0.3, 0.5, -0.2);
        for c in C {
            let (t, h) = (table(c), 1e-4);
            let b = |h: f64| {
                let c1 = c + x * h;
                let m = exponential(c, &t).transpose() * exponential(c1, &table(c1));
                deviation(&m)
            };
            let (first, second) = ((b(h) - b(-h)) / (2.0 * h), (b(h) + b(-h)) / (h * h));
            assert!(first.abs_diff_eq(right_jacobian(c, &t) * x, 1e-6));
            let d = right_jacobian_derivative(c, &t, OMEGA);
            assert!((OMEGA.dot(second) - x.dot(d * x)).abs() < 1e-6, "{c}");
        }
    }

    #[test]
    fn turns_beyond_half_a_turn_are_found_near_rest() {
        let rest = DVec3::new(3.0, 1.0, 2.0);
        for turn in [rest * 0.9, rest * 1.1 + DVec3::X * 0.1, rest * 2.5] {
            let short =
                glam::DQuat::from_mat3(&DMat3::from_quat(glam::DQuat::from_scaled_axis(turn)))
                    .to_scaled_axis();
            assert!(nearest_turn(short, turn * 1.05).distance(turn) < 1e-9, "{turn}");
        }
        assert_eq!(nearest_turn(DVec3::Z * 0.3, DVec3::ZERO), DVec3::Z * 0.3);
    }

    #[test]
    fn deviation_is_twice_the_sine_of_half_the_angle() {
        let axis = DVec3::new(1.0, 2.0, -2.0) / 3.0;
        for theta in [1e-6, 0.5, 2.0] {
            let m = DMat3::from_axis_angle(axis, theta);
            assert!(deviation(&m).abs_diff_eq(axis * (2.0 * (0.5 * theta).sin()), 1e-12));
        }
    }
}
