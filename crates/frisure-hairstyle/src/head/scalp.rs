//! Where hair grows.

use std::f64::consts::{PI, TAU};

use frisure_digest::digestible;
use frisure_strands::Surface;
use glam::DVec3;

use super::landmarks::Landmarks;
use crate::parallel;
use crate::random::{Purpose, Stream};

digestible! {
    /// The edge of the hair; lengths are distances from the usual line on the skin (m).
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Hairline {
        /// Standard deviation of the line from a smooth curve.
        pub irregularity: f64,
        /// How much higher the line over the forehead is than usual.
        pub height: f64,
        /// How far it recedes at the temples.
        pub recession: f64,
        /// How far it comes forward to a point in the middle.
        pub widows_peak: f64,
        /// How much higher sideburns end than usual, which is beside the middle of the ear.
        pub sideburns: f64,
        /// How much higher the line at the nape is than usual.
        pub nape: f64,
    }
}

impl Hairline {
    /// The usual line without irregularities.
    pub const EVEN: Self = Self {
        irregularity: 0.0,
        height: 0.0,
        recession: 0.0,
        widows_peak: 0.0,
        sideburns: 0.0,
        nape: 0.0,
    };

    /// The usual line of women: a little lower over the forehead, not receding, and with short sideburns. Chosen by eye.
    pub const WOMAN: Self =
        Self { irregularity: 1.5e-3, height: -4e-3, sideburns: 1e-2, ..Self::EVEN };

    /// The usual line on a built-in head.
    #[must_use]
    pub fn usual(head: &str) -> Self {
        if head.ends_with("-woman") { Self::WOMAN } else { Self::default() }
    }
}

impl Default for Hairline {
    fn default() -> Self {
        Self { irregularity: 1.5e-3, recession: 3e-3, ..Self::EVEN }
    }
}

/// Half the width over which hair thins out at the hairline (m). Chosen by eye.
const FEATHER: f64 = 3.5e-3;

/// Weight 0..1 at each vertex: 1 where hair grows, falling to 0 across the hairline.
pub(crate) fn weights(surface: &Surface, landmarks: &Landmarks) -> Vec<f64> {
    let edge = Edge::new(landmarks, &Hairline::EVEN, 0);
    // Beyond the feather weights are constant: a little more, for rounding.
    let inside = |p| edge.inside_within(p, 1.01 * FEATHER) / FEATHER;
    let weight = |&p: &DVec3| smooth(inside(p)) * (1.0 - edge.on_ear(p));
    parallel::map_slice(surface.positions(), weight)
}

/// How far outside the line the first hairs grow, and how far inside hair is full (m).
/// docs/theory.md, "Roots and implantation"; chosen by eye.
const THINNING: (f64, f64) = (-2e-3, 8e-3);

/// Number of waves that make a hairline irregular, and their wavelengths (m).
/// docs/theory.md, "Roots and implantation"; chosen by eye.
const WAVES: (usize, f64, f64) = (12, 7e-3, 35e-3);

/// The edge of hair as it grows: a hairline with its irregularities, drawn on the sphere of
/// directions about the cranium's centre. The sides are mirror images but for the irregularity.
pub(crate) struct Edge {
    landmarks: Landmarks,
    /// Azimuth and elevation (rad) on the left side, from the forehead to the nape.
    line: Vec<[f64; 2]>,
    /// Smallest and largest angles of each piece of [`STEPS`] segments.
    boxes: Vec<[[f64; 2]; 2]>,
    hairline: Hairline,
    /// Wave vectors (rad/m) and phases.
    waves: Vec<(DVec3, f64)>,
    /// Farther than this from the plain line (m) hair is full or there is none.
    pub(crate) reach: f64,
}

impl Edge {
    pub(crate) fn new(landmarks: &Landmarks, hairline: &Hairline, seed: u64) -> Self {
        let mut random = Stream::new(seed, Purpose::Hairline, 0);
        let (count, short, long) = WAVES;
        let mut wave = || {
            let way = DVec3::new(random.normal(), random.normal(), random.normal());
            let length = short * (long / short).powf(random.unit());
            (way.normalize_or(DVec3::X) * (TAU / length), TAU * random.unit())
        };
        let waves = (0..count).map(|_| wave()).collect();
        let line = curve(&anchors(landmarks, hairline));
        let boxes = (0..line.len()).step_by(STEPS).map(|i| bounds(&line[i..], STEPS + 1)).collect();
        let Hairline { irregularity, height, recession, widows_peak, .. } = *hairline;
        // n sines sum up to n at most: see `noise`.
        let noise = irregularity.abs() * (2.0 * count as f64).sqrt();
        let reach = THINNING.1 + height.abs() + recession.abs() + widows_peak.abs() + noise;
        Self { landmarks: landmarks.clone(), line, boxes, hairline: *hairline, waves, reach }
    }

