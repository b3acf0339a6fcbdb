//! Combs and clips that let go, in steps of their pull.

use super::start::{Change, GuideStart};
use crate::contact::Pull;
use crate::guides::Guide;
use crate::spec::{HairContact, HairstyleSpec};

/// How hard a comb or clip pulls in steps while it lets go: hair sinks to where it is let go.
/// Chosen by trial; not measured further.
pub(super) const LETTING_GO: [f64; 6] = [0.6, 0.35, 0.2, 0.1, 0.05, 0.02];

/// How hard what is gone pulls, in steps down to none.
pub(super) fn loads(gone: &[Option<Pull>]) -> Vec<f64> {
    let going: &[f64] = if gone.iter().any(Option::is_some) { &LETTING_GO } else { &[] };
    going.iter().copied().chain([0.0]).collect()
}

/// What lets go of each guide among the other wisps, which hold it: with friction between wisps a guide that lay there comes
/// to rest there, not alone. `None` where guides come to rest alone first.
pub(super) fn among_wisps(
    spec: &HairstyleSpec,
    guides: &[Guide],
    start: GuideStart<'_>,
) -> Option<Vec<Option<Pull>>> {
    let held = spec.contact.hair == HairContact::Wisps && spec.contact.friction > 0.0;
    let GuideStart::Changed { changes, .. } = start else { return None };
    let gone = |(guide, change): (&Guide, &Change)| match change {
        Change::LetGo(pull) if guide.pull.is_none() => Some(*pull),
        _ => None,
    };
    held.then(|| guides.iter().zip(changes).map(gone).collect())
}
