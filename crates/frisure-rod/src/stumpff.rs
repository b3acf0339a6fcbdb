//! Stumpff functions: the trigonometry of rotations without its removable singularities.

/// Highest index that [`stumpff`] computes.
pub(crate) const ORDERS: usize = 9;

/// Argument θ² (rad²) from which on the closed forms lose nothing; below it the series are short. Chosen: at θ = 3 both
/// agree to 1e-12 (tested), and fewer than 16 terms reach the last bit.
const SERIES_LIMIT: f64 = 9.0;

/// `c_k(y) = Σ_j (−y)^j / (2j + k)!` for k = 0..9, with `y = θ² ≥ 0`.
///
/// `c_0 = cos θ`, `c_1 = sin θ/θ`, `c_2 = (1 − cos θ)/θ²`, `c_3 = (θ − sin θ)/θ³`, … They are entire
/// in `y`: the straight fibre is a case like any other. \[Battin\] §4.5
pub(crate) fn stumpff(y: f64) -> [f64; ORDERS] {
    let mut c = [0.0; ORDERS];
    if y < SERIES_LIMIT {
        // Downward recurrence c_k = 1/k! − y c_{k+2}, from the two series; upwards each step would divide by y, which may be
        // zero. [Battin] §4.5
        (c[7], c[8]) = series(y);
        for k in (0..7).rev() {
            c[k] = INVERSE_FACTORIALS[k] - y * c[k + 2];
        }
    } else {
        // Upward recurrence c_{k+2} = (1/k! − c_k)/y, from cos θ and sin θ/θ: no cancellation where y is large.
        let theta = y.sqrt();
        (c[1], c[0]) = theta.sin_cos();
        c[1] /= theta;
        for k in 0..7 {
            c[k + 2] = (INVERSE_FACTORIALS[k] - c[k]) / y;
        }
    }
    c
}

/// The power series of `c_7` and `c_8`, to the last bit for `y` below [`SERIES_LIMIT`].
#[inline]
fn series(y: f64) -> (f64, f64) {
    // The first term left out, y^(TERMS+1)/(2 TERMS + 9)!, is below 2⁻⁵³ of the first, 1/7!, at each bound.
    if y < 0.05 {
        horner::<5>(y)
    } else if y < 1.0 {
        horner::<8>(y)
    } else {
        horner::<14>(y)
    }
}

/// Both series at once, so that neither waits for the other.
#[inline]
fn horner<const TERMS: usize>(y: f64) -> (f64, f64) {
    let (mut odd, mut even) =
        (INVERSE_FACTORIALS[2 * TERMS + 7], INVERSE_FACTORIALS[2 * TERMS + 8]);
    for j in (0..TERMS).rev() {
        odd = INVERSE_FACTORIALS[2 * j + 7] - y * odd;
        even = INVERSE_FACTORIALS[2 * j + 8] - y * even;
    }
    (odd, even)
}

const INVERSE_FACTORIALS: [f64; 38] = {
    let mut table = [1.0; 38];
    let mut n = 1;
    let mut factorial = 1.0;
    while n < 38 {
        factorial *= n as f64;
        table[n] = 1.0 / factorial;
        n += 1;
    }
    table
};

/// `dc_k/dy = (k c_{k+2} − c_{k+1}) / 2`, from the table of values.
#[inline]
pub(crate) fn first_derivative(c: &[f64; ORDERS], k: usize) -> f64 {
    // Term by term of the series: j (−1)^j y^(j−1)/(2j + k)! with 2j = (2j + k) − k. docs/theory.md, "Elements"
    0.5 * (k as f64 * c[k + 2] - c[k + 1])
}

/// `d²c_k/dy²`, by the same rule applied twice.
#[inline]
pub(crate) fn second_derivative(c: &[f64; ORDERS], k: usize) -> f64 {
    0.5 * (k as f64 * first_derivative(c, k + 2) - first_derivative(c, k + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_the_trigonometry_they_stand_for() {
        for theta in [1e-8, 1e-3, 0.2, 0.99, 1.01, 2.9, 2.9999, 3.0001, 7.0, 60.0] {
            let c = stumpff(theta * theta);
            assert!((c[0] - theta.cos()).abs() < 1e-15 * (1.0 + theta), "{theta}");
            assert!((c[1] - theta.sin() / theta).abs() < 1e-15, "{theta}");
            let half = (0.5 * theta).sin();
            assert!((c[2] / (2.0 * half * half / (theta * theta)) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn series_and_closed_form_meet() {
        let (below, above) = (stumpff(SERIES_LIMIT * (1.0 - 1e-16)), stumpff(SERIES_LIMIT));
        for k in 0..ORDERS {
            assert!((below[k] / above[k] - 1.0).abs() < 1e-12, "c_{k}: {below:?} {above:?}");
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        for y in [0.0, 1e-6, 0.3, 4.0, 20.0] {
            let (h, c) = (1e-4, stumpff(y));
            let (up, down) = (stumpff(y + h), stumpff((y - h).max(0.0)));
            let gap = y + h - (y - h).max(0.0);
            for k in 0..5 {
                let d = (up[k] - down[k]) / gap;
                assert!((d - first_derivative(&c, k)).abs() < 1e-4, "c_{k}' at {y}");
                let dd = (first_derivative(&up, k) - first_derivative(&down, k)) / gap;
                assert!((dd - second_derivative(&c, k)).abs() < 1e-4, "c_{k}'' at {y}");
            }
        }
    }
}
