//! How one drawn strand is bound to guides: which it follows, and how it differs from them.

use glam::DVec3;

use super::gathering::Gathering;
use super::winding::{OwnCurl, Winding};
use crate::implantation::Root;
use crate::random::Stream;
use crate::spec::Wisps;
use crate::wisps::BoundStrand;
use crate::wisps::Waves;

/// Standard deviation of the logarithm of a hair's own fuzziness. Chosen by eye; not measured.
const FUZZ_SPREAD: f64 = 0.5;

/// Factor on the deviation of a hair that leaves its wisp. docs/theory.md, "Wisps".
const STRAY: f64 = 2.5;

/// How far the curl of a hair that leaves its wisp is out of step, at least. Chosen by eye; not measured.
const STRAY_PHASE: f64 = 0.5;

/// Amplitude of deviations per fuzziness, as a share of the spacing of guides. Chosen by eye; not measured.
const AMPLITUDE: f64 = 0.3;

/// Least length of a hair, as a share of its guides'. Chosen by eye; not measured.
const SHORTEST: f64 = 0.2;

/// Standard deviation of the drift: without fuzziness, and per fuzziness. Chosen by eye; not measured.
const DRIFT: (f64, f64) = (0.006, 0.06);

/// Lengths of hairs that still grow, as shares of the length that others have: they are as likely to be of any age, and the
/// shortest are vellus-like and not seen. Chosen by eye; docs/theory.md, "Wisps".
const GROWING: (f64, f64) = (0.12, 1.0);

/// Factor on the deviation of a hair that still grows: it is carried by no others. Chosen by eye; not measured.
const GROWING_STRAY: f64 = 1.5;

/// What makes one hair differ from its neighbours.
pub(super) struct StrandVariation {
    /// Length as a fraction of its guides'.
    pub(super) length: f64,
    /// Factor on the arc length at which it follows its guides: how its curl drifts.
    pub(super) drift: f64,
    /// Coherent deviation.
    pub(super) waves: Waves,
    /// How its curl differs from that of the hairs that it goes with.
    pub(super) curl: OwnCurl,
    /// Whether it leaves its wisp.
    stray: bool,
    /// Whether it still grows towards the length of the others.
    pub(super) growing: bool,
}

impl StrandVariation {
    pub(super) fn new(wisps: &Wisps, length: f64, spacing: f64, random: &mut Stream) -> Self {
        let stray = random.unit() < wisps.flyaways;
        let growing = random.unit() < wisps.growing;
        let freedom = match (stray, growing) {
            (true, _) => STRAY,
            (_, true) => GROWING_STRAY,
            _ => 1.0,
        };
        let fuzz = wisps.fuzziness * random.factor(FUZZ_SPREAD) * freedom;
        let waves = Waves::new(AMPLITUDE * fuzz * spacing, length, random);
        let shorter = (1.0 - wisps.length_variation * random.normal().abs()).max(SHORTEST);
        let drift = 1.0 + (DRIFT.0 + DRIFT.1 * wisps.fuzziness) * random.normal();
        let phase = if stray { STRAY_PHASE.max(wisps.hair_phase) } else { wisps.hair_phase };
        let curl = OwnCurl::new(phase, wisps.radius_variation, random);
        let share = random.between(GROWING.0, GROWING.1);
        let length = if growing { shorter * share } else { shorter };
        Self { length, drift, waves, curl, stray, growing }
    }

    /// Whether it gathers with others.
    pub(super) fn gathers(&self) -> bool {
        !self.stray && !self.growing
    }

    /// The same without any deviation by chance.
    fn without_deviation(self) -> Self {
        Self { drift: 1.0, waves: Waves::NONE, curl: OwnCurl::GUIDE, ..self }
    }
}

/// Where one hair goes.
pub(super) struct StrandBinding<'a> {
    pub(super) root: Root,
    /// Guides that it follows, with weights that sum to one; its own first.
    pub(super) followed: Vec<(usize, f64)>,
    pub(super) variation: StrandVariation,
    /// How it curls.
    pub(super) winding: Winding,
    /// The thinner wisp that it gathers to.
    pub(super) split: Option<Gathering<'a>>,
    /// The lock that it gathers to if it is wet.
    pub(super) lock: Option<Gathering<'a>>,
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
    /// Most length (m) of its line, if it was cut to a length; else infinite.
    pub(super) most: f64,
    /// Factor on its diameter.
    pub(super) thickness: f64,
    /// Factor on how far it is from its guides, for hair that would be stretched by going round them
    /// that far out.
    pub(super) narrow: f64,
    /// Its own shape, if it is a groom's.
    pub(super) own: Option<BoundStrand>,
    /// How far (m) a hair of a groom is moved to begin at its root: on another head its guides are rooted elsewhere.
    pub(super) shift: DVec3,
}

/// How a hair curls that gathers to a split, or follows the guide `main` most, where its own curl differs from theirs.
pub(super) fn winding(split: Option<&Gathering<'_>>, main: usize, own: OwnCurl) -> Winding {
    match split {
        Some(Gathering { line, .. }) => Winding::new(line.winding.main, line.winding.curl.and(own)),
        None => Winding::new(main, own),
    }
}

impl StrandBinding<'_> {
    /// The same without any deviation by chance.
    pub(super) fn without_deviation(self) -> Self {
        let variation = self.variation.without_deviation();
        let winding = winding(self.split.as_ref(), self.followed[0].0, variation.curl);
        Self { variation, winding, ..self }
    }

    /// Whether it leaves its wisp.
    pub(super) fn stray(&self) -> bool {
        self.variation.stray
    }

    /// Its own guide.
    pub(super) fn main(&self) -> usize {
        self.followed[0].0
    }
}
