//! Strands as chains of short straight pieces, smooth enough for the screen.

use frisure_strands::{AttributeValues, Domain, Strand, Strands};
use glam::Vec3;
use rayon::prelude::*;

use super::projection::{NEAR, Projection};
use crate::scene::facial_hairs;

/// Greatest distance between a drawn chord and its curve (pixels); this and the next three are chosen by eye.
const FLATNESS: f32 = 0.25;
/// Greatest turn within a piece (rad): more would make highlights jump.
const MAX_TURN: f32 = 0.3;
/// Greatest length of a piece on the screen (pixels): it is sorted by depth as a whole.
const MAX_PIXELS: f32 = 16.0;
/// Greatest length of a piece (m).
const MAX_LENGTH: f32 = 0.006;
/// Most pieces for one segment of the input: a guard on time and memory.
const MAX_PIECES: u8 = 64;
/// Strands per parallel job; fixed, so that the work is cut the same way on any machine.
const CHUNK: usize = 512;

/// A point of a drawn curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) position: Vec3,
    /// Unit tangent, root to tip.
    pub(super) tangent: Vec3,
    /// Half of the drawn width (m).
    pub(super) half_width: f32,
    /// 0 dry, 1 wet.
    pub(super) wetness: f32,
    /// Index of the strand it belongs to.
    pub(super) strand: u32,
    /// Position on it, in points from its root.
    pub(super) place: f32,
}

pub(super) const NOWHERE: Vertex = Vertex {
    position: Vec3::ZERO,
    tangent: Vec3::Z,
    half_width: 0.0,
    wetness: 0.0,
    strand: u32::MAX,
    place: 0.0,
};

/// All drawn curves; vertices `i` and `i + 1` make a piece if they are of one strand.
pub(super) struct Curves {
    pub(super) vertices: Vec<Vertex>,
}

impl Curves {
    pub(super) fn new(strands: &Strands, view: &Projection, width_scale: f32) -> Self {
        let head_hairs = strands.len() - facial_hairs(strands);
        let chunks = strands.len().div_ceil(CHUNK);
        let range = |c: usize| c * CHUNK..((c + 1) * CHUNK).min(strands.len());
        let of_chunk = |c: usize| {
            let (mut count, mut pieces) = (0, Vec::new());
            for strand in range(c).map(|i| strands.strand(i)).filter(|s| drawable(*s)) {
                count += 1 + cut(strand, view, &mut pieces);
            }
            (count, pieces)
        };
        let cuts: Vec<(usize, Vec<u8>)> = (0..chunks).into_par_iter().map(of_chunk).collect();

        // By all threads: half of the time goes into getting the memory.
        let count = cuts.iter().map(|(count, _)| count).sum();
        let mut vertices: Vec<_> = rayon::iter::repeat_n(NOWHERE, count).collect();
        let mut slices = Vec::with_capacity(chunks);
        let mut rest = vertices.as_mut_slice();
        for (count, pieces) in cuts {
            let (slice, tail) = rest.split_at_mut(count);
            slices.push((slice, pieces));
            rest = tail;
        }
        let wetness = point_wetness(strands);
        slices.into_par_iter().enumerate().for_each(|(c, (slice, pieces))| {
            let (mut out, mut pieces) = (slice.iter_mut(), pieces.into_iter());
            for i in range(c) {
                let strand = strands.strand(i);
                if !drawable(strand) {
                    continue;
                }
                let start = strands.offsets()[i] as usize;
                let wet = wetness.map(|w| &w[start..start + strand.points.len()]);
                let scale = if i < head_hairs { width_scale } else { 1.0 };
                fill(strand, wet, i as u32, scale, &mut pieces, &mut out);
            }
        });
        Self { vertices }
    }

    /// Strand and position (points from the root) of each vertex.
    pub(super) fn places(&self) -> impl Iterator<Item = (u32, f32)> {
        let drawn = self.vertices.iter().filter(|v| v.strand != u32::MAX);
        drawn.map(|v| (v.strand, v.place))
    }

    /// The two ends of piece `index`, if there is such a piece.
    pub(super) fn piece(&self, index: usize) -> Option<(&Vertex, &Vertex)> {
        let (a, b) = (&self.vertices[index], self.vertices.get(index + 1)?);
        (a.strand == b.strand).then_some((a, b))
    }
}

