//! The elastics at the ends of braids and twists.

use std::collections::BTreeMap;

use glam::DVec3;

use super::accessory::Accessory;
use super::kind::AccessoryKind;
use super::mesh::{Axis, turned};
use super::place::clearance;
use super::ties::ring;
use crate::contact::BraidPath;
use crate::hairstyle::{Grip, Hairstyle, Mould};
use crate::head::Head;
use crate::parallel;

/// Half of the width along the hair and of the thickness (m) of an elastic. Chosen: small rubber bands.
const BAND: [f64; 2] = [1.5e-3, 0.8e-3];

/// Length (m) of hair beyond an elastic, and the shortest hair that has one. Chosen.
const TAIL: f64 = 0.02;
const SHORTEST: f64 = 0.04;

/// Least radius (m) of the opening. Chosen: a thin lock.
const THINNEST: f64 = 8e-4;

/// Least radius (m) of a lock that has an elastic by itself: thinner ones have one together with others, or none. Chosen by eye.
const ALONE: f64 = 2.5e-3;

/// Radius of an elastic over that of the lock as it is drawn: it presses hair together. Chosen.
const PRESSED: f64 = 0.7;

/// By how much openings are narrowed where skin is near. Chosen.
const NARROWED: [f64; 4] = [1.0, 0.75, 0.5, 0.3];

/// The end of a lock.
struct End {
    wisp: usize,
    axis: Axis,
    /// Radius (m) of the lock.
    radius: f64,
    /// Radius (m) of the braid or the twist that it is a part of.
    most: f64,
}

impl End {
    fn of(hairstyle: &Hairstyle, wisp: usize, patch: f64) -> Option<Self> {
        let Grip::Mould { mould, .. } = hairstyle.wisps()[wisp].grip? else { return None };
        // A lock is no thicker than the braid or the twist that it is a part of.
        let most = match mould {
            Mould::Braid { width, .. } => 0.5 * width,
            Mould::Twist { radius, .. } => 2.0 * radius,
            Mould::Straight | Mould::Roller { .. } => return None,
        };
        let rest = &hairstyle.equilibria()[wisp];
        let length = rest.rod.length();
        if length < SHORTEST {
            return None;
        }
        let (centre, frame) = rest.at(&rest.chain(), 1.0 - TAIL / length);
        let packed = hairstyle.guides()[wisp].thickness.packed(length - TAIL);
        // Near the tip a wisp is drawn as wide as it is packed, but for the share of it that does not gather.
        let wisps = &hairstyle.spec().wisps;
        let drawn = (packed + (patch - packed) * (1.0 - wisps.clumping)) * wisps.profile[2];
        let radius = (PRESSED * drawn).clamp(THINNEST, most.max(THINNEST));
        Some(Self { wisp, axis: Axis { centre, direction: frame.z_axis }, radius, most })
    }
}

/// The elastics of a hairstyle: one for each lock, or for several whose ends lie together.
pub(super) fn elastics(hairstyle: &Hairstyle, head: &Head) -> Vec<Accessory> {
    // Radius of the skin that a wisp grows from (m).
    let count = hairstyle.guides().len() as f64;
    let patch = (hairstyle.placement.area() / count / std::f64::consts::PI).sqrt();
    let ends = parallel::map(hairstyle.wisps().len(), |wisp| End::of(hairstyle, wisp, patch));
    let ends: Vec<End> = ends.into_iter().flatten().collect();
    let mut taken = vec![false; ends.len()];
    let mut bundles: Vec<Vec<&End>> = Vec::new();
    for (i, end) in ends.iter().enumerate() {
        if taken[i] {
            continue;
        }
        let near = |other: &End| other.axis.centre.distance(end.axis.centre) <= end.most;
        let together: Vec<usize> =
            (i..ends.len()).filter(|&j| !taken[j] && near(&ends[j])).collect();
        together.iter().for_each(|&j| taken[j] = true);
        bundles.push(together.into_iter().map(|j| &ends[j]).collect());
    }
    let thick = |bundle: &&Vec<&End>| bundle.len() > 1 || bundle[0].radius >= ALONE;
    let small = bundles.iter().filter(thick).filter_map(|bundle| elastic(bundle, head));
    small.chain(braids(hairstyle, head)).collect()
}

/// Radius of the elastic of a tied braid over that of one of its locks: three locks pressed to one round bundle have √3. Chosen.
const BUNDLED: f64 = 1.7;

/// Step (m) along a braid in which its direction is taken. Chosen.
const DIRECTION: f64 = 1e-3;

/// The elastics at the ends of tails that are braided below a tie: one for each braid.
fn braids(hairstyle: &Hairstyle, head: &Head) -> Vec<Accessory> {
    let mut braids: BTreeMap<[u64; 3], (BraidPath, Vec<usize>)> = BTreeMap::new();
    for (wisp, state) in hairstyle.wisps().iter().enumerate() {
        if let Some(Grip::Braid { path, .. }) = state.grip {
            let key = path.middle.to_array().map(f64::to_bits);
            braids.entry(key).or_insert_with(|| (path, Vec::new())).1.push(wisp);
        }
    }
    let elastic = |(path, wisps): (BraidPath, Vec<usize>)| {
        let (centre, above) = (path.axis(path.end), path.axis(path.end - DIRECTION));
        let axis = Axis { centre, direction: (centre - above).normalize_or(DVec3::NEG_Z) };
        band(axis, BUNDLED * path.lock, 0.0, 2.0 * BAND[0], wisps, head)
    };
    braids.into_values().filter_map(elastic).collect()
}

/// The elastic about ends of locks; none where skin leaves no room.
fn elastic(ends: &[&End], head: &Head) -> Option<Accessory> {
    let count = ends.len() as f64;
    let centre = ends.iter().map(|end| end.axis.centre).sum::<DVec3>() / count;
    let direction = ends.iter().map(|end| end.axis.direction).sum::<DVec3>();
    let axis = Axis { centre, direction: direction.normalize_or(DVec3::NEG_Z) };
    let reach = |end: &&End| axis.split(end.axis.centre).1.length();
    let reach = ends.iter().map(reach).fold(0.0, f64::max);
    let opening = ends.iter().map(|end| end.radius).fold(reach, f64::max);
    let wisps: Vec<usize> = ends.iter().map(|end| end.wisp).collect();
    band(axis, opening, reach, BAND[0], wisps, head)
}

/// A band about an axis with an opening of a radius (m), narrower where skin is near but no narrower than `reach` (m), and so wide to either
/// side along the axis (m); none where skin leaves no room.
fn band(
    axis: Axis,
    opening: f64,
    reach: f64,
    half_width: f64,
    wisps: Vec<usize>,
    head: &Head,
) -> Option<Accessory> {
    let half_thickness = BAND[1];
    let (radius, mesh) = NARROWED.into_iter().find_map(|narrowed| {
        let radius = (opening * narrowed).max(reach).max(THINNEST);
        let mesh = turned(axis, &ring(radius + half_thickness, [half_thickness, half_width]))?;
        (clearance(&mesh, head) > 0.0).then_some((radius, mesh))
    })?;
    let Axis { centre, direction: axis } = axis;
    let (kind, length) = (AccessoryKind::Elastic, 2.0 * half_width);
    Some(Accessory { kind, wisps, centre, axis, radius, length, mesh })
}
