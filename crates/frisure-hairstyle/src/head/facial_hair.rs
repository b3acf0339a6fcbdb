//! Brows and lashes: short hairs of a face, which no hairstyle counts.
//!
//! Numbers without a source are chosen by eye. A brow has some hundred hairs (photographs show 250 to 500), an upper
//! lid 90 to 150 lashes of 8 to 12 mm, a lower lid 70 to 80 of 6 to 8 mm (Thibaut et al. 2010,
//! doi:10.1111/j.1365-2133.2009.09505.x).

use frisure_strands::{Features, Strands};
use glam::{DVec3, Vec3};

use super::distance::SignedDistance;
use crate::random::{Purpose, Stream};

/// Lines along which the hairs of the left half of a face grow (m), from the nose outwards.
#[derive(Clone, Debug, Default)]
pub(super) struct FacialLines {
    /// Middle of the brow.
    pub(super) brow: Vec<DVec3>,
    /// Height and number of hairs of a brow over those of a thin one.
    pub(super) fullness: f64,
    /// Edge of the upper lid.
    pub(super) upper: Vec<DVec3>,
    /// Edge of the lower lid.
    pub(super) lower: Vec<DVec3>,
    /// Centre of the eye.
    pub(super) eye: DVec3,
    /// The plane x of the face's symmetry.
    pub(super) middle: f64,
}

/// Points of a hair.
const POINTS: usize = 6;

/// Hairs of a thin brow, lashes of an upper and of a lower lid.
const COUNTS: [u32; 3] = [480, 150, 70];

/// Short lashes of an upper lid beside the others: they make its edge dark.
const SHORT_LASHES: u32 = 190;

/// Width of the edge of a lid that lashes grow on (m).
const LID_EDGE: f64 = 1.0e-3;

/// Half the height of a thin brow at its inner and its outer end (m).
const BROW: [f64; 2] = [4.8e-3, 2.2e-3];

/// Radius at the root of hairs of the brow and of lashes (m).
const RADII: [f32; 2] = [3.4e-5, 4.5e-5];

/// The features with the hairs of both halves of a face; the skin's distance keeps brows on it.
pub(super) fn grown(features: Features, lines: &FacialLines, skin: &SignedDistance) -> Features {
    let [mut brows, mut lashes] = [(); 2].map(|()| Strands::new());
    for (side, mirrored) in [false, true].into_iter().enumerate() {
        let mut random = Stream::new(0, Purpose::Face, side);
        let push = |strands: &mut Strands, points: [DVec3; POINTS], radius: f32| {
            let place = |p: DVec3| {
                let x = if mirrored { 2.0 * lines.middle - p.x } else { p.x };
                DVec3::new(x, p.y, p.z).as_vec3()
            };
            let points: [Vec3; POINTS] = points.map(place);
            let taper: [f32; POINTS] = std::array::from_fn(|k| {
                radius * (1.0 - 0.8 * (k as f32 / (POINTS - 1) as f32).powi(2))
            });
            strands.push(&points, &taper);
        };
        let [brow, upper, lower] = COUNTS;
        for _ in 0..(f64::from(brow) * lines.fullness) as u32 {
            push(&mut brows, brow_hair(lines, skin, &mut random), RADII[0]);
        }
        for n in 0..upper + SHORT_LASHES {
            let part = if n < upper { 1.0 } else { 0.2 + 0.3 * random.unit() };
            let line = Lid { line: &lines.upper, eye: lines.eye, up: 1.0, length: 9.5e-3 * part };
            push(&mut lashes, lash(&line, skin, &mut random), RADII[1]);
        }
        // Closed lids have one edge.
        for _ in 0..if lines.lower.is_empty() { 0 } else { lower } {
            let line = Lid { line: &lines.lower, eye: lines.eye, up: -1.0, length: 5.5e-3 };
            push(&mut lashes, lash(&line, skin, &mut random), 0.75 * RADII[1]);
        }
    }
    Features { hairs: brows.followed_by(&lashes), lashes: lashes.len(), ..features }
}

