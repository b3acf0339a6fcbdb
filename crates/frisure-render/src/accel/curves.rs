//! Strands as smooth round curves, cut into straight pieces.

use frisure_strands::{Strand, Strands};
use glam::{Vec3, Vec3A, Vec4};

use super::AccelError;
use super::bounds::Bounds;
use super::error::FARTHEST;

/// How curves are cut into straight pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveOptions {
    /// Longest piece (m). Shorter pieces have tighter boxes, but there are more of them.
    pub longest_piece: f32,
    /// Farthest that a piece may lie beside the curve (m).
    pub tolerance: f32,
}

impl Default for CurveOptions {
    fn default() -> Self {
        Self { longest_piece: 4e-3, tolerance: 5e-5 }
    }
}

/// Most pieces of one segment.
const MOST_PIECES: f32 = 255.0;

/// Shortest distance between points of a strand, and smallest radius (m).
const TINY: f32 = 1e-7;

/// Largest radius (m): whatever is thicker is no hair, but a slip of units.
const THICKEST: f32 = 0.01;

/// How far a piece reaches beyond its ends, in radii. It closes the wedge on the outer side of a
/// joint bent by β, r tan(β/2) wide, up to β = 0.5; on the inner side it lies within the next piece.
pub(super) const REACH: f32 = 0.25;

/// Strands as smooth curves: Catmull–Rom splines through the points, the ends extrapolated, with a
/// radius that is linear between points.
///
/// Kept are the points, and for each segment (from a point to the next) its strand and the number of
/// equal steps of the spline's parameter that the straight *pieces* make: no longer and no farther
/// beside the curve than [`CurveOptions`] allows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curves {
    /// Points and radii, one strand after another.
    points: Vec<Vec4>,
    /// Strand of each point.
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

impl Piece {
    /// A box around it, with what reaches beyond its ends.
    pub(super) fn bounds(&self) -> Bounds {
        let end = self.start + self.axis;
        let ends = Bounds {
            low: Vec3A::from(self.start.min(end)),
            high: Vec3A::from(self.start.max(end)),
        };
        // √(1 + REACH²) of the radius, and a little for the change of radius in the reach.
        ends.grown(1.05 * self.radius.max(self.radius + self.widening))
    }
}

impl Curves {
    /// Checks and takes over strands. Strands with fewer than two points are nowhere.
    pub(super) fn new(strands: &Strands, options: &CurveOptions) -> Result<Self, AccelError> {
        check_options(options)?;
        let count = strands.points().len();
        let mut curves = Self {
            points: strands
                .points()
                .iter()
                .zip(strands.radii())
                .map(|(p, &r)| p.extend(r))
                .collect(),
            strand: Vec::with_capacity(count),
            offsets: strands.offsets().to_vec(),
            pieces: Vec::with_capacity(count),
        };
        let mut total = 0;
        for (index, strand) in strands.iter().enumerate() {
            check_strand(index, &strand)?;
            curves.count_pieces(index, &strand, options, &mut total);
            if total > 1 << 31 {
                return Err(AccelError::TooMany { strand: index });
            }
        }
        Ok(curves)
    }

    fn count_pieces(
        &mut self,
        index: usize,
        strand: &Strand<'_>,
        options: &CurveOptions,
        total: &mut usize,
    ) {
        let first = self.strand.len();
        self.strand.resize(first + strand.points.len(), index as u32);
        for point in first..self.strand.len() {
            let tip = point + 1 == self.strand.len();
            let pieces = if tip { 0 } else { self.spline(point).pieces(options) };
            self.pieces.push(pieces);
            *total += usize::from(pieces);
        }
    }

    /// The spline from point `point` to the next. The strands of both must be known.
    fn spline(&self, point: usize) -> Spline {
        let strand = self.strand[point] as usize;
        let range = self.offsets[strand] as usize..self.offsets[strand + 1] as usize;
        let [b, c] = [self.points[point], self.points[point + 1]];
        let a = if point > range.start { self.points[point - 1] } else { 2.0 * b - c };
        let d = if point + 2 < range.end { self.points[point + 2] } else { 2.0 * c - b };
        Spline { a: a.truncate(), b: b.truncate(), c: c.truncate(), d: d.truncate() }
    }

    /// Strand and segment in the strand of the segment that begins at `point`.
    pub(super) fn segment(&self, point: u32) -> (u32, u32) {
        let strand = self.strand[point as usize];
        (strand, point - self.offsets[strand as usize])
    }

    /// Parameter of the segment, 0 to 1, at `s` (0 to 1) along one of its pieces.
    pub(super) fn parameter(&self, name: PieceName, s: f32) -> f32 {
        (f32::from(name.number) + s) / f32::from(self.pieces[name.point as usize])
    }

    /// Unit tangent of the smooth curve at parameter `u` of a segment, towards the tip; `None` at a
    /// cusp.
    pub(super) fn tangent(&self, point: u32, u: f32) -> Option<Vec3> {
        self.spline(point as usize).velocity(u).try_normalize()
    }

    /// All pieces, in the order of the points.
    pub(super) fn pieces(&self) -> impl Iterator<Item = Piece> {
        (0..self.points.len()).flat_map(|point| self.pieces_of(point))
    }

    /// Number of pieces.
    pub(super) fn count(&self) -> usize {
        self.pieces.iter().map(|&n| usize::from(n)).sum()
    }

    /// The pieces of the segment that begins at `point`; those without length (at a cusp) are left
    /// out.
    fn pieces_of(&self, point: usize) -> impl Iterator<Item = Piece> {
        let count = self.pieces[point];
        let spline = (count > 0).then(|| self.spline(point));
        let radii = spline.map(|_| [self.points[point].w, self.points[point + 1].w]);
        let spline = spline.zip(radii);
        (0..count).filter_map(move |number| {
            let (spline, [r0, r1]) = spline?;
            let [u, v] = [number, number + 1].map(|k| f32::from(k) / f32::from(count));
            let (start, end) = (spline.at(u), spline.at(v));
            let [radius, last] = [u, v].map(|x| r0 + (r1 - r0) * x);
            let name = PieceName { point: point as u32, number };
            let piece = Piece { start, axis: end - start, radius, widening: last - radius, name };
            (piece.axis.length() > 0.1 * TINY).then_some(piece)
        })
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
        if point > 0 && position.distance(strand.points[point - 1]) < TINY {
            return Err(AccelError::Coincident { strand: index, point });
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

    /// Into how many pieces it is cut. A chord over 1/n of the parameter lies beside the curve by at
    /// most |second derivative| / 8n², and that derivative is largest at an end.
    fn pieces(&self, options: &CurveOptions) -> u8 {
        let [_, second, third] = self.coefficients();
        let bend = (2.0 * second).length().max((2.0 * second + 6.0 * third).length());
        let by_bend = (bend / (8.0 * options.tolerance)).sqrt();
        let by_length = self.length() / options.longest_piece;
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