/// The attribute `wetness`, if it is one scalar per point.
pub(super) fn point_wetness(strands: &Strands) -> Option<&[f32]> {
    let attribute = strands.attribute("wetness")?;
    match (attribute.domain, &attribute.values) {
        (Domain::Point, AttributeValues::F32(values)) => Some(values),
        _ => None,
    }
}

/// Whether a strand can be drawn at all.
fn drawable(strand: Strand<'_>) -> bool {
    strand.points.len() >= 2
        && strand.points.iter().all(|p| p.is_finite())
        && strand.radii.iter().all(|r| r.is_finite())
}

/// How many pieces stand for a strand; adds the number for each two of its points to the list.
fn cut(strand: Strand<'_>, view: &Projection, of_segments: &mut Vec<u8>) -> usize {
    let mut total = 0;
    let mut before = slope(strand.points, 0);
    for i in 0..strand.points.len() - 1 {
        let after = slope(strand.points, i + 1);
        let count = pieces(strand.points[i], strand.points[i + 1], [before, after], view);
        of_segments.push(count);
        total += usize::from(count);
        before = after;
    }
    total
}

/// Unit tangent of the curve at point `i`: that of the circle (nearly) through it and its neighbours.
fn slope(points: &[Vec3], i: usize) -> Vec3 {
    let chord = |a: usize| {
        let d = points[a + 1] - points[a];
        let h = d.length().max(1e-9);
        (d / h, h)
    };
    let last = points.len() - 1;
    let inner = |i: usize| {
        let ((d0, h0), (d1, h1)) = (chord(i - 1), chord(i));
        // Chords weighted by the length of the other: the tangent of the circle through the three points, to second order.
        (d0 * h1 + d1 * h0).normalize_or(d1)
    };
    // An arc leaves its chord at one end as it meets it at the other.
    let mirrored = |chord: Vec3, tangent: Vec3| 2.0 * chord.dot(tangent) * chord - tangent;
    match i {
        _ if last == 1 => chord(0).0,
        0 => mirrored(chord(0).0, inner(1)),
        _ if i < last => inner(i),
        _ => mirrored(chord(last - 1).0, inner(last - 1)),
    }
}

/// Calls `put` for each point of the strand's smooth curve, from root to tip: where it is in points from the
/// root (2.5 is in the middle between the third point and the fourth), its position (m) and its unit tangent.
///
/// `pieces` says how many straight pieces stand for the curve between two points at a distance (m) where it
/// turns by an angle (rad); 0 counts as 1. A strand with fewer than two points or with one that is not finite
/// has no curve.
pub fn smooth(
    strand: Strand<'_>,
    pieces: impl Fn(f32, f32) -> u32,
    mut put: impl FnMut(f32, Vec3, Vec3),
) {
    if !drawable(strand) {
        return;
    }
    trace(strand.points, |a, b, ends| pieces(a.distance(b), turn(ends)).max(1), &mut put);
}

/// Visits the smooth curve through `points`, of which there are at least two.
fn trace(
    points: &[Vec3],
    mut pieces: impl FnMut(Vec3, Vec3, [Vec3; 2]) -> u32,
    put: &mut impl FnMut(f32, Vec3, Vec3),
) {
    let unit = |slope: Vec3| slope.try_normalize().unwrap_or(Vec3::Z);
    let mut before = slope(points, 0);
    put(0.0, points[0], unit(before));
    for i in 0..points.len() - 1 {
        let (a, b) = (points[i], points[i + 1]);
        let ends = [before, slope(points, i + 1)];
        before = ends[1];
        let n = pieces(a, b, ends);
        let h = reach(a.distance(b), ends);
        for k in 1..=n {
            let x = k as f32 / n as f32;
            let (position, derivative) = hermite(a, b, ends[0] * h, ends[1] * h, x);
            put(i as f32 + x, position, unit(derivative));
        }
    }
}

/// Angle between two unit tangents (rad).
fn turn(ends: [Vec3; 2]) -> f32 {
    let turn = ends[0].angle_between(ends[1]);
    if turn.is_finite() { turn } else { 0.0 }
}

/// Length of the end derivatives that bends a cubic of chord `chord` and unit end tangents into the
/// arc of a circle: chord / cos²(turn / 4). Hair curls, and a Catmull-Rom spline would draw its
/// circles too small by a hundredth at eight points a turn.
fn reach(chord: f32, ends: [Vec3; 2]) -> f32 {
    // cos(t/2) by the half-angle formula, and 2/(1 + cos(t/2)) = 1/cos²(t/4).
    let half = (0.5 + 0.5 * ends[0].dot(ends[1])).clamp(0.0, 1.0).sqrt();
    chord * 2.0 / (1.0 + half)
}