/// A hair of the brow: it leaves upwards at the nose and along the brow farther out, and lies on the skin.
fn brow_hair(lines: &FacialLines, skin: &SignedDistance, random: &mut Stream) -> [DVec3; POINTS] {
    // Denser in the middle, thinner at both ends: the mean of two uniform numbers, stretched.
    let t = 0.5 + 0.62 * (random.unit() + random.unit() - 1.0);
    // What is stretched beyond an end is folded back: at the end itself the hairs would stand in one row.
    let t = t.abs().min(1.0 - (1.0 - t).abs());
    // Dense to both edges: half uniform, half the mean of two.
    let across = random.unit() + 0.5 * (random.unit() + random.unit()) - 1.0;
    let [inner, outer] = BROW;
    let half =
        lines.fullness * (inner + (outer - inner) * t) * (1.0 - 0.5 * (1.0 - 8.0 * t).max(0.0));
    let (centre, along) = on_line(&lines.brow, t);
    let root = centre + DVec3::Z * (half * across);
    // From 65° above the brow's line at its inner end to none at 0.4 of it; hairs of both edges lean to its middle.
    let lift = 1.15 * (1.0 - t / 0.4).max(0.0) - 0.35 * across + 0.16 * random.normal();
    let way = along * lift.cos() + DVec3::Z * lift.sin();
    let length = 8.5e-3 * (1.0 - 0.35 * t) * (0.75 + 0.35 * random.unit());
    let mut p = root;
    std::array::from_fn(|k| {
        if k > 0 {
            // The hair sinks back towards the brow's line.
            let sink = (along - way) * (0.05 * k as f64);
            p += (way + sink).normalize_or(way) * (length / (POINTS - 1) as f64);
        }
        let height = 1e-4 + 9e-4 * (k as f64 / (POINTS - 1) as f64);
        for _ in 0..3 {
            let (distance, out) = skin.value_gradient(p);
            p -= out * ((distance - height) / out.length_squared().max(0.25));
        }
        p
    })
}

/// A lid with lashes.
struct Lid<'a> {
    /// Its edge (m).
    line: &'a [DVec3],
    /// Centre of the eye (m).
    eye: DVec3,
    /// Its lashes bend up (1) or down (−1).
    up: f64,
    /// Length of its longest lashes (m).
    length: f64,
}

/// A lash on the edge of a lid: outwards from the eye, bent up or down.
fn lash(lid: &Lid<'_>, skin: &SignedDistance, random: &mut Stream) -> [DVec3; POINTS] {
    let Lid { line, eye, up, length } = *lid;
    let t = random.unit();
    let root = on_line(line, t).0 + DVec3::Z * (up * LID_EDGE * (random.unit() - 0.2));
    // Shorter at both ends, longest beyond the middle.
    let length = length * (0.5 + 0.5 * (std::f64::consts::PI * t.powf(0.8)).sin());
    let length = length * (0.8 + 0.3 * random.unit());
    let out = (root - eye).normalize_or(-DVec3::Y);
    let fan = DVec3::X * (0.9 * (t - 0.4) + 0.10 * random.normal());
    let start = (out + fan - DVec3::Y * 0.5 - DVec3::Z * (0.25 * up)).normalize_or(out);
    let bend = DVec3::Z * (up * (0.75 + 0.1 * random.normal()));
    std::array::from_fn(|k| {
        let s = k as f64 / (POINTS - 1) as f64;
        let mut p = root + out * 2e-4 + length * (s * start + s * s * bend);
        // Deep eyes have skin in the way: the lash lies on it.
        for _ in 0..if k > 0 { 3 } else { 0 } {
            let (distance, away) = skin.value_gradient(p);
            if distance < 4e-4 {
                p += away * ((4e-4 - distance) / away.length_squared().max(0.25));
            }
        }
        p
    })
}

/// The point a part `t` of a polyline along, and its unit direction there.
fn on_line(line: &[DVec3], t: f64) -> (DVec3, DVec3) {
    let last = line.len().saturating_sub(2);
    let at = t * (line.len() - 1) as f64;
    let k = (at as usize).min(last);
    let way = line[k + 1] - line[k];
    (line[k] + way * (at - k as f64), way.normalize_or(DVec3::X))
}
