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
    Batch,
    Lanczos,
    Face,
    WetLock,
    CurlAlong,
    PartingSide,
    Scissors,
    Feature,
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

    /// Standard normal. (Box & Muller 1958)
    pub(crate) fn gaussian(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }

    /// Standard normal, cut at three deviations: no hair is a freak.
    pub(crate) fn normal(&mut self) -> f64 {
        self.gaussian().clamp(-3.0, 3.0)
    }

    /// A factor with mean 1 and this relative standard deviation: log-normal, never negative.
    pub(crate) fn positive(&mut self, deviation: f64) -> f64 {
        // exp(N(−σ²/2, σ²)) has the mean 1 and the relative variance e^(σ²) − 1, hence σ² = ln(1 + deviation²).
        let variance = (deviation * deviation).ln_1p();
        (self.normal() * variance.sqrt() - 0.5 * variance).exp()
    }

    /// A factor with median 1 and this relative standard deviation: log-normal, never negative.
    pub(crate) fn factor(&mut self, deviation: f64) -> f64 {
        (self.normal() * deviation).exp()
    }
}

/// What a batch of heads draws by chance: one stream for each thing that is drawn, by its name, and each head,
/// by its number, so that a draw depends on nothing else.
pub struct Draws(Stream);

impl Draws {
    /// The stream of a thing, such as `hair.length`, of the head with a number.
    #[must_use]
    pub fn new(seed: u64, name: &str, head: usize) -> Self {
        // FNV-1a: names need no more than to differ.
        let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let name = name.bytes().fold(0xcbf2_9ce4_8422_2325, step);
        Self(Stream::new(seed ^ name, Purpose::Batch, head))
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.between(low, high)
    }

    /// Standard normal.
    pub fn gaussian(&mut self) -> f64 {
        self.0.gaussian()
    }

    /// A number below `count`; all are as likely.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "less than count")]
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2⁵³")]
    pub fn one_of(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// A seed: any whole number below 2⁵³, which every program can hold.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "less than 2⁵³")]
    pub fn seed(&mut self) -> u64 {
        (self.unit() * 9_007_199_254_740_992.0) as u64
    }
}
