//! Strands as smooth round curves, cut into straight pieces.

use std::ops::Range;

use frisure_strands::{Strand, Strands};
use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::AccelError;
use super::aabb::Aabb;
use super::error::FARTHEST;
use super::node::Primitive;

/// How curves are cut into straight pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveOptions {
    /// Longest piece (m), of which segments just above it may have three tenths more. Shorter pieces
    /// have tighter boxes, but there are more of them.
    pub longest_piece: f32,
    /// Farthest that a piece may lie beside the curve (m).
    pub tolerance: f32,
}

impl Default for CurveOptions {
    fn default() -> Self {
        Self { longest_piece: 4e-3, tolerance: 1e-4 }
    }
}

/// Most pieces of one segment: what a byte holds.
const MOST_PIECES: f32 = 255.0;

/// Largest second derivative over a piece, in tolerances: 8 for chords of the curve, 16 for pieces
/// moved outwards by half; between, since segments that bend differently share their joints.
const BEND: f32 = 12.0;

/// Part of the longest piece by which a piece may be longer before it is cut in two; chosen by trial.
const LONGER: f32 = 0.3;

/// Stride in points at which the strand of a point is stored. Chosen: memory against a short walk.
const STRIDE: usize = 32;

/// Shortest piece worth a box, in tenths, and smallest radius (m).
const TINY: f32 = 1e-7;

/// Largest radius (m): whatever is thicker is no hair, but a slip of units. Chosen.
const THICKEST: f32 = 0.01;

/// How far a piece reaches beyond its ends, in radii. It closes the wedge on the outer side of a
/// joint bent by β, r tan(β/2) wide, up to β = 0.5; on the inner side it lies within the next piece.
pub(super) const REACH: f32 = 0.25;

/// Strands as smooth curves: Catmull–Rom splines through the points, the ends extrapolated, with a
/// radius that is linear between points.
///
/// Kept are the points, and for each segment (from a point to the next) the number of equal steps of
/// the spline's parameter that the straight *pieces* make: no longer and no farther beside the curve
/// than [`CurveOptions`] allows. Their ends lie outside the curve as far as their middles lie inside,
/// so that fewer are needed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curves {
    /// Points and radii, one strand after another.
    points: Vec<Vec4>,
    /// Strand of every [`STRIDE`]th point.
    strand: Vec<u32>,
    /// First point of each strand, and the number of points at the end.
    offsets: Vec<u32>,
    /// Number of pieces from each point to the next; none at a tip.
    pieces: Vec<u8>,
}

/// A straight piece: a truncated cone about the axis from `start` to `start + axis`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Start of the axis (m).
    pub(super) start: Vec3,
    /// Along the axis, to its end (m).
    pub(super) axis: Vec3,
    /// Radius at the start (m).
    pub(super) radius: f32,
    /// Radius at the end minus that at the start (m).
    pub(super) widening: f32,
    /// Where it comes from.
    pub(super) name: PieceName,
}

/// Index of the point at which a segment begins, and number of the piece in the segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PieceName {
    pub(super) point: u32,
    pub(super) number: u8,
}

/// How far the box of a piece reaches beyond its axis, in radii: √(1 + REACH²), and a little for the
/// change of radius in the reach.
const BESIDE: f32 = 1.05;

impl Curves {
    /// Checks and takes over strands. Strands with fewer than two points are nowhere.
    pub(super) fn new(strands: &Strands, options: &CurveOptions) -> Result<Self, AccelError> {
        check_options(options)?;
        let count = strands.points().len();
        let points = strands.points().iter().zip(strands.radii());
        let mut curves = Self {
            points: points.map(|(p, &r)| p.extend(r)).collect(),
            strand: Vec::with_capacity(count / STRIDE + 1),
            offsets: strands.offsets().to_vec(),
            pieces: Vec::with_capacity(count),
        };
        let mut total = 0;
        for (index, strand) in strands.iter().enumerate() {
            check_strand(index, &strand)?;
            total += curves.count_pieces(index, options);
            if total > 1 << 31 {
                return Err(AccelError::TooMany { strand: index });
            }
        }
        Ok(curves)
    }

