//! Hair of one head on another.

use std::sync::{Arc, Mutex};

use frisure_progress::Progress;
use frisure_rod::{InvalidQuantity, Rod, RodSpec, Root as Clamp};
use glam::DMat3;
use rayon::prelude::*;

use crate::equilibrium::{Effort, GuideStart, SettleOptions, settle};
use crate::guides::{Altitudes, Guide, Planned, covered};
use crate::hairstyle::{Hairstyle, RootPlacement, Styling};
use crate::head::{Correspondence, Corresponding, Head};
use crate::implantation::{Layout, Root, Scalp};
use crate::predict::PredictError;

/// The hair of a groom that was adopted on the head `from`, on the head `to`.
///
/// Roots go to the places of the other head that correspond to theirs by landmarks. Each guide keeps its length and its
/// natural strain; its clamp turns as the skin about its root does, the hair beneath it stays as high, and it comes to rest
/// on the other head. Each drawn hair keeps its shape relative to its guides. The number of hairs per area grows or shrinks
/// with the scalp.
///
/// # Errors
/// [`PredictError`], if the other scalp is too small for the guides, or the progress says to stop.
///
/// # Panics
/// If steps were applied to the hairstyle: what they did belongs to the first head.
pub fn transfer(
    hairstyle: &Hairstyle,
    from: &Head,
    to: &Head,
    progress: &dyn Progress,
) -> Result<Hairstyle, PredictError> {
    assert!(!hairstyle.is_styled(), "steps are applied after a transfer, not before it");
    let spec = hairstyle.spec.clone();
    let map = Correspondence::new(from, to);
    let moved = |roots: &[Root]| -> Vec<(Root, DMat3)> {
        let at = |root: &Root| {
            let Corresponding { position, normal, turn } = map.at(root.position, root.normal);
            (Root { position, normal }, turn)
        };
        roots.par_iter().map(at).collect()
    };
    let roots = moved(hairstyle.placement.roots());
    let hairs = moved(&hairstyle.placement.hairs(&spec, from));
    let grown = |head| Scalp::grown(head, &spec).area();
    let placement = RootPlacement {
        of: RootPlacement::key(&spec, to),
        area: hairstyle.placement.area() * grown(to) / grown(from),
        roots: roots.iter().map(|(root, _)| *root).collect(),
        hairs: Arc::new(Mutex::new(Some(hairs.into_iter().map(|(root, _)| root).collect()))),
        bound: hairstyle.placement.bound.clone(),
    };
    spec.wisps.check_size(placement.area())?;
    let layout = Layout::new(&spec, to)?;
    let altitudes = Altitudes::new(&spec, placement.roots());
    let guide = |(guide, (root, turn)): (&Guide, &(Root, DMat3))| {
        let rod = clamped(&guide.rod, *root, *turn)?;
        let planned = Planned { rod, curl: guide.curl, share: guide.share };
        let covered = covered(&spec, to, placement.area(), *root, altitudes.of(root), planned);
        Ok(Guide { bed: guide.bed.clone(), hold: guide.hold, ..covered })
    };
    let guides = hairstyle.guides.iter().zip(&roots).map(guide);
    let guides = guides.collect::<Result<Vec<_>, InvalidQuantity>>()?;
    let start = GuideStart::At(&hairstyle.rest.guides);
    let options = SettleOptions { start, effort: Effort::FULL, locks: Vec::new() };
    let rest = settle(&spec, to, &guides, options, progress)?;
    let styling = Styling::none(&guides);
    Ok(Hairstyle { spec, placement, layout, guides, rest, styling })
}

/// The same rod, clamped at another root, its frame turned.
fn clamped(rod: &Rod, root: Root, turn: DMat3) -> Result<Rod, InvalidQuantity> {
    let frame = turn * rod.root().frame();
    let clamp = Clamp::new(root.position, frame.x_axis, frame.y_axis, frame.z_axis)?;
    Rod::new(RodSpec { root: clamp, ..rod.spec().clone() })
}
