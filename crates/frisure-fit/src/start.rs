//! Where a fit starts: curl, root and length from the geometry of the lines, with the stretch by gravity taken out for a guess of the stiffness.

use std::f64::consts::{FRAC_PI_2, TAU};

use frisure_rod::{bending, twist_free_frames};
use glam::{DMat3, DQuat, DVec3};

use crate::known::STANDARD_GRAVITY;
use crate::observe::Observed;
use crate::pose::{Fibre, Pose};
use crate::unknowns::Unknowns;

/// Noise of the direction of a piece of a line (rad) up to which neighbouring points are taken together. Chosen: bending of a curl by a quarter of a radian a
/// piece is seen through it.
const DIRECTION_NOISE: f64 = 0.12;

/// Fewest pieces of a line. Chosen.
const FEWEST_PIECES: usize = 8;

/// Turns of the frame per piece that are tried (rad): a little less than half a turn, and steps that are a fraction of the width of the peak.
const LARGEST_TWIST: f64 = 2.6;

/// Deviation of a coordinate (m) by the third differences of points, which a smooth line hardly has.
pub(crate) fn noise_of(points: &[DVec3]) -> f64 {
    let third = |p: &[DVec3]| (p[3] - p[2] * 3.0 + p[1] * 3.0 - p[0]).length_squared();
    let count = points.len().saturating_sub(3).max(1) as f64;
    // The variance of a third difference is 1 + 9 + 9 + 1 times that of a coordinate; there are three coordinates.
    (points.windows(4).map(third).sum::<f64>() / (60.0 * count)).sqrt()
}

/// A pose as a polyline of few pieces, with the material frames of a curl along it.
struct Polyline {
    /// Means of neighbouring points (m), and how far they are along the line from the first measured point (m).
    points: Vec<DVec3>,
    arc: Vec<f64>,
    length: f64,
    /// Frames of the pieces: columns d1, d2, t.
    frames: Vec<DMat3>,
    /// Mean curvature about d1 and torsion (rad/m).
    bending: f64,
    torsion: f64,
}

impl Polyline {
    /// From the points, `together` of which make one; `peak` is the rank of the peak of the spectrum.
    fn new(pose: &Pose, observed: &Observed, together: usize, peak: usize) -> Self {
        let points = &observed.points;
        let blocks = (points.len() / together).max(2);
        let block = |b: usize| b * points.len() / blocks..(b + 1) * points.len() / blocks;
        let mean = |b: usize| points[block(b)].iter().sum::<DVec3>() / block(b).len() as f64;
        let means: Vec<DVec3> = (0..blocks).map(mean).collect();
        let chords: Vec<DVec3> = means.windows(2).map(|p| p[1] - p[0]).collect();
        // 1. Arc length: given, or a chord with the arc that turns as far as neighbouring chords.
        let turn = |i: usize| chords[i - 1].angle_between(chords[i]);
        let mut arc = vec![0.0];
        for (i, chord) in chords.iter().enumerate() {
            let around = [i.max(1), (i + 1).min(chords.len() - 1)];
            let angle =
                if chords.len() > 1 { 0.5 * (turn(around[0]) + turn(around[1])) } else { 0.0 };
            let angle = angle.min(FRAC_PI_2);
            arc.push(arc[i] + chord.length() * (1.0 + angle * angle / 24.0));
        }
        let ends =
            [points[0].distance(means[0]), points[points.len() - 1].distance(means[blocks - 1])];
        arc.iter_mut().for_each(|s| *s += ends[0]);
        let length = arc[blocks - 1] + ends[1];
        if let Some(given) = pose.arc() {
            let mean = |b: usize| given[block(b)].iter().sum::<f64>() / block(b).len() as f64;
            arc = (0..blocks).map(mean).collect();
        }
        // 2. Frames without twist, and the twist with which the line bends about one axis.
        let tangents: Vec<DVec3> = chords.iter().map(|v| v.normalize_or(DVec3::NEG_Z)).collect();
        let frames = twist_free_frames(&tangents);
        let (twist, phase, strength) = twist_of(&bending(&frames), peak);
        let step = (arc[blocks - 1] - arc[0]) / (blocks - 1) as f64;
        let turned = |(i, frame): (usize, DMat3)| {
            frame * DMat3::from_rotation_z(phase + twist * (i as f64 - 0.5))
        };
        let frames = frames.into_iter().enumerate().map(turned).collect();
        let bending = strength / step;
        Self { points: means, arc, length, frames, bending, torsion: twist / step }
    }