    /// Density of hair at a point (m) of the skin, 0 to 1.
    pub(crate) fn density(&self, p: DVec3) -> f64 {
        let (bald, full) = THINNING;
        let x = (self.inside_within(p, self.reach) - bald) / (full - bald);
        smooth(2.0 * x - 1.0) * (1.0 - self.on_ear(p))
    }

    /// Distance (m) to the line, positive where hair grows.
    #[cfg(test)]
    pub(crate) fn inside(&self, p: DVec3) -> f64 {
        self.inside_within(p, f64::INFINITY)
    }

    /// Distance (m) to the line, positive where hair grows; ±`most` where the plain line is farther than `most` (m).
    pub(crate) fn inside_within(&self, p: DVec3, most: f64) -> f64 {
        let l = &self.landmarks;
        // Just short of π, where the line ends.
        let at = [l.azimuth(p).abs().min(PI - 1e-9), l.elevation(p)];
        let reach = p.distance(l.cranium_centre);
        let gap = self.distance(at, most / reach) * reach;
        let signed = if self.covers(at) { gap } else { -gap };
        if gap < most { signed - self.recession(at[0], p) } else { signed }
    }

    /// How far (m) the hair has receded from the plain line.
    fn recession(&self, azimuth: f64, p: DVec3) -> f64 {
        let h = &self.hairline;
        let bump = |centre: f64, width: f64| (-((azimuth - centre) / width).powi(2)).exp();
        // In azimuths (rad) from the middle of the face: the forehead up to 0.95, temples about 0.72, a peak in the middle.
        // Chosen by eye.
        let forehead = smooth((0.95 - azimuth) / 0.2);
        h.height * forehead + h.recession * bump(0.72, 0.25) - h.widows_peak * bump(0.0, 0.12)
            + h.irregularity * self.noise(p)
    }

    /// A smooth random number with mean 0 and standard deviation 1.
    fn noise(&self, p: DVec3) -> f64 {
        if self.hairline.irregularity == 0.0 {
            return 0.0;
        }
        let sum: f64 = self.waves.iter().map(|(k, phase)| (k.dot(p) + phase).sin()).sum();
        // n sines of random phase have the variance n/2: the irregularity is the standard deviation of the line.
        sum * (2.0 / self.waves.len() as f64).sqrt()
    }

    /// Angle to the line, or `most`, if that is less (rad).
    fn distance(&self, at: [f64; 2], most: f64) -> f64 {
        let shrink = at[1].cos();
        let mut least = most * most;
        for (i, [low, high]) in self.boxes.iter().enumerate() {
            // No nearer than the box around the piece.
            let gap = |x: usize| (low[x] - at[x]).max(at[x] - high[x]).max(0.0);
            if (gap(0) * shrink).powi(2) + gap(1).powi(2) < least {
                let gaps = self.segments(i).map(|w| square_gap(at, shrink, w));
                least = gaps.fold(least, f64::min);
            }
        }
        least.sqrt()
    }

    /// The segments of a piece.
    fn segments(&self, piece: usize) -> impl Iterator<Item = &[[f64; 2]]> {
        let end = (STEPS * (piece + 1)).min(self.line.len() - 1);
        self.line[STEPS * piece..=end].windows(2)
    }

    /// Whether a direction lies above the line: the line is below it an odd number of times.
    fn covers(&self, [azimuth, elevation]: [f64; 2]) -> bool {
        // Only pieces whose azimuths contain this one can pass it.
        let pieces = self.boxes.iter().enumerate();
        let near = pieces.filter(|(_, [low, high])| (low[0]..=high[0]).contains(&azimuth));
        let below = near.flat_map(|(i, _)| self.segments(i)).filter(|w| {
            let ([a0, e0], [a1, e1]) = (w[0], w[1]);
            (a0 <= azimuth) != (a1 <= azimuth)
                && e0 + (azimuth - a0) / (a1 - a0) * (e1 - e0) < elevation
        });
        below.count() % 2 == 1
    }

    /// 1 on the outer ear, which the scalp behind it shares its directions with.
    fn on_ear(&self, p: DVec3) -> f64 {
        let l = &self.landmarks;
        let out = (l.local(p).x.abs() - l.local(l.ear).x) / l.scale() + 2e-3;
        // From 2 mm outside the skull on.
        smooth(out / 2e-3) * smooth((1.0 - l.about_ear(p)) / 0.1)
    }
}

