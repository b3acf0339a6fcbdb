//! A smooth curve through points, and material frames along it.

use glam::{DMat3, DVec3};

use crate::bishop::{bending, twist_free_frames};

/// Pieces of the smooth curve per piece of the given polyline. Chosen by trial: on an arc that turns by θ over one given
/// piece, chords stray by θ/512 of the length of that piece.
const PIECES: usize = 8;

/// Points nearer to each other than this (m) count as one point. Chosen: far below the diameter of a hair.
const LEAST_DISTANCE: f64 = 1e-9;

/// Twists tried per element, either way: steps of π/16 rad over the whole line, where the peak of a spectrum is 2π wide.
/// Chosen by trial.
const TWISTS: usize = 4;

/// A smooth curve through points, by arc length.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    arc: Vec<f64>,
    points: Vec<DVec3>,
    /// Its own points, and the arc lengths at which they are.
    nodes: Vec<(f64, DVec3)>,
}

impl Curve {
    /// Fits a curve through points (m) by centripetal Catmull–Rom splines; `None` for fewer than two.
    pub(super) fn through(given: &[DVec3]) -> Option<Self> {
        let mut nodes: Vec<DVec3> = Vec::with_capacity(given.len());
        for &p in given {
            if nodes.last().is_none_or(|last| last.distance(p) > LEAST_DISTANCE) {
                nodes.push(p);
            }
        }
        let last = nodes.len().checked_sub(1).filter(|&last| last > 0)?;
        // Centripetal Catmull–Rom: each piece from four points; the ends are mirrored.
        let mut points = vec![nodes[0]];
        for i in 0..last {
            let (b, c) = (nodes[i], nodes[i + 1]);
            let a = if i > 0 { nodes[i - 1] } else { b * 2.0 - c };
            let d = nodes.get(i + 2).copied().unwrap_or(c * 2.0 - b);
            points.extend((1..=PIECES).map(|k| spline([a, b, c, d], k as f64 / PIECES as f64)));
        }
        let mut length = 0.0;
        let mut arc = vec![0.0];
        arc.extend(points.windows(2).map(|pair| {
            length += pair[0].distance(pair[1]);
            length
        }));
        let nodes = nodes.into_iter().enumerate().map(|(i, p)| (arc[i * PIECES], p)).collect();
        Some(Self { arc, points, nodes })
    }

    /// Its length (m).
    pub(super) fn length(&self) -> f64 {
        self.arc[self.arc.len() - 1]
    }

    /// The point (m) at an arc length (m); beyond its ends it goes straight on.
    pub(super) fn at(&self, s: f64) -> DVec3 {
        let i = self.arc.partition_point(|&a| a <= s).clamp(1, self.arc.len() - 1) - 1;
        let (from, to) = (self.arc[i], self.arc[i + 1]);
        let x = if to > from { (s - from) / (to - from) } else { 0.0 };
        self.points[i] + (self.points[i + 1] - self.points[i]) * x
    }

    /// The points (m) that it goes through, each with its arc length (m).
    pub(super) fn nodes(&self) -> &[(f64, DVec3)] {
        &self.nodes
    }

    /// Sum of the angles (rad) between its pieces.
    pub(super) fn turning(&self) -> f64 {
        let way = |pair: &[DVec3]| (pair[1] - pair[0]).normalize_or_zero();
        let turn = |three: &[DVec3]| way(&three[..2]).dot(way(&three[1..])).clamp(-1.0, 1.0).acos();
        self.points.windows(3).map(turn).sum()
    }

    /// Frames at the ends of `elements` equal elements, columns d1, d2, t: t along the line, and d1 about
    /// which it bends, as nearly as an even twist along the whole line allows. So the soft axis of an
    /// elliptical section follows the curl, and a helix has a constant strain.
    pub(super) fn frames(&self, elements: usize) -> Vec<DMat3> {
        let h = self.length() / elements as f64;
        let tangent = |i: usize| {
            let s = h * i as f64;
            (self.at(s + 0.5 * h) - self.at(s - 0.5 * h)).normalize_or(DVec3::Z)
        };
        let tangents: Vec<DVec3> = (0..=elements).map(tangent).collect();
        let frames = twist_free_frames(&tangents);
        // Bending about d1 and d2 of frames without twist, as complex numbers.
        let (twist, start) = best_twist(&bending(&frames));
        let turned = |(i, frame): (usize, DMat3)| {
            // Bends belong to the middles of elements, frames to their ends: half an element less.
            frame * DMat3::from_rotation_z(start + twist * (i as f64 - 0.5))
        };
        frames.into_iter().enumerate().map(turned).collect()
    }
}

/// Point at the part `x` of the way from the second to the third of four points.
fn spline(p: [DVec3; 4], x: f64) -> DVec3 {
    // Knots at the root of the distance (centripetal): no cusps or loops where points are unevenly spaced.
    let step = |a: DVec3, b: DVec3| a.distance(b).sqrt().max(LEAST_DISTANCE);
    let t1 = step(p[0], p[1]);
    let t2 = t1 + step(p[1], p[2]);
    let t3 = t2 + step(p[2], p[3]);
    let t = t1 + x * (t2 - t1);
    let mix = |a: DVec3, b: DVec3, from: f64, to: f64| a + (b - a) * ((t - from) / (to - from));
    // The pyramid of linear interpolations of [Barry & Goldman 1988].
    let (a, b, c) = (mix(p[0], p[1], 0.0, t1), mix(p[1], p[2], t1, t2), mix(p[2], p[3], t2, t3));
    let (d, e) = (mix(a, b, 0.0, t2), mix(b, c, t1, t3));
    mix(d, e, t1, t2)
}

/// The twist (rad per element) and the angle at the start (rad) of frames in which bending is most about d1:
/// the peak of the spectrum of the bending.
fn best_twist(bends: &[(f64, f64)]) -> (f64, f64) {
    // Fourier sums of the bending at a twist (rad per element) and at the opposite one, which has the same cosines.
    let sums = |twist: f64| {
        bends.iter().enumerate().fold([(0.0, 0.0); 2], |[(x, y), (u, v)], (i, b)| {
            let (sin, cos) = (twist * i as f64).sin_cos();
            [
                (x + b.0 * cos + b.1 * sin, y + b.1 * cos - b.0 * sin),
                (u + b.0 * cos - b.1 * sin, v + b.1 * cos + b.0 * sin),
            ]
        })
    };
    let tries = (TWISTS * bends.len()) as i32;
    // A quarter turn per element is all that elements can follow.
    let twist = |k: i32| std::f64::consts::FRAC_PI_4 * f64::from(k) / f64::from(tries.max(1));
    let found: Vec<_> = (0..=tries).map(|k| sums(twist(k))).collect();
    let strength = |k: i32| {
        let (x, y) = found[k.unsigned_abs() as usize][usize::from(k < 0)];
        // Of equal strengths, the least twist.
        x.hypot(y) - 1e-9 * twist(k).abs()
    };
    let best = (-tries..=tries).max_by(|a, b| strength(*a).total_cmp(&strength(*b))).unwrap_or(0);
    // In a frame turned by this phase the mean bending is about d1.
    let (x, y) = found[best.unsigned_abs() as usize][usize::from(best < 0)];
    (twist(best), y.atan2(x))
}