    /// The natural strain (rad/m) with which a fibre of this EI/(ρSg) (m³) hangs so, on average. docs/theory.md (I1)
    fn natural(&self, pose: &Pose, stiffness: f64, expected: &Expected) -> DVec3 {
        let count = self.points.len();
        let [across, twist] = [expected.axis_ratio.powi(-2), expected.ratio[pose.state()].recip()];
        let soft = DVec3::new(1.0, across, twist) / stiffness;
        let weight = DVec3::NEG_Z * (pose.gravity().length() / STANDARD_GRAVITY);
        // First moment of what is beyond a vertex, about it.
        let (mut sum, mut moment, mut beyond) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for i in (1..count - 1).rev() {
            let step = self.arc[i + 1] - self.arc[i];
            let chord = self.points[i + 1] - self.points[i];
            moment += chord * (beyond + 0.5 * step);
            beyond += step;
            sum += soft * (self.frames[i].transpose() * moment.cross(weight));
        }
        DVec3::new(self.bending, 0.0, self.torsion) - sum / (count - 2).max(1) as f64
    }

    /// The frame at the clamp, bent back from the first piece.
    fn root(&self) -> DMat3 {
        let middle = 0.5 * (self.arc[0] + self.arc[1]);
        let turn = DVec3::new(self.bending, 0.0, self.torsion) * -middle;
        self.frames[0] * DMat3::from_quat(DQuat::from_scaled_axis(turn))
    }
}

/// The twist (rad per piece) and the angle at the start (rad) of frames in which bending is most about d1, and how much it is there (rad per piece):
/// a peak of the spectrum of the bending, the highest of which has the rank 0.
fn twist_of(bends: &[(f64, f64)], rank: usize) -> (f64, f64, f64) {
    let count = bends.len().max(1) as f64;
    // Peaks are 2π/count wide.
    let step = TAU / (4.0 * count);
    let tries = (LARGEST_TWIST / step) as i32;
    let twists: Vec<f64> = (-tries..=tries).map(|k| step * f64::from(k)).collect();
    let sums = spectrum(bends, &twists);
    let strengths: Vec<f64> = sums.iter().map(|(x, y)| (x * x + y * y).sqrt()).collect();
    let mut peaks: Vec<usize> = (0..twists.len())
        .filter(|&k| {
            (k == 0 || strengths[k] >= strengths[k - 1])
                && (k + 1 == twists.len() || strengths[k] > strengths[k + 1])
        })
        .collect();
    peaks.sort_by(|a, b| strengths[*b].total_cmp(&strengths[*a]));
    let Some(&peak) = peaks.get(rank.min(peaks.len().saturating_sub(1))) else {
        return (0.0, 0.0, 0.0);
    };
    let (x, y) = sums[peak];
    (twists[peak], y.atan2(x), strengths[peak] / count)
}

/// The sum over k of bends as complex numbers times exp(−i k twist), for each twist: by products, with a sine and a cosine for each twist alone, and all twists
/// side by side.
fn spectrum(bends: &[(f64, f64)], twists: &[f64]) -> Vec<(f64, f64)> {
    let steps: Vec<(f64, f64)> = twists.iter().map(|twist| twist.sin_cos()).collect();
    let mut phases = vec![(0.0, 1.0); twists.len()];
    let mut sums = vec![(0.0, 0.0); twists.len()];
    for &(a, b) in bends {
        for (((x, y), (s, c)), (sin, cos)) in sums.iter_mut().zip(&mut phases).zip(&steps) {
            *x += a * *c + b * *s;
            *y += b * *c - a * *s;
            (*c, *s) = (*c * cos - *s * sin, *s * cos + *c * sin);
        }
    }
    sums
}

/// Points that are taken together, so that the direction between their means is told well enough.
fn together(observed: &Observed, noise: f64) -> usize {
    let points = &observed.points;
    let length: f64 = points.windows(2).map(|p| p[0].distance(p[1])).sum();
    let step = length / (points.len() - 1) as f64;
    let most = (points.len() / FEWEST_PIECES).max(1);
    let enough = |m: usize| {
        let m = m as f64;
        noise * 2.0_f64.sqrt() / (m.sqrt() * m * step) <= DIRECTION_NOISE
    };
    (1..=most).find(|&m| enough(m)).unwrap_or(most)
}

/// What a fit may start from, the likeliest first: how much coarser pieces are, the rank of the peak of the spectrum, and the factor on the expected stiffness.
/// Coarser pieces and other peaks come after other stiffnesses.
const STARTS: [(usize, usize, f64); 9] = [
    (1, 0, 1.0),
    (1, 0, 4.0),
    (1, 0, 0.25),
    (1, 0, 16.0),
    (2, 0, 1.0),
    (2, 0, 4.0),
    (1, 1, 1.0),
    (1, 1, 4.0),
    (2, 1, 1.0),
];