/// The line's corners, from proportions and from how far a hairline moves them: azimuth and elevation (rad).
fn anchors(l: &Landmarks, hairline: &Hairline) -> Vec<[f64; 2]> {
    let scale = l.width / 0.155;
    let ear = l.azimuth(l.ear);
    // Heights above the centre.
    let [front, brow, middle] = [l.hairline, l.brow, l.ear].map(|p| l.local(p).z);
    let top = middle + 0.033 * scale;
    let bottom = middle - 0.030 * scale;
    // A length along the skin is an angle about the centre.
    let nape = l.elevation(l.nape) + hairline.nape / l.nape.distance(l.cranium_centre);
    let sideburns = bottom + hairline.sideburns;
    // The skin's distance from the vertical axis, for a height above the centre.
    let at = |azimuth: f64, z: f64| {
        let h = z / l.cranium_radii.z;
        let ellipse = (azimuth.sin() / l.cranium_radii.x).hypot(azimuth.cos() / l.cranium_radii.y);
        let radius = (1.0 - h * h).max(0.4).sqrt() / ellipse;
        [azimuth, z.atan2(radius)]
    };
    // Azimuth (rad) and height of each corner: over the forehead, down the temple, before and round the ear, to the nape.
    // Proportions are chosen by eye on the mannequin.
    let mut line = vec![
        [0.0, l.elevation(l.hairline)],
        at(0.30, front),
        at(0.60, front + 0.001 * scale),
        at(0.78, front - 0.007 * scale),
        at(0.93, brow + 0.030 * scale),
        at(1.04, brow + 0.010 * scale),
        at(1.16, brow - 0.004 * scale),
        at(ear - 0.42, top - 0.012 * scale),
        at(ear - 0.40, sideburns + 0.020 * scale),
        at(ear - 0.24, sideburns + 0.018 * scale),
        at(ear - 0.21, top - 0.012 * scale),
        at(ear - 0.10, top + 0.008 * scale),
        at(ear + 0.16, top + 0.006 * scale),
        at(ear + 0.34, top - 0.020 * scale),
        at(ear + 0.44, bottom + 0.5 * hairline.nape),
    ];
    let last = line[line.len() - 1];
    line.push([0.5 * (last[0] + PI), 0.35 * last[1] + 0.65 * nape]);
    line.push([PI, nape]);
    line
}

/// Segments of the line between two corners. Chosen.
const STEPS: usize = 8;

/// Smallest and largest angles of the first `count` points of a line.
fn bounds(line: &[[f64; 2]], count: usize) -> [[f64; 2]; 2] {
    let points = line.iter().take(count);
    points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
        [[0, 1].map(|x| low[x].min(p[x])), [0, 1].map(|x| high[x].max(p[x]))]
    })
}

/// Square of the angle (rad²) from a direction to a segment, azimuths being shorter by `shrink`.
fn square_gap(at: [f64; 2], shrink: f64, segment: &[[f64; 2]]) -> f64 {
    let flat = |q: [f64; 2]| [(q[0] - at[0]) * shrink, q[1] - at[1]];
    let ([ax, ay], [bx, by]) = (flat(segment[0]), flat(segment[1]));
    let (dx, dy) = (bx - ax, by - ay);
    let t = -(ax * dx + ay * dy) / (dx * dx + dy * dy).max(1e-12);
    let t = t.clamp(0.0, 1.0);
    (ax + t * dx).powi(2) + (ay + t * dy).powi(2)
}

/// A smooth curve through the corners.
fn curve(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let get = |i: isize| {
        // Mirrored at the ends, where the line meets that of the right side.
        let last = corners.len() as isize - 1;
        let j = if i < 0 {
            -i
        } else if i > last {
            2 * last - i
        } else {
            i
        };
        let [a, e] = corners[j as usize];
        let end = corners[if i < 0 { 0 } else { last as usize }][0];
        if i == j { [a, e] } else { [2.0 * end - a, e] }
    };
    let mut line = vec![corners[0]];
    for i in 0..corners.len() as isize - 1 {
        let [a, b, c, d] = [get(i - 1), get(i), get(i + 1), get(i + 2)];
        for step in 1..=STEPS {
            let t = step as f64 / STEPS as f64;
            line.push([0, 1].map(|x| catmull_rom([a[x], b[x], c[x], d[x]], t)));
        }
    }
    line
}

fn catmull_rom([a, b, c, d]: [f64; 4], t: f64) -> f64 {
    let (m, n) = (0.5 * (c - a), 0.5 * (d - b));
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * b
        + (t3 - 2.0 * t2 + t) * m
        + (3.0 * t2 - 2.0 * t3) * c
        + (t3 - t2) * n
}

/// 0 below −1, 1 above 1, smooth between.
fn smooth(x: f64) -> f64 {
    let t = (0.5 * (x + 1.0)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
