//! Partings: curves on the scalp from which hair is combed away to both sides.

use glam::DVec3;

use super::tape::Tape;
use crate::head::{Head, Landmarks};
use crate::math::{segments_cross, smooth_step};
use crate::spec::Parting;

/// Length (m) of the pieces of a parting. Chosen by trial; not measured further.
const PIECE: f64 = 2.5e-3;

/// How far (m) a parting begins in front of the forehead's hairline, so that it parts the edge.
/// Chosen by eye; not measured.
const BEFORE: f64 = 6e-3;

/// Width and period (m) of a zigzag. Chosen by eye; not measured.
const ZIGZAG: (f64, f64) = (0.011, 0.026);

/// Where a straight parting ends, as a share of the way to the whorl. Chosen by eye; not measured.
const ENDING: f64 = 0.8;

/// Length (m) over which a parting fades before an end amid hair: a comb parts there less and less, and what it combs back lies
/// over the end. Chosen by eye; not measured.
const FADING: f64 = 0.03;

/// Farthest (m) from growing hair that a point of a parting may be. Chosen by trial; not measured further.
const OFF: f64 = 0.015;

/// A parting that is not where hair grows.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "parting {} leaves the scalp: at {} cm across, {} cm back no hair grows within 1.5 cm",
    index + 1, short(point[0]), short(point[1])
)]
pub struct PartingError {
    /// Which parting, from 0.
    pub index: usize,
    /// Which of its points, from 0, in a parting through points.
    pub place: usize,
    /// The point: across and back (m).
    pub point: [f64; 2],
}

fn short(metres: f64) -> f64 {
    (metres * 1e3).round() / 10.0
}

/// Width (m) of the strip beside a parting of which the drawn hair is gathered at the line, how much of it (m) is, and how near (m).
/// Chosen by eye: nowhere in the strip is the density below 0.75 of that elsewhere. docs/theory.md, "Roots and implantation".
const GATHERED: (f64, f64, f64) = (30e-3, 4.5e-3, 1e-3);

/// Distance (m) from the line within which hair is not moved, so that it stays on its side.
/// Chosen by trial; not measured further.
const SIDE: f64 = 1e-4;

/// The partings of one head.
#[derive(Clone, Debug)]
pub(crate) struct Partings(Vec<Line>);

/// A parting as a chain of short pieces on the skin.
#[derive(Clone, Debug)]
struct Line {
    points: Vec<DVec3>,
    /// How strongly each piece parts, 0 to 1: less towards an end amid hair.
    strengths: Vec<f64>,
    /// The same points on the map of the scalp.
    map: Vec<[f64; 2]>,
    /// Smallest and largest corner of the map's points.
    bounds: [[f64; 2]; 2],
}

/// What the partings of a head say about the hair at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Away {
    /// Along the skin away from them, no longer than 1 and shorter where they contradict each other.
    pub(crate) along: DVec3,
    /// To the nearest (m).
    pub(crate) distance: f64,
    /// How strongly they part there, 0 to 1.
    pub(crate) strength: f64,
}

