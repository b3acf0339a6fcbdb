//! Hair ties, round the hair that they gather.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec3;

use super::accessory::Accessory;
use super::kind::AccessoryKind;
use super::mesh::{Axis, turned};
use super::place::{Piece, clearance, mean};
use crate::hairstyle::{Fastener, Grip, Hairstyle};
use crate::head::Head;
use crate::parallel;

/// Half of the width along the hair and of the thickness (m) of a tie: a band of two turns. Chosen: usual ones have 4 mm a turn.
const BAND: [f64; 2] = [4e-3, 2.5e-3];

/// Lengths (m) before and beyond the held place within which the tie is where the hair is tightest. Chosen: the hand puts it there.
const SEARCHED: [f64; 2] = [0.01, 0.02];

/// Room (m) along the hair beyond that, for guides that pass the plane of the tie aslant. Chosen.
const ASLANT: f64 = 0.02;

/// Steps (of a millimetre) between the places that are compared. Chosen.
const COMPARED: usize = 2;

/// Hair that passes farther from the middle than the median by this factor is not in the tie. Chosen: a round bundle has √2.
const STRAY: f64 = 2.0;

/// Most that the opening is wider than the guides in it. Chosen: a tie is tight.
const ROOM: f64 = 1.2;

/// The ties of a hairstyle.
pub(super) fn ties(hairstyle: &Hairstyle, head: &Head) -> Vec<Accessory> {
    let tie = |grip: &Grip| match *grip {
        Grip::Clip { at, by: Fastener::Tie { middle, .. }, .. } => Some((at, middle)),
        Grip::Braid { at, path } => Some((at, path.middle)),
        _ => None,
    };
    let bundles = bundles(hairstyle, tie, [SEARCHED[0] + ASLANT, SEARCHED[1] + ASLANT]);
    let ties = parallel::map_slice(&bundles, |pieces| band(pieces, head));
    let mut ties: Vec<Accessory> = ties.into_iter().flatten().collect();
    ties.sort_by(|a, b| a.wisps.cmp(&b.wisps));
    ties
}

/// The pieces of guides that are held together: those for which `held` has the same middle (m), at the part of their length that it has.
/// The pieces begin and end `around` (m) before and beyond that place.
pub(super) fn bundles(
    hairstyle: &Hairstyle,
    held: impl Fn(&Grip) -> Option<(f64, DVec3)>,
    around: [f64; 2],
) -> Vec<Vec<Piece>> {
    let mut bundles: BTreeMap<[u64; 3], Vec<Piece>> = BTreeMap::new();
    for (wisp, state) in hairstyle.wisps().iter().enumerate() {
        let Some((at, middle)) = state.grip.as_ref().and_then(&held) else { continue };
        let (rest, guide) = (&hairstyle.equilibria()[wisp], &hairstyle.guides()[wisp]);
        let thickness = guide.thickness.packed(at * rest.rod.length());
        let piece = Piece::new(wisp, rest, at, around, thickness);
        bundles.entry(middle.to_array().map(f64::to_bits)).or_default().push(piece);
    }
    bundles.into_values().collect()
}

/// A ring about an axis, and what it encloses.
struct Ring {
    axis: Axis,
    /// Radius of its opening (m).
    opening: f64,
    wisps: Vec<usize>,
}

impl Ring {
    /// The ring round pieces so many steps beyond their held places.
    fn round(pieces: &[Piece], steps: isize) -> Option<Self> {
        let mut axis = mean(pieces, steps);
        let places = |axis: &Axis| -> Vec<(DVec3, &Piece)> {
            pieces.iter().filter_map(|piece| Some((piece.through(axis)?, piece))).collect()
        };
        let passing = places(&axis);
        let count = passing.len().max(1) as f64;
        axis.centre = passing.iter().map(|(p, _)| *p).sum::<DVec3>() / count;
        let off = |p: DVec3| axis.split(p).1.length();
        let mut all: Vec<f64> = passing.iter().map(|(p, _)| off(*p)).collect();
        all.sort_by(f64::total_cmp);
        let most = STRAY * all.get(all.len() / 2)? + passing[0].1.thickness;
        let enclosed = passing.iter().filter(|(p, _)| off(*p) <= most);
        let reach = enclosed.clone().map(|(p, _)| off(*p)).fold(0.0, f64::max);
        // The hairs about the outermost guides are inside, as far as the tie does not press them in.
        let around = passing[0].1.thickness.min(BAND[1]);
        let opening = (reach + around).min(ROOM * reach).max(around);
        let wisps = enclosed.map(|(_, piece)| piece.wisp).collect();
        Some(Self { axis, opening, wisps })
    }

    fn accessory(
        self,
        [half_width, half_thickness]: [f64; 2],
        kind: AccessoryKind,
    ) -> Option<Accessory> {
        let Self { axis, opening, wisps } = self;
        let mesh = turned(axis, &ring(opening + half_thickness, [half_thickness, half_width]))?;
        let (centre, length) = (axis.centre, 2.0 * half_width);
        Some(Accessory { kind, wisps, centre, axis: axis.direction, radius: opening, length, mesh })
    }
}

/// The tie of a bundle: where hair is tightest, off the skin. None where skin leaves no room.
fn band(pieces: &[Piece], head: &Head) -> Option<Accessory> {
    let millimetres = |length: f64| (length / super::place::STEP) as isize;
    let places = (-millimetres(SEARCHED[0])..=millimetres(SEARCHED[1])).step_by(COMPARED);
    let tied = places.filter_map(|steps| {
        let tie = Ring::round(pieces, steps)?.accessory(BAND, AccessoryKind::Tie)?;
        (clearance(&tie.mesh, head) > 0.0).then_some(tie)
    });
    // Most hair first, then the tightest.
    tied.min_by(|a, b| b.wisps.len().cmp(&a.wisps.len()).then(a.radius.total_cmp(&b.radius)))
}

/// The profile of a ring: an ellipse at a distance (m) from the axis, by its semi-axes across it and along it (m).
pub(super) fn ring(radius: f64, [across, along]: [f64; 2]) -> Vec<[f64; 2]> {
    const CORNERS: usize = 16;
    let corner = |k: usize| {
        let (sine, cosine) = (TAU * k as f64 / CORNERS as f64).sin_cos();
        [radius + across * cosine, along * sine]
    };
    (0..CORNERS).map(corner).collect()
}
