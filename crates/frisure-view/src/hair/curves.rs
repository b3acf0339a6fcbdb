//! Strands as chains of vertices, smooth enough for a screen.

use frisure_render::preview::parts::{Wetness, smooth};
use frisure_strands::Strands;
use glam::{Vec2, Vec2Swizzles as _, Vec3};
use rayon::prelude::*;

use super::ranks::ranks;

/// Greatest turn within a piece (rad) and greatest length of one (m): the first that gives no more than
/// [`VERTICES`] is taken.
const DETAIL: [(f32, f32); 5] =
    [(0.12, 0.006), (0.2, 0.01), (0.3, 0.02), (0.45, 0.05), (f32::INFINITY, f32::INFINITY)];
/// Vertices that a device can well draw many times a second.
const VERTICES: usize = 2_000_000;
/// Most pieces for one segment of the input.
const MAX_PIECES: u32 = 32;
/// Strands per parallel job.
const CHUNK: usize = 1024;

/// Position (m) and half of the true width (m).
pub(super) type Place = [f32; 4];

/// All that is drawn, as textures hold it: strands in their order of rank.
#[derive(Default)]
pub(super) struct Curves {
    pub(super) places: Vec<Place>,
    /// Tangent, wetness and part of the length, strand's rank, nothing.
    pub(super) traits: Vec<[u32; 4]>,
    /// Where each vertex is on its strand, in points from the root.
    pub(super) along: Vec<f32>,
    /// Strand of each rank in the input.
    pub(super) strands: Vec<u32>,
    /// First vertex of each rank, and the number of vertices at the end.
    pub(super) firsts: Vec<u32>,
    /// Strands that could have been drawn, of which there may be more than were kept.
    pub(super) drawable: usize,
}

impl Curves {
    /// The strands that can be drawn, `most` vertices at most: where that is too few, fewer strands.
    pub(super) fn new(strands: &Strands, most: usize) -> Self {
        let order = ranks(strands.len());
        let detail = DETAIL.into_iter().find(|&d| count(strands, d) <= VERTICES.min(most));
        let detail = detail.unwrap_or(DETAIL[DETAIL.len() - 1]);
        let wetness = Wetness::new(strands);
        let parts: Vec<Self> = order
            .par_chunks(CHUNK)
            .map(|ranks| {
                let mut part = Self::default();
                for &strand in ranks {
                    part.push(strands, strand, detail, &wetness);
                }
                part
            })
            .collect();
        Self::joined(parts, most)
    }

    /// Adds a strand, if it can be drawn.
    fn push(&mut self, strands: &Strands, index: u32, detail: (f32, f32), wetness: &Wetness<'_>) {
        let strand = strands.strand(index as usize);
        if strand.radii.iter().any(|r| !r.is_finite()) {
            return;
        }
        let (first, rank) = (self.places.len(), self.strands.len() as u32);
        let mut reached = 0.0;
        smooth(
            strand,
            |length, turn| pieces(length, turn, detail),
            |place, position, tangent| {
                let before = self.places[first..].last().map_or(position, |p| Vec3::from_slice(p));
                reached += before.distance(position);
                let half = between(place, strand.radii).max(0.0);
                let wet = wetness.at(index as usize, place);
                self.places.push([position.x, position.y, position.z, half]);
                self.along.push(place);
                self.traits.push([folded(tangent), half_word(wet), rank, reached.to_bits()]);
            },
        );
        if self.places.len() == first {
            return;
        }
        for traits in &mut self.traits[first..] {
            let part = if reached > 0.0 { f32::from_bits(traits[3]) / reached } else { 0.0 };
            traits[1] |= half_word(part) << 16;
            traits[3] = 0;
        }
        self.strands.push(index);
        self.firsts.push(first as u32);
    }

    /// All parts one after another, as far as there is room.
    fn joined(parts: Vec<Self>, most: usize) -> Self {
        let mut all =
            Self { drawable: parts.iter().map(|p| p.strands.len()).sum(), ..Self::default() };
        let total = parts.iter().map(|p| p.places.len()).sum::<usize>().min(most);
        all.places.reserve(total);
        all.traits.reserve(total);
        all.along.reserve(total);
        for part in parts {
            let (vertices, ranks) = (all.places.len() as u32, all.strands.len() as u32);
            let ends = part.firsts.iter().skip(1).map(|&f| f as usize);
            let fits = ends
                .chain([part.places.len()])
                .take_while(|end| all.places.len() + end <= most)
                .enumerate()
                .last();
            let Some((last, end)) = fits else { break };
            all.places.extend_from_slice(&part.places[..end]);
            all.along.extend_from_slice(&part.along[..end]);
            all.traits.extend(part.traits[..end].iter().map(|&[a, b, c, d]| [a, b, c + ranks, d]));
            all.strands.extend_from_slice(&part.strands[..=last]);
            all.firsts.extend(part.firsts[..=last].iter().map(|first| first + vertices));
            if last + 1 < part.strands.len() {
                break;
            }
        }
        all.firsts.push(all.places.len() as u32);
        all
    }

    pub(super) fn position(&self, vertex: usize) -> Vec3 {
        Vec3::from_slice(&self.places[vertex])
    }
}

/// Vertices that this detail asks for.
fn count(strands: &Strands, detail: (f32, f32)) -> usize {
    if detail.0.is_infinite() {
        return strands.points().len();
    }
    (0..strands.len())
        .into_par_iter()
        .with_min_len(CHUNK)
        .map(|i| {
            let points = strands.strand(i).points;
            let chords = points.windows(3).map(|w| (w[1] - w[0], w[2] - w[1]));
            let pieces = chords.map(|(a, b)| {
                let turn = a.angle_between(b);
                pieces(b.length(), if turn.is_finite() { turn } else { 0.0 }, detail) as usize
            });
            2 + pieces.sum::<usize>()
        })
        .sum()
}

/// Straight pieces for a curve of this chord (m) and turn (rad).
fn pieces(length: f32, turn: f32, (most_turn, most_length): (f32, f32)) -> u32 {
    let wanted = (turn / most_turn).max(length / most_length);
    // The cast saturates.
    (wanted.ceil() as u32).clamp(1, MAX_PIECES)
}

/// A value between those of the points.
fn between(place: f32, values: &[f32]) -> f32 {
    let (before, x) = (place as usize, place.fract());
    let after = values[(before + 1).min(values.len() - 1)];
    values[before] + (after - values[before]) * x
}

/// A part from 0 to 1 in 16 bits.
fn half_word(part: f32) -> u32 {
    (part.clamp(0.0, 1.0) * 65_535.0 + 0.5) as u32
}

/// A unit vector on an unfolded octahedron (Cigolle et al. 2014), 16 bits for each of two coordinates.
fn folded(v: Vec3) -> u32 {
    let p = v.truncate() / v.abs().element_sum().max(1e-9);
    let sign = Vec2::new(1.0_f32.copysign(p.x), 1.0_f32.copysign(p.y));
    let p = if v.z >= 0.0 { p } else { (Vec2::ONE - p.yx().abs()) * sign };
    let word = |x: f32| (x.clamp(-1.0, 1.0) * 32_767.0).round() as i16 as u16;
    u32::from(word(p.x)) | u32::from(word(p.y)) << 16
}
