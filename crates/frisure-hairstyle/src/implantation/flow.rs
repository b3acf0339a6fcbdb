//! The direction of hair along the skin: a smooth field made of sources.
//!
//! Whorls turn it about themselves, partings push it to both sides, and between them it runs over
//! the forehead, down the sides and together at the nape. It is a vector along the skin, of length
//! 1 where all sources agree and shorter where they contradict each other: in the eye of a whorl, or
//! where two streams meet. There hair stands up, so that the direction in space stays smooth.

use glam::{DQuat, DVec3};

use super::parting::{Away, Partings};
use super::roots::Root;
use super::tape::Tape;
use crate::head::{Head, Landmarks};
use crate::math::smooth_step;
use crate::spec::{Comb, Flow, Turn, Whorls};

/// Distance (m) from a whorl within which hair stands up. docs/theory.md, "Roots and implantation".
const EYE: f64 = 0.012;

/// How far (rad) hair beside a whorl turns away from the radius. docs/theory.md, "Roots and implantation".
const SWIRL: f64 = 1.2;

/// Half the distance (m) between two whorls. Chosen by eye; not measured.
const PAIR: f64 = 0.022;

/// Where hair turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whorl {
    /// On the skin (m).
    pub(crate) centre: DVec3,
    /// Clockwise, seen from outside: 1; anticlockwise: −1.
    hand: f64,
}

/// The whorls of a head.
pub(crate) fn whorls(spec: &Whorls, head: &Head) -> Vec<Whorl> {
    let hand = if spec.turn == Turn::Clockwise { 1.0 } else { -1.0 };
    let crown = head.landmarks().whorl;
    if spec.count < 2 && spec.offset == [0.0; 2] {
        return vec![Whorl { centre: crown, hand }];
    }
    let tape = Tape::new(head);
    let [across, back] = [spec.offset[0], tape.back_of(crown) + spec.offset[1]];
    if spec.count < 2 {
        return vec![Whorl { centre: tape.at([across, back]), hand }];
    }
    // Mirror images, as most pairs are: the right one turns as a single one would.
    [(-PAIR, hand), (PAIR, -hand)]
        .map(|(aside, hand)| Whorl { centre: tape.at([across + aside, back]), hand })
        .to_vec()
}

/// Radius (m) about a whorl from which roots of drawn hair are gathered, and by which power of the distance: hair that leaves
/// on all sides covers its middle as well as the rest. Chosen by eye; not measured.
const GATHERED: (f64, f64) = (0.018, 0.8);

/// A point (m) of the skin, moved towards a whorl near by.
pub(crate) fn gathered(whorls: &[Whorl], p: DVec3) -> DVec3 {
    let (reach, power) = GATHERED;
    let near = |w: &&Whorl| w.centre.distance(p) < reach;
    whorls.iter().find(near).map_or(p, |whorl| {
        // d (d/R)^0.8: continuous at the border.
        let away = p - whorl.centre;
        whorl.centre + away * (away.length() / reach).powf(power)
    })
}

/// The flow at a root.
pub(crate) fn along_skin(
    marks: &Landmarks,
    flow: Flow,
    whorls: &[Whorl],
    partings: &Partings,
    root: &Root,
) -> DVec3 {
    let normal = root.normal;
    // The numbers below are shares and places in radii of the cranium (y backwards, z up), chosen by eye.
    let front = 1.0 - smooth_step(-0.4, 0.6, marks.normalized(root.position).y);
    let base = match flow {
        Flow::Whorl => natural(marks, whorls, root),
        Flow::Parted { .. } => along(DVec3::new(0.0, 0.15, -1.0), normal).lerp(back(normal), front),
        Flow::SweptBack => swept(normal),
    };
    let base = gathered_at_nape(marks, base, root);
    let Some(Away { along: away, distance, strength }) = partings.away(root.position, normal)
    else {
        return base;
    };
    let parted = matches!(flow, Flow::Parted { .. });
    let reach = marks.width * if parted { 0.5 } else { 0.22 };
    // It fades into the rest over a few centimetres, more where the whole head is parted.
    let pull = strength * (-(distance / reach).powi(2)).exp();
    // Beside the line hair leaves sideways, or it would fall back over it; farther off, and above the
    // forehead, it is combed back out of the face. Shares and distances (m) are chosen by how much hair lies over the face.
    let near = 0.5 + 0.4 * (1.0 - smooth_step(-0.85, -0.6, marks.normalized(root.position).y));
    let combed = match parted {
        true => {
            let beyond = near + (1.0 - near) * smooth_step(0.003, 0.015, distance);
            beyond * smooth_step(0.0, 0.006, distance)
        }
        false => 0.0,
    };
    let away = shortened(away + back(normal) * (1.9 * combed * front));
    base.lerp(away, pull)
}

