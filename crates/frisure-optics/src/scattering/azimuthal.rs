//! N: how a lobe spreads around the fibre.
//!
//! The logistic distribution trimmed to a turn, of Chiang et al. 2016, §4.1.

use core::f32::consts::{PI, TAU};

use super::exponential::exp4;

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
    /// From the roughness β_N in (0, 1], with the constants of `pbrt-v3`.
    pub(super) fn new(roughness: f32) -> Self {
        let b = roughness;
        let s = (PI / 8.0).sqrt() * (0.265 * b + 1.194 * b * b + 5.372 * b.powi(22));
        // Share above minus share below: 1/(1+e^(−π/s)) − 1/(1+e^(π/s)) = tanh(π/2s).
        let inside = (PI / (2.0 * s)).tanh();
        let below = 1.0 / (1.0 + (PI / s).exp());
        Self { scale: s, inverse: 1.0 / s, norm: 1.0 / (s * inside), inside, below }
    }

    /// Densities at azimuth `phi` of R, TT and TRT, centred at `centres` (rad), and of the rest.
    #[inline]
    pub(super) fn values(&self, centres: &[f32; 3], phi: f32) -> [f32; 4] {
        let mut e = [0.0; 4];
        for p in 0..3 {
            e[p] = -wrap(phi - centres[p]).abs() * self.inverse;
        }
        let e = exp4(e);
        let mut value = [1.0 / TAU; 4];
        for p in 0..3 {
            let sum = 1.0 + e[p];
            value[p] = self.norm * e[p] / (sum * sum);
        }
        value
    }

    /// Angle from a lobe's centre (rad), distributed as the lobe.
    pub(super) fn sample(&self, u: f32) -> f32 {
        let cumulative = u * self.inside + self.below;
        let x = -self.scale * (1.0 / cumulative.max(1e-30) - 1.0).max(1e-30).ln();
        x.clamp(-PI, PI)
    }
}

/// The same angle within [−π, π], for angles of a few turns.
#[inline(always)]
fn wrap(angle: f32) -> f32 {
    const ROUND: f32 = 12_582_912.0;
    let turns = (angle * (1.0 / TAU) + ROUND) - ROUND;
    angle - turns * TAU
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wraps() {
        for i in -40..40_i8 {
            let x = f32::from(i) * 0.3 + 0.01;
            let w = wrap(x);
            assert!(w.abs() <= PI + 1e-5);
            assert!((w.sin() - x.sin()).abs() < 1e-5 && (w.cos() - x.cos()).abs() < 1e-5);
        }
    }

    #[test]
    fn integrates_to_one_and_samples_follow() {
        for roughness in [0.05, 0.3, 0.7, 1.0] {
            let n = Azimuthal::new(roughness);
            let steps = 40_000_u16;
            let sum: f64 = (0..steps)
                .map(|i| TAU * (f32::from(i) + 0.5) / f32::from(steps))
                .map(|phi| f64::from(n.values(&[1.0, 2.0, 3.0], phi)[0]))
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
