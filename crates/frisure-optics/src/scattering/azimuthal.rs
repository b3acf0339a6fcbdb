//! N: how a lobe spreads around the fibre.
//!
//! The logistic distribution trimmed to a turn, \[Chiang 2016\] §4.1.

use core::f32::consts::{PI, TAU};

use glam::Vec4;

use super::elementary::{exp, ln, wrap};

/// The spread of a lobe around the fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Azimuthal {
    /// Logistic scale s (rad).
    scale: f32,
    /// 1/s.
    inverse: f32,
    /// 1/(s k), k the share of the whole distribution that lies within the turn.
    norm: f32,
    /// k.
    inside: f32,
    /// Share of the whole distribution below −π.
    below: f32,
}

impl Azimuthal {
    /// The spread of the roughness β_N in (0, 1], with the constants of `pbrt-v3`.
    pub(super) fn new(roughness: f32) -> Self {
        let b = roughness;
        // The fit of [Chiang 2016] that makes β_N perceptually even. docs/theory.md, "Light in a fibre"
        let s = (PI / 8.0).sqrt() * (0.265 * b + 1.194 * b * b + 5.372 * b.powi(22));
        // Share above minus share below: 1/(1+e^(−π/s)) − 1/(1+e^(π/s)) = tanh(π/2s).
        let inside = (PI / (2.0 * s)).tanh();
        let below = 1.0 / (1.0 + (PI / s).exp());
        Self { scale: s, inverse: 1.0 / s, norm: 1.0 / (s * inside), inside, below }
    }

    /// Densities at azimuth `phi` of R, TT and TRT, centred at `centres` (rad), and of the rest.
    #[inline]
    pub(super) fn values(&self, centres: Vec4, phi: f32) -> Vec4 {
        // e^(−|x|/s)/(s (1 + e^(−|x|/s))²), with |x| so that the exponential cannot overflow; the rest is 1/2π.
        let e = exp(wrap(Vec4::splat(phi) - centres).abs() * -self.inverse);
        let sum = Vec4::ONE + e;
        (e * self.norm / (sum * sum)).with_w(1.0 / TAU)
    }

    /// Angle from a lobe's centre (rad), distributed as the lobe.
    pub(super) fn sample(&self, u: f32) -> f32 {
        // The inverse of the cumulative distribution 1/(1 + e^(−x/s)), of the part within the turn. The bound keeps the
        // logarithm finite at u = 0.
        let cumulative = u * self.inside + self.below;
        let x = -self.scale * ln((1.0 / cumulative.max(1e-30) - 1.0).max(1e-30));
        x.clamp(-PI, PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_to_one_and_samples_follow() {
        for roughness in [0.05, 0.3, 0.7, 1.0] {
            let n = Azimuthal::new(roughness);
            let steps = 40_000_u16;
            let sum: f64 = (0..steps)
                .map(|i| TAU * (f32::from(i) + 0.5) / f32::from(steps))
                .map(|phi| f64::from(n.values(Vec4::ONE, phi).x))
                .sum();
            assert!((sum * f64::from(TAU) / f64::from(steps) - 1.0).abs() < 1e-4, "{roughness}");
            // The cumulative share up to a sample is the random number it was made of.
            for u in [0.02_f32, 0.3, 0.5, 0.9] {
                let x = n.sample(u);
                let below = (1.0 / (1.0 + (-x * n.inverse).exp()) - n.below) / n.inside;
                assert!((below - u).abs() < 1e-4, "{roughness} {u} {below}");
            }
        }
    }
}