/// The direction, along the skin, that a comb gives.
pub(crate) fn combed(comb: Comb, normal: DVec3) -> DVec3 {
    match comb {
        Comb::Forward => forward(normal),
        Comb::Back => back(normal),
        Comb::Down => along(DVec3::NEG_Z, normal),
        Comb::Left => along(DVec3::new(1.0, 0.0, -0.3), normal),
        Comb::Right => along(DVec3::new(-1.0, 0.0, -0.3), normal),
    }
}

/// As hair grows: away from the whorls, turning about each near by, then forward over the forehead
/// and down the sides.
fn natural(marks: &Landmarks, whorls: &[Whorl], root: &Root) -> DVec3 {
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for whorl in whorls {
        let away = root.position - whorl.centre;
        let distance = away.length().max(1e-9);
        // 1.2 rad · exp(−d/0.45 w) about the skin's normal, weighted by 1/d³. docs/theory.md, "Roots and implantation"
        let turn = SWIRL * (-distance / (0.45 * marks.width)).exp() * whorl.hand;
        let radial = (away - root.normal * root.normal.dot(away)).normalize_or_zero();
        let weight = distance.powi(-3);
        // The direction winds once about the whorl, so that in its eye there is none: it shrinks to zero there.
        let eye = smooth_step(0.0, EYE, distance);
        sum += DQuat::from_axis_angle(root.normal, -turn) * radial * (weight * eye);
        weights += weight;
    }
    // Far from the whorls what grows over the forehead and down the sides adds to it; shares and borders chosen by eye.
    let whorled = sum / weights.max(1e-12);
    let nearest = whorls.iter().map(|w| w.centre.distance(root.position));
    let far = smooth_step(0.3, 0.9, nearest.fold(f64::INFINITY, f64::min) / marks.width);
    let d = marks.normalized(root.position);
    let (front, low) = (1.0 - smooth_step(-0.8, 0.0, d.y), 1.0 - smooth_step(0.0, 0.7, d.z));
    let over_forehead = forward(root.normal) * (0.5 * front);
    let down = along(DVec3::new(0.0, 0.1, -1.0), root.normal) * (0.8 * low);
    shortened(whorled + (over_forehead + down) * far)
}

/// Towards the middle below the occiput, where the streams of both sides meet.
fn gathered_at_nape(marks: &Landmarks, flow: DVec3, root: &Root) -> DVec3 {
    let d = marks.normalized(root.position);
    let nape = (1.0 - smooth_step(-0.7, -0.3, d.z)) * smooth_step(0.0, 0.4, d.y);
    let inwards = DVec3::new((-2.5 * d.x).clamp(-1.0, 1.0), 0.0, -1.0);
    shortened(flow.lerp(along(inwards, root.normal), 0.8 * nape))
}

/// Back over the head, and behind the ears down.
fn back(normal: DVec3) -> DVec3 {
    let aside = normal.x * normal.x;
    shortened(along(normal.cross(DVec3::X) + DVec3::new(0.0, 0.8, -0.5) * aside, normal))
}

/// Back, and in front also to both sides: out of the face.
fn swept(normal: DVec3) -> DVec3 {
    // All of it but the very middle.
    // The sign of x, smoothed over a tenth of the radius.
    let side = normal.x / (normal.x.abs() + 0.1);
    let aside = DVec3::X * (1.2 * side * smooth_step(-0.2, 0.6, -normal.y));
    shortened(back(normal) + along(aside, normal))
}

/// Forward over the head and down the forehead.
fn forward(normal: DVec3) -> DVec3 {
    let aside = normal.x * normal.x;
    shortened(along(DVec3::X.cross(normal) + DVec3::new(0.0, -0.8, -0.5) * aside, normal))
}

/// The part of a vector along the skin, no longer than 1.
fn along(v: DVec3, normal: DVec3) -> DVec3 {
    shortened(v - normal * normal.dot(v))
}

fn shortened(v: DVec3) -> DVec3 {
    v / v.length().max(1.0)
}
