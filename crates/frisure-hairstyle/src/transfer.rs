//! Hair of one head on another.

use std::sync::{Arc, Mutex};

use frisure_progress::{Cancelled, Progress};
use frisure_rod::{InvalidQuantity, Rod, RodSpec, Root as Clamp};
use frisure_strands::Strands;
use glam::{DMat3, DQuat, Vec3};

use crate::equilibrium::{Effort, GuideStart, SettleOptions, settle};
use crate::guides::{Guide, Planned, covered};
use crate::hairstyle::{Hairstyle, RootPlacement, Styling};
use crate::head::{Correspondence, Corresponding, Head};
use crate::implantation::{Layout, Root, Scalp, Ways};
use crate::parallel;
use crate::predict::PredictError;
use crate::strands::{StrandOptions, strands};
use crate::wisps::{BoundStrand, BoundStrands, WISP_SAMPLES, Wisp};

/// The hair of a groom that was adopted on the head `from`, on the head `to`.
///
/// Roots go to the places of the other head that correspond to theirs by landmarks. Each guide keeps its length and its
/// natural strain; its clamp turns as the skin about its root does, the hair beneath it stays as high, and it comes to rest
/// on the other head. Each drawn hair goes along with its guides and keeps its length. The number of hairs per area grows or shrinks
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
        parallel::map_slice(roots, at)
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
    let ways = Ways::new(&spec, to, &layout);
    // What held hair where it was combed goes with the face.
    let faced = DQuat::from_rotation_arc(from.landmarks().face, to.landmarks().face);
    let guide = |(guide, (root, turn)): (&Guide, &(Root, DMat3))| {
        let rod = clamped(&guide.rod, *root, *turn)?;
        let planned = Planned { rod, curl: guide.curl, share: guide.share };
        let covered = covered(&spec, to, placement.area(), &ways, *root, planned);
        Ok(Guide { bed: guide.bed.clone(), hold: faced * guide.hold, ..covered })
    };
    let guides = hairstyle.guides.iter().zip(&roots).map(guide);
    let guides = guides.collect::<Result<Vec<_>, InvalidQuantity>>()?;
    let start = GuideStart::At(&hairstyle.rest.guides);
    let options = SettleOptions { start, effort: Effort::FULL, locks: Vec::new() };
    let rest = settle(&spec, to, &guides, options, progress)?;
    let styling = Styling::none(&guides);
    let mut transferred = Hairstyle { spec, placement, layout, guides, rest, styling };
    if let Some(bound) = hairstyle.placement.bound.as_deref() {
        transferred.placement.bound = rebound(bound, &transferred, to, progress)?.map(Arc::new);
    }
    Ok(transferred)
}

/// The drawn hairs as they lie on the other head, bound to the guides as they are there.
///
/// A hair goes along with up to three guides. Where these have moved in different ways the mean of what they make of it is shorter
/// or longer than the hair: curls out of step cancel. So each piece of it gets the length back that it had in the groom.
fn rebound(
    bound: &BoundStrands,
    transferred: &Hairstyle,
    to: &Head,
    progress: &dyn Progress,
) -> Result<Option<BoundStrands>, Cancelled> {
    let drawn = strands(transferred, to, StrandOptions::default(), progress)?.strands;
    let lines = parallel::map(drawn.len(), |hair| {
        as_long_as(&bound.strand(hair), drawn.strand(hair).points)
    });
    let mut hairs = Strands::with_capacity(lines.len(), drawn.points().len());
    for (line, strand) in lines.iter().zip(drawn.iter()) {
        hairs.push(line, strand.radii);
    }
    let wisps =
        parallel::map_slice(transferred.equilibria(), |guide| Wisp::new(guide, WISP_SAMPLES));
    Ok((!lines.is_empty()).then(|| BoundStrands::new(&hairs, wisps)))
}

/// A line with the directions of these points (m) and the distances that even points of a hair have.
fn as_long_as(own: &BoundStrand, points: &[Vec3]) -> Vec<Vec3> {
    let last = points.len().max(2) - 1;
    let at = |k: usize| own.at(own.length() * k as f64 / last as f64);
    let mut place = points[0];
    let mut line = vec![place];
    for (k, pair) in points.windows(2).enumerate() {
        let way = (pair[1] - pair[0]).normalize_or_zero();
        place += way * at(k).distance(at(k + 1)) as f32;
        line.push(place);
    }
    line
}

/// The same rod, clamped at another root, its frame turned.
fn clamped(rod: &Rod, root: Root, turn: DMat3) -> Result<Rod, InvalidQuantity> {
    let frame = turn * rod.root().frame();
    let clamp = Clamp::new(root.position, frame.x_axis, frame.y_axis, frame.z_axis)?;
    Rod::new(RodSpec { root: clamp, ..rod.spec().clone() })
}
