//! All randomness comes from here: one stream per purpose and item, so that results depend neither
//! on threads nor on the order of the work.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// What a stream of random numbers is for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    GuideRoots = 1,
    GuideDirection,
    GuideFibre,
    HairRoots,
    Hair,
    Hairline,
    BabyHair,
    Split,
    GrownCurl,
    HairFibre,
}

/// A stream of random numbers.
pub(crate) struct Stream(Pcg64Mcg);

impl Stream {
    pub(crate) fn new(seed: u64, purpose: Purpose, item: usize) -> Self {
        // PCG's seeding scrambles, so that neighbouring items have unrelated streams.
        let mixed = seed
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .wrapping_add(purpose as u64)
            .wrapping_mul(0xd134_2543_de82_ef95)
            .wrapping_add(item as u64);
        Self(Pcg64Mcg::seed_from_u64(mixed))
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0.random()
    }

    /// Uniform between two numbers.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Standard normal, cut at three deviations: no hair is a freak. (Box & Muller 1958)
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        (radius * (std::f64::consts::TAU * self.unit()).cos()).clamp(-3.0, 3.0)
    }

    /// A factor with mean 1 and this relative standard deviation: log-normal, never negative.
    pub(crate) fn positive(&mut self, deviation: f64) -> f64 {
        let variance = (deviation * deviation).ln_1p();
        (self.normal() * variance.sqrt() - 0.5 * variance).exp()
    }

    /// A factor with median 1 and this relative standard deviation: log-normal, never negative.
    pub(crate) fn factor(&mut self, deviation: f64) -> f64 {
        (self.normal() * deviation).exp()
    }
}
