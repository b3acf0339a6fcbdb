//! The angle between hair and skin at the root.

use glam::DVec3;

use super::smooth;
use crate::head::Landmarks;
use crate::spec::Lift;

/// The angle to the skin (rad) at a point (m) of it.
pub(crate) fn angle(marks: &Landmarks, lift: Lift, p: DVec3) -> f64 {
    match lift {
        Lift::Uniform(angle) => angle,
        Lift::Regional { scale } => {
            (regional_degrees(marks, p) * scale).clamp(0.0, 90.0).to_radians()
        }
    }
}

/// Measured implantation angles (degrees to the skin): hairline 10–20, temples 3–10, mid-scalp 30,
/// rising to 60 at the crown. PHYSICS_NOTES, "Constants".
fn regional_degrees(marks: &Landmarks, p: DVec3) -> f64 {
    let up = marks.normalized(p).normalize_or(DVec3::Z).z;
    let reach = marks.width;
    let crown = 1.0 - smooth(0.08 * reach, 0.45 * reach, p.distance(marks.whorl));
    let front = 1.0 - smooth(0.05 * reach, 0.3 * reach, p.distance(marks.hairline));
    let sides_to_top = 7.0 + (30.0 - 7.0) * smooth(-0.2, 0.7, up);
    let with_crown = sides_to_top + (60.0 - sides_to_top) * crown;
    with_crown + (15.0 - with_crown) * front
}