    fn count_pieces(&mut self, index: usize, options: &CurveOptions) -> usize {
        let range = self.range(index);
        let before = self.pieces.len();
        for point in range.clone() {
            if point.is_multiple_of(STRIDE) {
                self.strand.push(index as u32);
            }
            let tip = point + 1 == range.end;
            let pieces = if tip { 0 } else { self.spline(&range, point).pieces(options) };
            self.pieces.push(pieces);
        }
        self.pieces[before..].iter().map(|&n| usize::from(n)).sum()
    }

    /// Points of a strand.
    fn range(&self, strand: usize) -> Range<usize> {
        self.offsets[strand] as usize..self.offsets[strand + 1] as usize
    }

    /// Strand of a point.
    fn strand_of(&self, point: usize) -> usize {
        let mut strand = self.strand[point / STRIDE] as usize;
        while self.offsets[strand + 1] as usize <= point {
            strand += 1;
        }
        strand
    }

    /// The spline from point `point` to the next, both in the strand of this range.
    fn spline(&self, range: &Range<usize>, point: usize) -> Spline {
        let [b, c] = [self.points[point], self.points[point + 1]];
        // At the ends the missing neighbour is the mirror image: the curve starts along its first chord.
        let a = if point > range.start { self.points[point - 1] } else { 2.0 * b - c };
        let d = if point + 2 < range.end { self.points[point + 2] } else { 2.0 * c - b };
        Spline { a: a.truncate(), b: b.truncate(), c: c.truncate(), d: d.truncate() }
    }

    /// Strand and segment in the strand of the segment that begins at `point`.
    pub(super) fn segment(&self, point: u32) -> (u32, u32) {
        let strand = self.strand_of(point as usize);
        (strand as u32, point - self.offsets[strand])
    }

    /// Parameter of the segment, 0 to 1, at `s` (0 to 1) along one of its pieces.
    pub(super) fn parameter(&self, name: PieceName, s: f32) -> f32 {
        (f32::from(name.number) + s) / f32::from(self.pieces[name.point as usize])
    }

    /// Unit tangent of the smooth curve at parameter `u` of a segment of a strand, towards the tip;
    /// `None` at a cusp.
    pub(super) fn tangent(&self, strand: u32, point: u32, u: f32) -> Option<Vec3> {
        self.spline(&self.range(strand as usize), point as usize).velocity(u).try_normalize()
    }

    /// Name of the piece behind one; that of the tip behind the last.
    fn after(&self, name: PieceName) -> PieceName {
        if name.number + 1 < self.pieces[name.point as usize] {
            PieceName { number: name.number + 1, ..name }
        } else {
            PieceName { point: name.point + 1, number: 0 }
        }
    }

    /// Start and end of a piece, with radii.
    pub(super) fn ends(&self, name: PieceName) -> [Vec4; 2] {
        let range = self.range(self.strand_of(name.point as usize));
        [name, self.after(name)].map(|name| self.vertex(&range, name))
    }

    /// The start of a piece, with its radius; a tip has a name, too.
    fn vertex(&self, range: &Range<usize>, name: PieceName) -> Vec4 {
        let point = name.point as usize;
        let count = f32::from(self.pieces[point]);
        if name.number == 0 {
            let before = (point > range.start).then(|| {
                let steps = f32::from(self.pieces[point - 1]);
                self.spline(range, point - 1).outwards(1.0, steps)
            });
            let behind =
                (point + 1 < range.end).then(|| self.spline(range, point).outwards(0.0, count));
            let aside = match (before, behind) {
                (Some(a), Some(b)) => 0.5 * (a + b),
                (a, b) => a.or(b).unwrap_or_default(),
            };
            return self.points[point] + aside.extend(0.0);
        }
        let u = f32::from(name.number) / count;
        let spline = self.spline(range, point);
        let [r0, r1] = [self.points[point].w, self.points[point + 1].w];
        (spline.at(u) + spline.outwards(u, count)).extend(r0 + (r1 - r0) * u)
    }

    /// All pieces, as boxes with their names, in the order of the points; those without length (at a
    /// cusp) are left out.
    pub(super) fn boxes(&self) -> Vec<Primitive> {
        let strands = self.offsets.len().saturating_sub(1);
        (0..strands).into_par_iter().flat_map_iter(|strand| self.boxes_of(strand)).collect()
    }

