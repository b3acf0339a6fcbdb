//! How one drawn strand is bound to guides: which it follows, and how it differs from them.

use crate::implantation::Root;
use crate::random::Stream;
use crate::spec::Wisps;
use crate::wisps::BoundStrand;
use crate::wisps::{Split, Waves};

/// Standard deviation of the logarithm of a hair's own fuzziness. Chosen by eye; not measured.
const FUZZ_SPREAD: f64 = 0.5;

/// Factor on the deviation of a hair that leaves its wisp. docs/theory.md, "Wisps".
const STRAY: f64 = 2.5;

/// Amplitude of deviations per fuzziness, as a share of the spacing of guides. Chosen by eye; not measured.
const AMPLITUDE: f64 = 0.3;

/// Least length of a hair, as a share of its guides'. Chosen by eye; not measured.
const SHORTEST: f64 = 0.2;

/// Standard deviation of the drift: without fuzziness, and per fuzziness. Chosen by eye; not measured.
const DRIFT: (f64, f64) = (0.006, 0.06);

/// What makes one hair differ from its neighbours.
pub(super) struct StrandVariation {
    /// Length as a fraction of its guides'.
    pub(super) length: f64,
    /// Factor on the arc length at which it follows its guides: how its curl drifts.
    pub(super) drift: f64,
    /// Coherent deviation.
    pub(super) waves: Waves,
    /// Whether it leaves its wisp.
    stray: bool,
}

impl StrandVariation {
    pub(super) fn new(wisps: &Wisps, length: f64, spacing: f64, random: &mut Stream) -> Self {
        let stray = random.unit() < wisps.flyaways;
        let fuzz = wisps.fuzziness * random.factor(FUZZ_SPREAD) * if stray { STRAY } else { 1.0 };
        Self {
            waves: Waves::new(AMPLITUDE * fuzz * spacing, length, random),
            length: (1.0 - wisps.length_variation * random.normal().abs()).max(SHORTEST),
            drift: 1.0 + (DRIFT.0 + DRIFT.1 * wisps.fuzziness) * random.normal(),
            stray,
        }
    }

    /// The same without any deviation by chance.
    pub(super) fn without_deviation(self) -> Self {
        Self { drift: 1.0, waves: Waves::NONE, ..self }
    }
}

/// Where one hair goes.
pub(super) struct StrandBinding<'a> {
    pub(super) root: Root,
    /// Guides that it follows, with weights that sum to one; its own first.
    pub(super) followed: Vec<(usize, f64)>,
    pub(super) variation: StrandVariation,
    /// The thinner wisp that it belongs to.
    pub(super) split: Option<&'a Split>,
    /// Length of its guides (m).
    pub(super) length: f64,
    /// Length that they were planned with, and that they would have if they had never been cut (m):
    /// waves do not shrink when hair is cut, and what is left does not gather more.
    pub(super) planned: f64,
    pub(super) uncut: f64,
    /// Where it ends, in their length.
    pub(super) end: f64,
    /// Its length (m) when it is dry, and whether it has been cut.
    pub(super) dry: f64,
    pub(super) cut: bool,
    /// Factor on its diameter.
    pub(super) thickness: f64,
    /// Factor on how far it is from its guides, for hair that would be stretched by going round them
    /// that far out.
    pub(super) narrow: f64,
    /// Its own shape, if it is a groom's.
    pub(super) own: Option<BoundStrand>,
}

impl StrandBinding<'_> {
    /// Whether it leaves its wisp.
    pub(super) fn stray(&self) -> bool {
        self.variation.stray
    }

    /// Its own guide.
    pub(super) fn main(&self) -> usize {
        self.followed[0].0
    }
}
