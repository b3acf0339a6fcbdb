//! The elastics at the ends of braids and twists.

use frisure_rod::Equilibrium;
use rayon::prelude::*;

use super::accessory::Accessory;
use super::kind::AccessoryKind;
use super::mesh::{Axis, turned};
use super::place::clearance;
use super::ties::ring;
use crate::hairstyle::{Grip, Hairstyle, Mould};
use crate::head::Head;

/// Half of the width along the hair and of the thickness (m) of an elastic. Chosen: small rubber bands.
const BAND: [f64; 2] = [1.5e-3, 0.8e-3];

/// Length (m) of hair beyond an elastic, and the shortest hair that has one. Chosen.
const TAIL: f64 = 0.01;
const SHORTEST: f64 = 0.03;

/// Least radius (m) of the opening. Chosen: a thin lock.
const THINNEST: f64 = 8e-4;

/// Radius of an elastic over that of the lock as it is drawn: it presses hair together. Chosen.
const PRESSED: f64 = 0.7;

/// By how much openings are narrowed where skin is near. Chosen.
const NARROWED: [f64; 4] = [1.0, 0.75, 0.5, 0.3];

/// The elastics of a hairstyle, one for each wisp that is braided or twisted.
pub(super) fn elastics(hairstyle: &Hairstyle, head: &Head) -> Vec<Accessory> {
    // Radius of the skin that a wisp grows from (m).
    let count = hairstyle.guides().len() as f64;
    let patch = (hairstyle.placement.area() / count / std::f64::consts::PI).sqrt();
    let of = |wisp: usize| {
        let Grip::Mould { mould, .. } = hairstyle.wisps()[wisp].grip? else { return None };
        // A lock is no thicker than the braid or the twist that it is a part of.
        let most = match mould {
            Mould::Braid { width, .. } => 0.5 * width,
            Mould::Twist { radius, .. } => 2.0 * radius,
            Mould::Straight | Mould::Roller { .. } => return None,
        };
        let rest = &hairstyle.equilibria()[wisp];
        let s = rest.rod.length() - TAIL;
        let packed = hairstyle.guides()[wisp].thickness.packed(s);
        // Near the tip a wisp is drawn as wide as it is packed, but for the share of it that does not gather.
        let wisps = &hairstyle.spec().wisps;
        let drawn = (packed + (patch - packed) * (1.0 - wisps.clumping)) * wisps.profile[2];
        let opening = (PRESSED * drawn).clamp(THINNEST, most.max(THINNEST));
        (rest.rod.length() >= SHORTEST).then(|| elastic(wisp, rest, opening, head))?
    };
    (0..hairstyle.wisps().len()).into_par_iter().filter_map(of).collect()
}

/// The elastic about the end of a guide; none where skin leaves no room.
fn elastic(wisp: usize, rest: &Equilibrium, opening: f64, head: &Head) -> Option<Accessory> {
    let (centre, frame) = rest.at(&rest.chain(), 1.0 - TAIL / rest.rod.length());
    let axis = Axis { centre, direction: frame.z_axis };
    let [half_width, half_thickness] = BAND;
    NARROWED.into_iter().find_map(|narrowed| {
        let radius = (opening * narrowed).max(THINNEST);
        let mesh = turned(axis, &ring(radius + half_thickness, [half_thickness, half_width]))?;
        let (kind, wisps) = (AccessoryKind::Elastic, vec![wisp]);
        let (axis, length) = (axis.direction, 2.0 * half_width);
        (clearance(&mesh, head) > 0.0).then_some(Accessory {
            kind,
            wisps,
            centre,
            axis,
            radius,
            length,
            mesh,
        })
    })
}