    fn boxes_of(&self, strand: usize) -> impl Iterator<Item = Primitive> {
        let range = self.range(strand);
        let names = range.clone().flat_map(|point| {
            (0..self.pieces[point]).map(move |number| PieceName { point: point as u32, number })
        });
        let mut before: Option<Vec4> = None;
        names.filter_map(move |name| {
            let start = before.unwrap_or_else(|| self.vertex(&range, name));
            let end = self.vertex(&range, self.after(name));
            before = Some(end);
            let long = start.truncate().distance(end.truncate()) > 0.1 * TINY;
            let (low, high) = (start.min(end).truncate(), start.max(end).truncate());
            let bounds = Aabb { low: low.into(), high: high.into() };
            let bounds = bounds.grown(BESIDE * start.w.max(end.w));
            long.then(|| Primitive::new(bounds, name.point, u32::from(name.number)))
        })
    }

    /// Number of pieces.
    pub(super) fn count(&self) -> usize {
        self.pieces.iter().map(|&n| usize::from(n)).sum()
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.points[..])
            + size_of_val(&self.strand[..])
            + size_of_val(&self.offsets[..])
            + size_of_val(&self.pieces[..])
    }
}

fn check_options(options: &CurveOptions) -> Result<(), AccelError> {
    let named = [("longest_piece", options.longest_piece), ("tolerance", options.tolerance)];
    match named.into_iter().find(|&(_, value)| !(value > 1e-6)) {
        Some((option, value)) => Err(AccelError::Option { option, value }),
        None => Ok(()),
    }
}

fn check_strand(index: usize, strand: &Strand<'_>) -> Result<(), AccelError> {
    for (point, (&position, &radius)) in strand.points.iter().zip(strand.radii).enumerate() {
        if !(position.is_finite() && position.abs().max_element() <= FARTHEST) {
            return Err(AccelError::Position { strand: index, point, position });
        }
        if !(TINY..=THICKEST).contains(&radius) {
            return Err(AccelError::Radius { strand: index, point, radius });
        }
    }
    Ok(())
}

/// A uniform Catmull–Rom spline from `b` to `c`.
#[derive(Clone, Copy, Debug)]
struct Spline {
    a: Vec3,
    b: Vec3,
    c: Vec3,
    d: Vec3,
}

impl Spline {
    /// Coefficients of u, u² and u³.
    fn coefficients(&self) -> [Vec3; 3] {
        let Self { a, b, c, d } = *self;
        [0.5 * (c - a), a - 2.5 * b + 2.0 * c - 0.5 * d, 1.5 * (b - c) + 0.5 * (d - a)]
    }

    fn at(&self, u: f32) -> Vec3 {
        // Exactly the points at the ends, so that pieces of neighbouring segments meet.
        if u >= 1.0 {
            return self.c;
        }
        let [first, second, third] = self.coefficients();
        self.b + u * (first + u * (second + u * third))
    }

    fn velocity(&self, u: f32) -> Vec3 {
        let [first, second, third] = self.coefficients();
        first + u * (2.0 * second + 3.0 * u * third)
    }

    fn acceleration(&self, u: f32) -> Vec3 {
        let [_, second, third] = self.coefficients();
        2.0 * second + 6.0 * u * third
    }

    /// From the curve to where pieces over 1/`count` of the parameter meet: half as far as a chord's
    /// middle would lie inside.
    fn outwards(&self, u: f32, count: f32) -> Vec3 {
        // |r″|/8n² for the middle of a chord, half of it the other way.
        self.acceleration(u) / (-16.0 * count * count)
    }

    /// Into how many pieces it is cut. A chord over 1/n of the parameter lies beside the curve by at
    /// most |second derivative| / 8n², and that derivative is largest at an end; see [`BEND`].
    fn pieces(&self, options: &CurveOptions) -> u8 {
        let bend = self.acceleration(0.0).length().max(self.acceleration(1.0).length());
        let by_bend = (bend / (BEND * options.tolerance)).sqrt();
        let by_length = self.length() / options.longest_piece - LONGER;
        // The cast of a number from 1 to 255 loses nothing.
        by_bend.max(by_length).ceil().clamp(1.0, MOST_PIECES) as u8
    }

    /// Length of the chords over eighths of the parameter (m).
    fn length(&self) -> f32 {
        (0..8_u8)
            .map(|i| self.at(f32::from(i) / 8.0).distance(self.at(f32::from(i + 1) / 8.0)))
            .sum()
    }
}