impl Partings {
    pub(crate) fn new(partings: &[Parting], head: &Head) -> Result<Self, PartingError> {
        if partings.is_empty() {
            return Ok(Self(Vec::new()));
        }
        let tape = Tape::new(head);
        let lines = partings.iter().enumerate().map(|(index, parting)| {
            let corners = corners(parting, tape.back_of(head.landmarks().whorl));
            if let Parting::Through(_) = parting {
                check(index, &corners, &tape, head)?;
            }
            let smooth = !matches!(parting, Parting::Zigzag { .. });
            let mut line = dense(&corners, smooth);
            let mut amid = [false; 2];
            for end in &mut amid {
                line.reverse();
                *end = !extend(&mut line, &tape, head);
            }
            let points = line.iter().map(|&c| tape.at(c)).collect();
            Ok(Line::new(points, amid, head.landmarks()))
        });
        lines.collect::<Result<_, _>>().map(Self)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether the way along the skin from one point (m) to another near by crosses a parting.
    pub(crate) fn between(&self, marks: &Landmarks, a: DVec3, b: DVec3) -> bool {
        if self.0.is_empty() {
            return false;
        }
        let (a, b) = (map(marks, a), map(marks, b));
        self.0.iter().any(|line| line.crosses(a, b))
    }

    /// The direction along the skin away from the partings; none without partings.
    pub(crate) fn away(&self, p: DVec3, normal: DVec3) -> Option<Away> {
        let (mut sum, mut most, mut nearest) = (DVec3::ZERO, 0.0, f64::INFINITY);
        let mut strength = 0.0;
        for line in &self.0 {
            for (pair, part) in line.points.windows(2).zip(&line.strengths) {
                let d = p - closest(p, pair[0], pair[1]);
                let distance = d.length().max(1e-6);
                // Σ d |d|⁻⁴ over pieces: d/|d| · length/|d|³. A line of charges whose force falls fast enough for each side
                // to feel its own piece, and slowly enough to be smooth. docs/theory.md, "Roots and implantation"
                let weight = pair[0].distance(pair[1]) / distance.powi(3);
                sum += d / distance * weight;
                most += weight;
                strength += weight * part;
                nearest = nearest.min(distance);
            }
        }
        let along = sum - normal * normal.dot(sum);
        nearest.is_finite().then(|| {
            // Hair at the ends of a row of pieces leaves obliquely: what counts is the side.
            let agreement = (2.0 * along.length() / most).min(1.0);
            Away {
                along: along.normalize_or_zero() * agreement,
                distance: nearest,
                strength: strength / most,
            }
        })
    }

    /// A point (m) of the skin, moved towards a parting near by.
    pub(crate) fn gathered(&self, p: DVec3) -> DVec3 {
        let pieces = self.0.iter().flat_map(|line| line.points.windows(2).zip(&line.strengths));
        let nearest = pieces
            .map(|(w, strength)| (closest(p, w[0], w[1]), strength))
            .min_by(|a, b| a.0.distance_squared(p).total_cmp(&b.0.distance_squared(p)));
        let Some((on_line, strength)) = nearest else { return p };
        let distance = on_line.distance(p);
        if distance >= GATHERED.0 {
            return p;
        }
        let nearer = nearer(distance, *strength);
        on_line + (p - on_line).normalize_or_zero() * nearer.max(distance.min(SIDE))
    }

    /// The partings as chains of points on the skin (m).
    #[cfg(test)]
    pub(crate) fn lines(&self) -> impl Iterator<Item = &[DVec3]> {
        self.0.iter().map(|l| l.points.as_slice())
    }
}

/// The distance (m) from a parting of this strength to which hair is moved that grows at `distance` (m), both within the strip.
///
/// The x with `distance = x + S e (1 − exp(−x/a)) (1 − x/w)²`: what lies within x grows within `distance`, so that the density of hair is
/// the derivative of the right side, 1 + S e/a at the line and 1 at the border of the strip.
fn nearer(distance: f64, strength: f64) -> f64 {
    let (width, extra, near) = GATHERED;
    let grown =
        |x: f64| x + strength * extra * (1.0 - (-x / near).exp()) * (1.0 - x / width).powi(2);
    // The right side rises; 30 halvings of the strip are below a nanometre.
    let (mut low, mut high) = (0.0, distance);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if grown(middle) < distance { low = middle } else { high = middle }
    }
    high
}

impl Line {
    /// Of points on the skin (m); `amid` says whether each end lies amid hair.
    fn new(points: Vec<DVec3>, amid: [bool; 2], marks: &Landmarks) -> Self {
        let strengths = strengths(&points, amid);
        let map: Vec<_> = points.iter().map(|&p| map(marks, p)).collect();
        let pick = |f: fn(f64, f64) -> f64, start: f64| {
            map.iter().fold([start; 2], |[x, y], q| [f(x, q[0]), f(y, q[1])])
        };
        let bounds = [pick(f64::min, f64::INFINITY), pick(f64::max, f64::NEG_INFINITY)];
        Self { points, strengths, map, bounds }
    }

    fn crosses(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let [low, high] = self.bounds;
        let apart = |i: usize| a[i].max(b[i]) < low[i] || a[i].min(b[i]) > high[i];
        !apart(0) && !apart(1) && self.map.windows(2).any(|w| segments_cross(a, b, w[0], w[1]))
    }
}

/// How strongly each piece between points (m) parts: it fades over the last [`FADING`], or the last quarter, before an end amid hair.
fn strengths(points: &[DVec3], amid: [bool; 2]) -> Vec<f64> {
    let steps: Vec<f64> = points.windows(2).map(|w| w[0].distance(w[1])).collect();
    let whole: f64 = steps.iter().sum();
    // Most of a short parting parts in full. Chosen by eye.
    let fading = FADING.min(0.25 * whole);
    let mut gone = 0.0;
    let part = |step: &f64| {
        let middle = gone + 0.5 * step;
        gone += step;
        let ends = [middle, whole - middle].into_iter().zip(amid);
        ends.map(|(far, amid)| if amid { smooth_step(0.0, fading, far) } else { 1.0 }).product()
    };
    steps.iter().map(part).collect()
}