/// How many straight pieces stand for the curve from `a` to `b` with slopes `ends`.
fn pieces(a: Vec3, b: Vec3, ends: [Vec3; 2], view: &Projection) -> u8 {
    let length = a.distance(b);
    let turn = turn(ends);
    let depth = (a.midpoint(b) - view.eye).dot(view.forward);
    let pixels = if depth > NEAR { length * view.focal / depth } else { 0.0 };
    // A chord of an arc of length l that turns by t lies l t / 8 off its middle.
    let flat = (pixels * turn / (8.0 * FLATNESS)).sqrt();
    let wanted = flat.max(turn / MAX_TURN).max(pixels / MAX_PIXELS).max(length / MAX_LENGTH);
    // The cast saturates.
    (wanted.ceil() as u8).clamp(1, MAX_PIECES)
}

/// Writes the vertices of one strand that can be drawn, with the next numbers of pieces.
fn fill<'a>(
    strand: Strand<'_>,
    wetness: Option<&[f32]>,
    index: u32,
    width_scale: f32,
    pieces: &mut impl Iterator<Item = u8>,
    out: &mut impl Iterator<Item = &'a mut Vertex>,
) {
    let wet = |i: usize| wetness.map_or(0.0, |w| portion(w[i]));
    let (points, radii) = (strand.points, strand.radii);
    let count = |_, _, _: [Vec3; 2]| pieces.next().map_or(1, u32::from);
    trace(points, count, &mut |place, position, tangent| {
        let (radius, wetness) = (along(place, |i| radii[i]), along(place, wet));
        if let Some(vertex) = out.next() {
            let half_width = radius.max(0.0) * width_scale;
            *vertex = Vertex { position, tangent, half_width, wetness, strand: index, place };
        }
    });
}

/// A value between those of the points around a place, which is in points from the root.
pub(super) fn along(place: f32, value: impl Fn(usize) -> f32) -> f32 {
    // The cast cuts off what is behind the point.
    let before = place as usize;
    let x = place - before as f32;
    let from = value(before);
    if x > 0.0 { from + (value(before + 1) - from) * x } else { from }
}

/// A part from 0 to 1; not-a-number is 0.
pub(super) fn portion(value: f32) -> f32 {
    if value.is_finite() { value.clamp(0.0, 1.0) } else { 0.0 }
}

/// Point and derivative at `x` ∈ [0, 1] of the cubic from `a` to `b` with derivatives `da`, `db`.
fn hermite(a: Vec3, b: Vec3, da: Vec3, db: Vec3, x: f32) -> (Vec3, Vec3) {
    let d = b - a;
    let (c2, c3) = (3.0 * d - 2.0 * da - db, da + db - 2.0 * d);
    (a + x * (da + x * (c2 + x * c3)), da + x * (2.0 * c2 + x * 3.0 * c3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coarse_circle_is_drawn_round() {
        let points: Vec<Vec3> = (0..=8)
            .map(|i| {
                let (s, c) = (i as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
                Vec3::new(0.1 * c, 0.0, 0.1 * s)
            })
            .collect();
        let mut strands = Strands::new();
        strands.push(&points, &[4e-5; 9]);
        let view = Projection::new(&frisure_look::Camera::default(), 1024, 1024);
        let curves = Curves::new(&strands, &view, 1.0);
        assert!(curves.vertices.len() > 50);
        for v in &curves.vertices {
            assert!((v.position.length() - 0.1).abs() < 2e-4, "{}", v.position.length());
            assert!(v.position.dot(v.tangent).abs() < 2e-4);
        }
    }

    #[test]
    fn strands_that_cannot_be_drawn_are_left_out() {
        let mut strands = Strands::new();
        strands.push(&[], &[]);
        strands.push(&[Vec3::ZERO], &[1e-5]);
        strands.push(&[Vec3::ZERO, Vec3::NAN], &[1e-5; 2]);
        strands.push(&[Vec3::ZERO, Vec3::X * 1e-3], &[1e-5, f32::INFINITY]);
        strands.push(&[Vec3::ZERO, Vec3::ZERO], &[1e-5; 2]);
        let view = Projection::new(&frisure_look::Camera::default(), 64, 64);
        let curves = Curves::new(&strands, &view, 1.0);
        assert_eq!(curves.vertices.len(), 2);
        assert!(curves.vertices.iter().all(|v| v.strand == 4 && v.tangent.is_finite()));
    }
}
