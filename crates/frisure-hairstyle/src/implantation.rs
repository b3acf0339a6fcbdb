//! How hair leaves the scalp: the direction along the skin and the angle to it.

use glam::{DQuat, DVec3};

use crate::head::{Head, Landmarks};
use crate::roots::Root;
use crate::spec::{Flow, Implantation, Lift};

/// The direction (unit) in which the hair of `root` leaves the scalp, without jitter.
pub(crate) fn direction(head: &Head, implantation: &Implantation, root: &Root) -> DVec3 {
    let along = along_skin(head.landmarks(), implantation.flow, root);
    let lift = lift(head.landmarks(), implantation.lift, root.position);
    (along * lift.cos() + root.normal * lift.sin()).normalize()
}

/// How far (m) a hair must be able to go straight before it meets skin again …
const CLEAR_PATH: f64 = 0.016;

/// … and how steeply (distance gained per length) it must leave meanwhile.
const CLEAR_SLOPE: f64 = 0.15;

/// Turns a direction (unit) away from skin that a hair would run into at once: hair rooted in front
/// of an ear does not grow into it.
pub(crate) fn clear_of_skin(head: &Head, root: &Root, direction: DVec3) -> DVec3 {
    const STEPS: i32 = 8;
    let mut direction = direction;
    for _ in 0..4 {
        let mut blocked = false;
        for step in 1..=STEPS {
            let s = CLEAR_PATH * f64::from(step) / f64::from(STEPS);
            let ahead = root.position + direction * s;
            let (distance, away) = head.signed_distance().value_gradient(ahead);
            let missing = CLEAR_SLOPE * s - distance;
            if missing > 0.0 {
                blocked = true;
                let turned = direction + away.normalize_or(root.normal) * (missing / s);
                direction = turned.normalize_or(root.normal);
            }
        }
        if !blocked {
            break;
        }
    }
    direction
}

/// The direction along the skin (unit, at right angles to the normal).
fn along_skin(marks: &Landmarks, flow: Flow, root: &Root) -> DVec3 {
    let wanted = match flow {
        Flow::Whorl => whorl(marks, root),
        Flow::Parted { offset } => parted(marks, offset, root),
        Flow::SweptBack => DVec3::new(0.0, 1.0, -0.8),
    };
    let tangent = |v: DVec3| v - root.normal * root.normal.dot(v);
    tangent(wanted)
        .try_normalize()
        .or_else(|| tangent(DVec3::Y).try_normalize())
        .unwrap_or_else(|| root.normal.any_orthonormal_vector())
}

/// Away from the crown, turning about it like a whorl near by and less far off.
fn whorl(marks: &Landmarks, root: &Root) -> DVec3 {
    let away = root.position - marks.whorl;
    let turn = 1.0 * (-away.length() / (0.35 * marks.width)).exp();
    DQuat::from_axis_angle(root.normal, -turn) * away
}

/// To both sides of the parting line from the hairline to the crown, and down behind it.
fn parted(marks: &Landmarks, offset: f64, root: &Root) -> DVec3 {
    let p = root.position;
    // 0 at the hairline, 1 at the whorl.
    let back = (p.y - marks.hairline.y) / (marks.whorl.y - marks.hairline.y).max(1e-3);
    let middle = marks.cranium_centre.x;
    let line = middle + offset * (1.0 - 0.5 * back.clamp(0.0, 1.0));
    // A line, not a jump: hair next to it stands up rather than crossing it.
    let side = ((p.x - line) / 0.004).tanh();
    let aside = DVec3::new(side, 0.8, -0.35);
    let down = DVec3::new(0.25 * (p.x - middle).signum(), 0.2, -1.0);
    let top = smooth(0.15, 0.75, marks.normalized(p).normalize_or(DVec3::Z).z);
    let behind = smooth(0.75, 1.25, back);
    let away = (p - marks.whorl).normalize_or(DVec3::Z);
    (down.normalize() * (1.0 - top) + aside.normalize() * top).lerp(away, behind * 0.8)
}

/// The direction to which curls lean as they leave the root: out of the skin and, where hair is
/// combed, back.
pub(crate) fn lean(flow: Flow, root: &Root) -> DVec3 {
    match flow {
        Flow::Whorl => root.normal,
        Flow::Parted { .. } | Flow::SweptBack => root.normal + DVec3::Y,
    }
}

/// The angle to the skin (rad).
fn lift(marks: &Landmarks, lift: Lift, p: DVec3) -> f64 {
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

/// Smooth step from 0 at `low` to 1 at `high`.
pub(crate) fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Purpose;
    use crate::roots::Scalp;

    #[test]
    fn hair_leaves_outwards_at_the_stated_angle() {
        let head = Head::mannequin();
        let roots = Scalp::new(&head).stratified(500, 1, Purpose::HairRoots);
        for flow in [Flow::Whorl, Flow::Parted { offset: 0.02 }, Flow::SweptBack] {
            let implantation = Implantation { flow, lift: Lift::Uniform(0.5), jitter: 0.0 };
            for root in &roots {
                let d = direction(&head, &implantation, root);
                assert!((d.dot(root.normal) - 0.5_f64.sin()).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_parting_parts() {
        let head = Head::mannequin();
        let implantation = Implantation {
            flow: Flow::Parted { offset: 0.0 },
            lift: Lift::Uniform(0.3),
            jitter: 0.0,
        };
        for x in [-0.02, 0.02] {
            let root = Root { position: DVec3::new(x, -0.04, 0.1), normal: DVec3::Z };
            assert!(direction(&head, &implantation, &root).x * x > 0.0);
        }
    }
}
