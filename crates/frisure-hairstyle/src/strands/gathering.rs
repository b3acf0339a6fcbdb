//! How a hair gathers to the line of a split or of a wet lock.

use super::locks::WetGathering;
use super::splits::SplitLine;

/// Which strands hair gathers to: the thinner wisps into which it splits, or locks of wet hair.
#[derive(Clone, Copy)]
pub(super) enum Tier {
    Splits,
    Locks,
}

/// A line that a hair gathers to.
pub(super) struct Gathering<'a> {
    pub(super) line: &'a SplitLine,
    /// Most of the way to it.
    pub(super) most: f64,
    /// How far along wet hair; none for splits.
    pub(super) wet: Option<WetGathering>,
}

impl Gathering<'_> {
    /// How much of the way to the line hair has come at the arc length `along` (m), where dry hair has come the share `gathered`
    /// of its way and `width` is the distance of hairs over that of their roots.
    pub(super) fn share(&self, along: f64, gathered: f64, width: f64) -> f64 {
        self.most * self.wet.map_or(gathered, |wet| wet.share(along, width))
    }
}
