//! Random starts of a minimiser, and random rods for experiments and tests.

use glam::DVec3;

/// The pseudorandom generator `SplitMix64` (Steele, Lea and Flood 2014): 64 bits of state, the same sequence on every
/// platform.
///
/// The equilibria that a search finds follow from this sequence. A better generator would change them and gain
/// nothing: a search draws a few numbers.
///
/// ```
/// use frisure_rod::SplitMix64;
///
/// let mut random = SplitMix64(7);
/// assert_eq!(random.unit(), 0.3898297483912715);
/// assert!(random.cube().abs().max_element() <= 1.0);
/// ```
#[derive(Clone, Debug)]
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Between two positive numbers, with a uniform logarithm.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// Uniform in the cube [−1, 1]³.
    pub fn cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - DVec3::ONE
    }

    /// Uniform on the unit sphere.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.cube();
            if v.length_squared() > 1e-4 && v.length_squared() < 1.0 {
                return v.normalize();
            }
        }
    }
}
