//! The angle between hair and skin at the root.

use glam::DVec3;

use crate::head::Landmarks;
use crate::math::smooth_step;
use crate::spec::Lift;

/// The angle to the skin (rad) at a point (m) of it,
/// of which a comb has laid down a share of the hair, 0 to 1.
pub(crate) fn angle(marks: &Landmarks, lift: Lift, p: DVec3, combed: f64) -> f64 {
    match lift {
        Lift::Uniform(angle) => angle,
        Lift::Regional { scale } => {
            let most = 90.0 + (COMBED_MOST - 90.0) * combed;
            (regional_degrees(marks, p, combed) * scale).clamp(0.0, most).to_radians()
        }
    }
}

/// Angle (degrees) at the forehead's hairline where hair is combed: the lower end of the measured range.
const COMBED_HAIRLINE: f64 = 10.0;

/// Steepest angle (degrees) to the skin of combed hair, between the 60 measured at the crown and upright. Chosen by eye: at 90 long hair has
/// no side to fall to, and a tuft stands on the crown.
const COMBED_MOST: f64 = 70.0;

/// Measured implantation angles (degrees to the skin): hairline 10–20, temples 3–10, mid-scalp 30,
/// rising to 60 at the crown (docs/theory.md, "Roots and implantation").
fn regional_degrees(marks: &Landmarks, p: DVec3, combed: f64) -> f64 {
    // The means of the measured ranges, blended over distances in head widths that are chosen by eye.
    let up = marks.normalized(p).normalize_or(DVec3::Z).z;
    let reach = marks.width;
    let crown = 1.0 - smooth_step(0.08 * reach, 0.45 * reach, p.distance(marks.whorl));
    let front = 1.0 - smooth_step(0.05 * reach, 0.3 * reach, p.distance(marks.hairline));
    let sides_to_top = 7.0 + (30.0 - 7.0) * smooth_step(-0.2, 0.7, up);
    let with_crown = sides_to_top + (60.0 - sides_to_top) * crown;
    let hairline = 15.0 + (COMBED_HAIRLINE - 15.0) * combed;
    with_crown + (hairline - with_crown) * front
}

/// Distance (m) from a parting up to which a comb lays hair on the skin. docs/theory.md, "Roots and implantation".
const LAID: f64 = 0.03;

/// Angle to the skin (degrees) to which a comb lays hair beside a parting. docs/theory.md, "Roots and implantation".
const FLAT: f64 = 12.0;

/// The angle (rad) at `distance` (m) from a parting: there the comb has laid down what would stand.
pub(crate) fn laid_flat(angle: f64, distance: f64) -> f64 {
    let flat = angle.min(FLAT.to_radians());
    flat + (angle - flat) * smooth_step(0.3 * LAID, LAID, distance)
}

/// Steepest angle (rad) to which hair above the forehead is turned. Chosen by eye; not measured.
const STEEPEST: f64 = 1.4;

/// The angle (rad) of a fibre whose curl, not the fibre itself, is combed away from the face: above
/// the forehead a curl whose axis stood out would fall into it.
pub(crate) fn turned_back(marks: &Landmarks, angle: f64, lead: f64, p: DVec3) -> f64 {
    let front = 1.0 - smooth_step(-0.75, -0.25, marks.normalized(p).y);
    angle + ((angle + lead).min(STEEPEST).max(angle) - angle) * front
}

/// The angle (rad) between a fibre of this natural strain (rad/m) and the axis about which it
/// winds; 0 for waves too long to tell an axis.
pub(crate) fn lead(strain: DVec3) -> f64 {
    strain.truncate().length().atan2(strain.z.abs()) * curly(strain)
}

/// Lengths (m) of a turn up to which hair winds about an axis, and from which it only bends: a hand's breadth. Chosen by eye;
/// docs/theory.md, "Roots and implantation".
const CURLY: (f64, f64) = (0.06, 0.14);

/// Whether hair of this natural strain (rad/m) winds about an axis, 1, or turns so slowly that it
/// only bends, 0.
pub(crate) fn curly(strain: DVec3) -> f64 {
    let turn = std::f64::consts::TAU / strain.length().max(1e-9);
    1.0 - smooth_step(CURLY.0, CURLY.1, turn)
}
