//! Gauss–Legendre collocation with three stages: order six, and exact for every quadratic invariant,
//! such as |ζ|² and M·ζ (Hairer, Lubich & Wanner, *Geometric Numerical Integration*, IV.2).

const R: f64 = 3.872_983_346_207_417; // √15
const C: [f64; 3] = [0.5 - R / 10.0, 0.5, 0.5 + R / 10.0];
const A: [[f64; 3]; 3] = [
    [5.0 / 36.0, 2.0 / 9.0 - R / 15.0, 5.0 / 36.0 - R / 30.0],
    [5.0 / 36.0 + R / 24.0, 2.0 / 9.0, 5.0 / 36.0 - R / 24.0],
    [5.0 / 36.0 + R / 30.0, 2.0 / 9.0 + R / 15.0, 5.0 / 36.0],
];
const B: [f64; 3] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];

/// The state at `to` of the solution of `y' = f(s, y)` that starts from `y` at `from`, in equal steps.
pub(super) fn integrate<const N: usize>(
    f: &impl Fn(f64, &[f64; N]) -> [f64; N],
    from: f64,
    to: f64,
    steps: usize,
    mut y: [f64; N],
) -> [f64; N] {
    let h = (to - from) / steps as f64;
    let mut slopes = [f(from + 0.5 * h, &y); 3];
    for i in 0..steps {
        if i > 0 {
            slopes = extrapolated(&slopes);
        }
        y = step(f, from + i as f64 * h, h, &y, &mut slopes);
    }
    y
}

/// Slopes at the stages of the next step, on the parabola through those of this one: a start nearer than equal ones.
fn extrapolated<const N: usize>(slopes: &[[f64; N]; 3]) -> [[f64; N]; 3] {
    // Lagrange's polynomials of the stages.
    let share = |i: usize, at: f64| -> f64 {
        (0..3).filter(|&j| j != i).map(|j| (at - C[j]) / (C[i] - C[j])).product()
    };
    C.map(|c| {
        let shares = [0, 1, 2].map(|i| share(i, 1.0 + c));
        std::array::from_fn(|k| (0..3).map(|i| shares[i] * slopes[i][k]).sum())
    })
}

/// A step from `y` at `s`; `slopes` are those of its stages, near the solution, and then at it.
fn step<const N: usize>(
    f: &impl Fn(f64, &[f64; N]) -> [f64; N],
    s: f64,
    h: f64,
    y: &[f64; N],
    slopes: &mut [[f64; N]; 3],
) -> [f64; N] {
    for _ in 0..60 {
        let mut change = 0.0_f64;
        for i in 0..3 {
            let mut at = *y;
            for (j, slope) in slopes.iter().enumerate() {
                for k in 0..N {
                    at[k] += h * A[i][j] * slope[k];
                }
            }
            let new = f(s + C[i] * h, &at);
            for k in 0..N {
                change = change.max(h.abs() * (new[k] - slopes[i][k]).abs() / (1.0 + y[k].abs()));
            }
            slopes[i] = new;
        }
        if change < 2e-15 {
            break;
        }
    }
    let mut next = *y;
    for (b, slope) in B.iter().zip(&*slopes) {
        for k in 0..N {
            next[k] += h * b * slope[k];
        }
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pendulum_is_of_order_six() {
        let f = |_: f64, y: &[f64; 2]| [y[1], -y[0]];
        let error = |n| (integrate(&f, 0.0, 3.0, n, [1.0, 0.0])[0] - 3.0_f64.cos()).abs();
        let ratio = error(8) / error(16);
        assert!((56.0..72.0).contains(&ratio), "{ratio}");
    }
}