/// The scalp on a plane: angles from the vertical in every direction, equal along the meridians.
fn map(marks: &Landmarks, p: DVec3) -> [f64; 2] {
    let d = marks.normalized(p).normalize_or(DVec3::Z);
    let from_top = d.z.clamp(-1.0, 1.0).acos();
    let scale = from_top / d.x.hypot(d.y).max(1e-12);
    [d.x * scale, d.y * scale]
}

fn closest(p: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let along = b - a;
    a + along * ((p - a).dot(along) / along.length_squared().max(1e-18)).clamp(0.0, 1.0)
}

/// The corners of a parting, across and back (m), on a head whose whorl is `crown` (m) behind the
/// hairline.
fn corners(parting: &Parting, crown: f64) -> Vec<[f64; 2]> {
    match parting {
        &Parting::Straight { offset } => {
            // Towards the whorl, and not into it: hair leaves both, and would leave bare skin where they meet.
            vec![[offset, -BEFORE], [offset, 0.4 * crown], [0.6 * offset, ENDING * crown]]
        }
        &Parting::Zigzag { offset } => {
            let (width, period) = ZIGZAG;
            let turns = (2.0 * (crown + BEFORE) / period).round().max(2.0) as usize;
            let corner = |i: usize| {
                let side = if i.is_multiple_of(2) { 0.5 } else { -0.5 };
                [offset + side * width, -BEFORE + i as f64 / turns as f64 * (crown + BEFORE)]
            };
            (0..=turns).map(corner).collect()
        }
        Parting::Through(points) => points.clone(),
    }
}

fn check(
    index: usize,
    corners: &[[f64; 2]],
    tape: &Tape<'_>,
    head: &Head,
) -> Result<(), PartingError> {
    let grows = |p: DVec3| {
        let skin = head.surface().positions().iter().zip(head.scalp());
        // A third of the full density counts as growing. Chosen.
        skin.into_iter().any(|(q, &w)| w > 0.3 && q.distance(p) < OFF)
    };
    match corners.iter().position(|&c| !grows(tape.at(c))) {
        Some(place) => Err(PartingError { index, place, point: corners[place] }),
        None => Ok(()),
    }
}

/// Longest way (m) that a parting which ends near the edge of the hair is extended over it: no hair
/// falls forward between its end and the edge. docs/theory.md, "Roots and implantation".
const ONWARD: f64 = 0.02;

/// Extends a line past its last point until no hair grows, if that is near, and says whether it is.
fn extend(line: &mut Vec<[f64; 2]>, tape: &Tape<'_>, head: &Head) -> bool {
    let [.., before, last] = line.as_slice() else { return false };
    let way = [last[0] - before[0], last[1] - before[1]];
    let scale = PIECE / way[0].hypot(way[1]).max(1e-9);
    let onward = |i: usize| [0, 1].map(|x| last[x] + way[x] * scale * i as f64);
    let most = (ONWARD / PIECE) as usize;
    let edge = (0..=most).find(|&i| bald(head, tape.at(onward(i))));
    // Two more: the edge is not sharp.
    let more: Vec<_> = (1..=edge.map_or(0, |i| i + 2)).map(onward).collect();
    line.extend(more);
    edge.is_some()
}

/// Whether no hair grows at a point (m) of the skin.
fn bald(head: &Head, p: DVec3) -> bool {
    let skin = head.surface().positions().iter().zip(head.scalp());
    let nearest = skin.min_by(|a, b| a.0.distance_squared(p).total_cmp(&b.0.distance_squared(p)));
    nearest.is_none_or(|(_, &weight)| weight < 0.2)
}

/// Points a short piece apart: along a Catmull–Rom curve through the corners, or straight.
fn dense(corners: &[[f64; 2]], smooth: bool) -> Vec<[f64; 2]> {
    let Some(&first) = corners.first() else { return Vec::new() };
    let last = corners.len() - 1;
    let mut points = vec![first];
    for i in 0..last {
        let (b, c) = (corners[i], corners[i + 1]);
        let mirrored = |p: [f64; 2], q: [f64; 2]| [2.0 * p[0] - q[0], 2.0 * p[1] - q[1]];
        let a = if i > 0 { corners[i - 1] } else { mirrored(b, c) };
        let d = if i + 1 < last { corners[i + 2] } else { mirrored(c, b) };
        let steps = ((c[0] - b[0]).hypot(c[1] - b[1]) / PIECE).ceil().max(1.0) as usize;
        for k in 1..=steps {
            let t = k as f64 / steps as f64;
            let at = |x: usize| match smooth {
                true => catmull_rom([a[x], b[x], c[x], d[x]], t),
                false => b[x] + (c[x] - b[x]) * t,
            };
            points.push([at(0), at(1)]);
        }
    }
    points
}

fn catmull_rom([a, b, c, d]: [f64; 4], t: f64) -> f64 {
    b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
}
