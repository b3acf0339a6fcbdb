//! Styles of regions: direction, angle, curl and length of hair on parts of the scalp.

use glam::DVec3;

use super::roots::Root;
use crate::head::{Head, Landmarks};
use crate::math::smooth_step;
use crate::spec::{Level, Place, RegionLength, RegionStyle};

/// How much a style holds at a point (m) of the skin: 1 inside its places, 0 outside, smooth over
/// about a centimetre at the border.
pub(crate) fn share(style: &RegionStyle, marks: &Landmarks, p: DVec3) -> f64 {
    let shares = marks.shares(p);
    // Left and right blend over 12 mm about the middle. Chosen by eye.
    let left = smooth_step(-0.006, 0.006, p.x - marks.cranium_centre.x);
    let sum: f64 = style
        .places
        .iter()
        .map(|place| match *place {
            Place::Everywhere => 1.0,
            Place::Left => left,
            Place::Right => 1.0 - left,
            Place::Region(region) => shares[region as usize],
            Place::LeftOf(region) => shares[region as usize] * left,
            Place::RightOf(region) => shares[region as usize] * (1.0 - left),
        })
        .sum();
    sum.min(1.0)
}

/// The last style that gives hair rooted at a point (m) a length of its own, if one does. Lengths
/// jump at borders: a fringe is cut, not faded.
pub(crate) fn cut_at(styles: &[RegionStyle], marks: &Landmarks, p: DVec3) -> Option<usize> {
    styles.iter().rposition(|s| s.length.is_some() && share(s, marks, p) > 0.5)
}

/// Height (m) of a level on a head.
pub(crate) fn height(level: Level, marks: &Landmarks) -> f64 {
    let face = marks.hairline.z - marks.brow.z;
    match level {
        Level::Brows => marks.brow.z,
        Level::Eyes => marks.brow.z - 0.35 * face,
        Level::Ears => marks.ear.z,
        // Hairline to brows is a third of the face; brows to chin is the rest.
        Level::Chin => marks.brow.z - 2.0 * face,
        Level::Nape => marks.nape.z,
        // By the built-in heads; a test measures them.
        Level::Shoulders => marks.cranium_centre.z - marks.width,
        Level::Chest => marks.cranium_centre.z - 1.6 * marks.width,
    }
}

/// Step (m) with which the way of hair down to a level is measured. Chosen by trial; not measured further.
const STEP: f64 = 3e-3;

/// Shortest and longest (m) that a level makes hair. Chosen by trial; not measured further.
const LENGTHS: (f64, f64) = (0.01, 0.6);

/// So many steps that lead hardly farther down than two, below the brows, lie on an ear.
/// Chosen by trial; not measured further.
const LYING: usize = 8;

/// Length (m) that a style gives hair that leaves `root` in a direction.
pub(crate) fn length(length: RegionLength, head: &Head, root: &Root, direction: DVec3) -> f64 {
    match length {
        RegionLength::Mean(length) => length,
        RegionLength::DownTo(level) => {
            down_to(height(level, head.landmarks()), head, root, direction)
        }
    }
}

/// The way (m) along the skin, or hanging where it overhangs, from a root down to a height (m).
fn down_to(height: f64, head: &Head, root: &Root, direction: DVec3) -> f64 {
    let (mut p, mut way, mut length) = (root.position, direction, 0.0);
    let (mut steps, mut before, brows) = (0, root.position.z, head.landmarks().brow.z);
    while p.z > height && length < LENGTHS.1 {
        let (distance, away) = head.signed_distance().value_gradient(p);
        let out = away.normalize_or(root.normal);
        // Weight bends it over: in eight steps (2.4 cm) as much as its own direction. Chosen by eye.
        way += DVec3::NEG_Z * 0.12;
        // Along the skin, where it would go into it.
        way -= out * out.dot(way).min(0.0) * f64::from(distance < 2.0 * STEP);
        // What leads away from the skin is halved each step: hair that stands up comes down.
        way -= out * (0.5 * out.dot(way).max(0.0));
        way = way.normalize_or(DVec3::NEG_Z);
        p += way * STEP;
        length += STEP;
        steps += 1;
        if steps % LYING == 0 {
            if p.z < brows && before - p.z < 2.0 * STEP {
                // Hair slides off and hangs from there.
                return length + (p.z - height).max(0.0);
            }
            before = p.z;
        }
    }
    length.max(LENGTHS.0)
}
