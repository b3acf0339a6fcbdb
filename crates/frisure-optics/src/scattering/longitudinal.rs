//! M: how a lobe spreads along the fibre.
//!
//! d'Eon et al. 2011, eq. (7): the von Mises–Fisher distribution of variance v about the mirror
//! direction, averaged around the fibre,
//!
//! ```text
//! M(θi, θo) = exp(−sin θi sin θo / v) I0(cos θi cos θo / v) / (2 v sinh(1/v)),   ∫ M cos θo dθo = 1.
//! ```
//!
//! With I0(x) = e^x i(x) the exponents join to (cos(θi + θo) − 1)/v = −½ |Δ|²/v, where
//! Δ = (cos θi − cos θo, sin θi + sin θo). This neither overflows nor cancels for any v, so no
//! logarithms are needed where v is small.

use super::exponential::{exp, exp4};

/// The spread of the four lobes R, TT, TRT and the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Longitudinal {
    /// 1/v of each.
    inverse: [f32; 4],
    /// v of each.
    variance: [f32; 4],
    /// 1/(v (1 − e^(−2/v))) of each.
    scale: [f32; 4],
    /// e^(−2/v) of each.
    least: [f32; 4],
}

impl Longitudinal {
    /// From the roughness β_M in (0, 1]: Chiang et al. 2016, §4.1, as `pbrt-v3` has it.
    pub(super) fn new(roughness: f32) -> Self {
        let b = roughness;
        let v = (0.726 * b + 0.812 * b * b + 3.7 * b.powi(20)).powi(2);
        let variance = [v, 0.25 * v, 4.0 * v, 4.0 * v];
        let least = variance.map(|v| (-2.0 / v).exp());
        let mut scale = [0.0; 4];
        for p in 0..4 {
            scale[p] = 1.0 / (variance[p] * (1.0 - least[p]));
        }
        Self { inverse: variance.map(|v| 1.0 / v), variance, scale, least }
    }

    /// M of the four lobes for light leaving at (sin θ, cos θ), given the direction it came from as
    /// each lobe sees it.
    #[inline]
    pub(super) fn values(&self, from: &Inclinations, sine: f32, cosine: f32) -> [f32; 4] {
        let (mut exponent, mut bessel) = ([0.0; 4], [0.0; 4]);
        for p in 0..4 {
            let across = from.cosine[p] - cosine;
            let along = from.sine[p] + sine;
            let (extra, polynomial) = bessel_i0(from.cosine[p] * cosine * self.inverse[p]);
            exponent[p] = -0.5 * (across * across + along * along) * self.inverse[p] - extra;
            bessel[p] = polynomial * self.scale[p];
        }
        let mut value = exp4(exponent);
        for p in 0..4 {
            value[p] *= bessel[p];
        }
        value
    }

    /// sin θ of light that leaves in lobe `p`, distributed as M(θ) cos θ dθ (d'Eon et al. 2013).
    pub(super) fn sample(&self, p: usize, from: &Inclinations, u: [f32; 2]) -> f32 {
        let rest = 1.0 - u[0];
        // 1 − cos of the angle from the mirror direction.
        let versine = (-self.variance[p] * (u[0] + rest * self.least[p]).max(1e-30).ln()).min(2.0);
        let sine = (versine * (2.0 - versine)).max(0.0).sqrt();
        let turn = (core::f32::consts::TAU * u[1]).cos();
        let along = (versine - 1.0) * from.sine[p] + sine * turn * from.cosine[p];
        along.clamp(-1.0, 1.0)
    }
}

/// Inclination from which light comes, tilted by the scales for each lobe; cosines are not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Inclinations {
    /// sin θ.
    pub(super) sine: [f32; 4],
    /// cos θ.
    pub(super) cosine: [f32; 4],
}

/// (y, i) with I0(x) = i e^(x − y): the modified Bessel function, x ≥ 0.
///
/// Abramowitz & Stegun 9.8.1 and 9.8.2, errors below 2e-7. Both are computed and one taken, so that
/// four can be done at once.
#[inline(always)]
fn bessel_i0(x: f32) -> (f32, f32) {
    let t = (x / 3.75) * (x / 3.75);
    let near = 0.045_813e-1 * t + 0.036_076_8;
    let near = near * t + 0.265_973_2;
    let near = near * t + 1.206_749_2;
    let near = near * t + 3.089_942_4;
    let near = near * t + 3.515_622_9;
    let near = near * t + 1.0;
    let s = 3.75 / x.max(3.75);
    let far = 0.003_923_77 * s - 0.016_476_33;
    let far = far * s + 0.026_355_37;
    let far = far * s - 0.020_577_06;
    let far = far * s + 0.009_162_81;
    let far = far * s - 0.001_575_65;
    let far = far * s + 0.002_253_19;
    let far = far * s + 0.013_285_92;
    let far = far * s + 0.398_942_3;
    let far = far / x.max(3.75).sqrt();
    if x < 3.75 { (x, near) } else { (0.0, far) }
}

/// e^(−τ) of the three channels of three optical depths.
#[inline]
pub(super) fn transmittances(depths: [glam::Vec3; 3]) -> [glam::Vec3; 3] {
    depths.map(|d| glam::Vec3::new(exp(-d.x), exp(-d.y), exp(-d.z)))
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
            let (y, i0) = bessel_i0(x);
            let ours = f64::from(i0) * f64::from(x - y).exp();
            assert!((ours / series(f64::from(x)) - 1.0).abs() < 1e-6, "{x}");
        }
    }

    #[test]
    fn each_lobe_integrates_to_one_for_every_roughness() {
        for roughness in [0.05, 0.1, 0.3, 0.6, 1.0] {
            let m = Longitudinal::new(roughness);
            for theta in [0.0_f32, 0.5, -1.1, 1.5, core::f32::consts::FRAC_PI_2] {
                let from = Inclinations { sine: [theta.sin(); 4], cosine: [theta.cos(); 4] };
                let mut sum = [0.0_f64; 4];
                let n = 20_000_u16;
                for i in 0..n {
                    let step = core::f32::consts::PI / f32::from(n);
                    let (sine, cosine) = ((f32::from(i) + 0.5) * step).sin_cos();
                    // From −π/2 up: θ = π i/n − π/2.
                    for (sum, m) in sum.iter_mut().zip(m.values(&from, -cosine, sine)) {
                        *sum += f64::from(m * sine * step);
                    }
                }
                assert!(sum.iter().all(|s| (s - 1.0).abs() < 2e-3), "{roughness} {theta} {sum:?}");
            }
        }
    }
}