/// What is expected of a fibre before its lines are looked at.
pub(crate) struct Expected {
    /// EI/(ρSg) (m³) and GJ/EI in each state, and the axis ratio.
    pub(crate) stiffness: Vec<f64>,
    pub(crate) ratio: Vec<f64>,
    pub(crate) axis_ratio: f64,
    /// Knots of the natural strain, and standard deviation of a coordinate (m).
    pub(crate) knots: usize,
    pub(crate) noise: f64,
}

/// The start of a rank, from 0; `None` after the last.
pub(crate) fn start(
    fibre: &Fibre,
    observed: &[Observed],
    expected: &Expected,
    rank: usize,
) -> Option<Unknowns> {
    let &(coarser, peak, factor) = STARTS.get(rank)?;
    let line = |(pose, observed): (&Pose, &Observed)| {
        let most = (observed.points.len() / 4).max(1);
        let together = (coarser * together(observed, expected.noise)).min(most);
        Polyline::new(pose, observed, together, peak)
    };
    let lines: Vec<Polyline> = fibre.poses().iter().zip(observed).map(line).collect();
    Some(from_lines(fibre, observed, &lines, expected, factor))
}

fn from_lines(
    fibre: &Fibre,
    observed: &[Observed],
    polylines: &[Polyline],
    expected: &Expected,
    factor: f64,
) -> Unknowns {
    let mut strain = (0.0, 0.0);
    let mut roots = Vec::with_capacity(polylines.len());
    for ((pose, line), observed) in fibre.poses().iter().zip(polylines).zip(observed) {
        let stiffness = expected.stiffness[pose.state()] * factor;
        let natural = line.natural(pose, stiffness, expected);
        // Bending that is natural is about d1: the frame turns to it.
        let share = polylines.len() as f64;
        strain.0 += natural.x.hypot(natural.y) / share;
        strain.1 += natural.z / share;
        let turn = DMat3::from_rotation_z(natural.y.atan2(natural.x));
        roots.push((observed.points[0], line.root() * turn));
    }
    let length = |state: usize| {
        let of_lines = fibre.poses().iter().zip(polylines);
        let of_lines = of_lines.filter(|(pose, _)| pose.state() == state);
        let mean =
            of_lines.clone().map(|(_, line)| line.length).sum::<f64>() / of_lines.count() as f64;
        fibre.length(state).unwrap_or(mean).ln()
    };
    Unknowns {
        strain: vec![strain; expected.knots],
        stiffness: expected.stiffness.iter().map(|b| (b * factor).ln()).collect(),
        ratio: expected.ratio.iter().map(|ratio| ratio.ln()).collect(),
        section: 2.0 * expected.axis_ratio.ln(),
        length: (0..fibre.states()).map(length).collect(),
        roots,
    }
}

/// Largest turn of the natural strain in an element (rad), and the least number of elements, also in the length over which gravity bends. Chosen: twice as
/// many move the numbers of a fit by less than a tenth of a per cent.
const LARGEST_TURN: f64 = 0.7;
const FEWEST_ELEMENTS: f64 = 20.0;
const PER_BEND: f64 = 3.0;

/// Most elements of a rod. A guard.
const MOST_ELEMENTS: f64 = 512.0;

/// How many elements a rod with these numbers needs; a multiple of 8, so that many fibres have the same.
pub(crate) fn elements(fibre: &Fibre, unknowns: &Unknowns) -> usize {
    let longest = unknowns.length.iter().copied().fold(f64::NEG_INFINITY, f64::max).exp();
    let largest = unknowns.strain.iter().map(|(u1, u3)| u1.hypot(*u3)).fold(0.0, f64::max);
    let bend = |pose: &Pose| {
        // Near the clamp the weight of the rest, ρSgL, bends over √(EI/(ρSgL)).
        let gravity = pose.gravity().length() / STANDARD_GRAVITY;
        longest * (longest * gravity / unknowns.stiffness[pose.state()].exp()).sqrt()
    };
    let bends = fibre.poses().iter().map(bend).fold(0.0, f64::max);
    let wanted = (largest * longest / LARGEST_TURN).max(PER_BEND * bends).max(FEWEST_ELEMENTS);
    8 * (wanted.min(MOST_ELEMENTS) / 8.0).ceil() as usize
}
