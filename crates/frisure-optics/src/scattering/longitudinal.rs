//! M: how a lobe spreads along the fibre.
//!
//! \[d'Eon 2011\] (7): the von Mises–Fisher distribution of variance v about the mirror
//! direction, averaged around the fibre,
//!
//! ```text
//! M(θi, θo) = exp(−sin θi sin θo / v) I0(cos θi cos θo / v) / (2 v sinh(1/v)),   ∫ M cos θo dθo = 1.
//! ```
//!
//! With I0(x) = e^x i(x) the exponents join to (cos(θi + θo) − 1)/v = −½ |Δ|²/v, where
//! Δ = (cos θi − cos θo, sin θi + sin θo). This neither overflows nor cancels for any v, so no
//! logarithms are needed where v is small.

use glam::Vec4;

use super::elementary::{exp, ln, polynomial, sin_cos};

/// The spread of the four lobes R, TT, TRT and the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Longitudinal {
    /// 1/v of each.
    inverse: Vec4,
    /// v of each.
    variance: Vec4,
    /// 1/(v (1 − e^(−2/v))) of each.
    scale: Vec4,
    /// e^(−2/v) of each.
    least: Vec4,
}

impl Longitudinal {
    /// The spread of the roughness β_M in (0, 1]: \[Chiang 2016\] §4.1, as `pbrt-v3` has it.
    pub(super) fn new(roughness: f32) -> Self {
        let b = roughness;
        // The fit of [Chiang 2016] that makes β_M perceptually even; v of R, v/4 of TT, 4v of TRT and the rest.
        let v = (0.726 * b + 0.812 * b * b + 3.7 * b.powi(20)).powi(2);
        let variance = v * Vec4::new(1.0, 0.25, 4.0, 4.0);
        let inverse = variance.recip();
        let least = (-2.0 * inverse).exp();
        let scale = inverse / (Vec4::ONE - least);
        Self { inverse, variance, scale, least }
    }

    /// Standard deviation √v of R (rad).
    pub(super) fn deviation(&self) -> f32 {
        self.variance.x.sqrt()
    }

    /// M of the four lobes for light leaving at (sin θ, cos θ), given the direction it came from as
    /// each lobe sees it.
    #[inline]
    pub(super) fn values(&self, from: &Inclinations, sine: f32, cosine: f32) -> Vec4 {
        // exp(−½ |Δ|²/v) i(x)/(v (1 − e^(−2/v))): since 2 v sinh(1/v) = v e^(1/v) (1 − e^(−2/v)).
        let across = from.cosine - Vec4::splat(cosine);
        let along = from.sine + Vec4::splat(sine);
        let (extra, bessel) = bessel_i0(from.cosine * cosine * self.inverse);
        let exponent = (across * across + along * along) * self.inverse * -0.5 - extra;
        exp(exponent) * bessel * self.scale
    }

    /// sin θ of light that leaves in lobe `p`, distributed as M(θ) cos θ dθ. \[d'Eon 2013\]
    #[inline]
    pub(super) fn sample(&self, p: usize, from: &Inclinations, u: [f32; 2]) -> f32 {
        let rest = 1.0 - u[0];
        // 1 − cos of the angle from the mirror direction.
        let versine = (-self.variance[p] * ln((u[0] + rest * self.least[p]).max(1e-30))).min(2.0);
        let sine = (versine * (2.0 - versine)).max(0.0).sqrt();
        // A direction of the von Mises–Fisher lobe about the mirror direction; M is what is left of it along the fibre.
        let (_, turn) = sin_cos(core::f32::consts::TAU * u[1]);
        let along = (versine - 1.0) * from.sine[p] + sine * turn * from.cosine[p];
        along.clamp(-1.0, 1.0)
    }
}

/// Inclination from which light comes, tilted by the scales for each lobe; cosines are not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Inclinations {
    /// sin θ.
    pub(super) sine: Vec4,
    /// cos θ.
    pub(super) cosine: Vec4,
}

/// (y, i) with I0(x) = i e^(x − y): the modified Bessel function, x ≥ 0.
///
/// \[Abramowitz & Stegun\] 9.8.1 and 9.8.2, errors below 2e-7. Both are computed and one taken, so that
/// four can be done at once.
#[inline(always)]
fn bessel_i0(x: Vec4) -> (Vec4, Vec4) {
    const NEAR: [f32; 7] =
        [0.004_581_3, 0.036_076_8, 0.265_973_2, 1.206_749_2, 3.089_942_4, 3.515_622_9, 1.0];
    const FAR: [f32; 9] = [
        0.003_923_77,
        -0.016_476_33,
        0.026_355_37,
        -0.020_577_06,
        0.009_162_81,
        -0.001_575_65,
        0.002_253_19,
        0.013_285_92,
        0.398_942_3,
    ];
    let t = x * (1.0 / 3.75);
    let near = polynomial(t * t, NEAR);
    let large = x.max(Vec4::splat(3.75));
    let far = polynomial(3.75 / large, FAR) / large.sqrt();
    let is_near = x.cmplt(Vec4::splat(3.75));
    (Vec4::select(is_near, x, Vec4::ZERO), Vec4::select(is_near, near, far))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// I0 by its series, in f64.
    fn series(x: f64) -> f64 {
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..200 {
            term *= (x / 2.0 / f64::from(k)).powi(2);
            sum += term;
        }
        sum
    }

    #[test]
    fn bessel_function() {
        for i in 0..400_u16 {
            let x = f32::from(i) * 0.1;
            let (y, i0) = bessel_i0(Vec4::splat(x));
            let ours = f64::from(i0.x) * f64::from(x - y.x).exp();
            assert!((ours / series(f64::from(x)) - 1.0).abs() < 1e-6, "{x}");
        }
    }

    #[test]
    fn each_lobe_integrates_to_one_for_every_roughness() {
        for roughness in [0.05, 0.1, 0.3, 0.6, 1.0] {
            let m = Longitudinal::new(roughness);
            for theta in [0.0_f32, 0.5, -1.1, 1.5, core::f32::consts::FRAC_PI_2] {
                let from = Inclinations {
                    sine: Vec4::splat(theta.sin()),
                    cosine: Vec4::splat(theta.cos()),
                };
                let mut sum = [0.0_f64; 4];
                let n = 20_000_u16;
                for i in 0..n {
                    let step = core::f32::consts::PI / f32::from(n);
                    let (sine, cosine) = ((f32::from(i) + 0.5) * step).sin_cos();
                    // From −π/2 up: θ = π i/n − π/2.
                    for (sum, m) in sum.iter_mut().zip(m.values(&from, -cosine, sine).to_array()) {
                        *sum += f64::from(m * sine * step);
                    }
                }
                assert!(sum.iter().all(|s| (s - 1.0).abs() < 2e-3), "{roughness} {theta} {sum:?}");
            }
        }
    }
}
