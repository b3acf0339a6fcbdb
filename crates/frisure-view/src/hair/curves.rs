//! Strands as chains of vertices, smooth enough for a screen.

use std::fmt;

use frisure_render::facial_hairs;
use frisure_render::preview::{Wetness, smooth};
use frisure_strands::Strands;
use glam::{Vec2, Vec2Swizzles as _, Vec3};
use rayon::prelude::*;

use super::ranks::ranks;

/// Greatest turn within a piece (rad) and greatest length of one (m): the first that gives few enough
/// vertices applies. Chosen by eye.
const DETAIL: [(f32, f32); 6] =
    [(0.15, 0.014), (0.2, 0.016), (0.25, 0.02), (0.33, 0.025), (0.45, 0.03), (0.6, 0.04)];
/// Most vertices on a graphics device and on a software renderer, for many pictures a second.
pub(super) const VERTICES: [usize; 2] = [1_800_000, 250_000];
/// Most vertices, whatever the detail; fewer strands are kept where there are more. Chosen; a guard on memory.
pub(super) const MOST: usize = if cfg!(target_arch = "wasm32") { 3_000_000 } else { 6_000_000 };
/// Strands from which the number of vertices of all is estimated. Chosen.
const SAMPLE: usize = 2048;
/// Most pieces for one segment of the input.
const MAX_PIECES: u32 = 32;
/// Strands per parallel job.
const CHUNK: usize = 1024;

/// Position (m) and half of the true width (m); negative where the strand is never drawn wider than it is.
pub(super) type Place = [f32; 4];

/// All that is drawn, as textures hold it: strands in their order of rank.
#[derive(Default)]
pub(super) struct Curves {
    pub(super) places: Vec<Place>,
    /// Tangent, wetness and part of the length, strand's rank, nothing.
    pub(super) traits: Vec<[u32; 4]>,
    /// Position of each vertex on its strand, in points from the root.
    pub(super) along: Vec<f32>,
    /// Strand of each rank in the input.
    pub(super) strands: Vec<u32>,
    /// First vertex of each rank, and the number of vertices at the end.
    pub(super) firsts: Vec<u32>,
    /// Hairs of the head that could have been drawn, of which there may be more than were kept.
    pub(super) drawable: usize,
    /// Brows and lashes: the first of all ranks.
    pub(super) facial: usize,
}

impl fmt::Debug for Curves {
    /// Without the buffers.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} vertices", self.places.len())
    }
}

impl Curves {
    /// The strands that can be drawn, in about `enough` vertices if the coarsest detail allows it, and `most`
    /// at most: where that is too few, fewer strands.
    pub(super) fn new(strands: &Strands, enough: usize, most: usize) -> Self {
        let head_hairs = strands.len() - facial_hairs(strands);
        let order = ranks(head_hairs);
        let facial: Vec<u32> = (head_hairs as u32..strands.len() as u32).collect();
        let wetness = Wetness::new(strands);
        let made = |ranks: &[u32], detail: (f32, f32)| {
            let mut part = Self::default();
            for &strand in ranks {
                part.push(strands, strand, detail, &wetness);
            }
            part
        };
        let sample = &order[..order.len().min(SAMPLE)];
        let expected = |detail| {
            let vertices = made(sample, detail).places.len();
            vertices as f64 * order.len() as f64 / sample.len().max(1) as f64
        };
        let enough = enough.min(most) as f64;
        let detail = DETAIL.into_iter().find(|&detail| expected(detail) <= enough);
        let detail = detail.unwrap_or(DETAIL[DETAIL.len() - 1]);
        let chunks = facial.par_chunks(CHUNK).chain(order.par_chunks(CHUNK));
        let parts: Vec<Self> = chunks.map(|ranks| made(ranks, detail)).collect();
        let mut all = Self::joined(parts, most);
        let is_facial = |strand: &u32| *strand as usize >= head_hairs;
        all.facial = all.strands.iter().take_while(|strand| is_facial(strand)).count();
        all.drawable -= all.facial;
        for place in &mut all.places[..all.firsts[all.facial] as usize] {
            place[3] = -place[3];
        }
        all
    }

    /// Adds a strand, if it can be drawn.
    fn push(&mut self, strands: &Strands, index: u32, detail: (f32, f32), wetness: &Wetness<'_>) {
        let strand = strands.strand(index as usize);
        if strand.radii.iter().any(|r| !r.is_finite()) {
            return;
        }
        let mut curve = Vec::new();
        smooth(
            strand,
            |length, turn| pieces(length, turn, detail),
            |place, position, tangent| {
                curve.push(Point { place, position, tangent });
            },
        );
        let (first, rank) = (self.places.len(), self.strands.len() as u32);
        let mut reached = 0.0;
        for Point { place, position, tangent } in thinned(&curve, detail) {
            let before = self.places[first..].last().map_or(position, |p| Vec3::from_slice(p));
            reached += before.distance(position);
            let half = between(place, strand.radii).max(0.0);
            let wet = wetness.at(index as usize, place);
            self.places.push([position.x, position.y, position.z, half]);
            self.along.push(place);
            self.traits.push([folded(tangent), half_word(wet), rank, reached.to_bits()]);
        }
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
        for part in parts.into_iter().filter(|part| !part.strands.is_empty()) {
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

/// A point of a curve: points from the root, position (m), unit tangent.
#[derive(Clone, Copy)]
struct Point {
    place: f32,
    position: Vec3,
    tangent: Vec3,
}

/// The points that this detail needs: both ends, and those without which a piece would be too long or turn
/// too much.
fn thinned(curve: &[Point], (most_turn, most_length): (f32, f32)) -> impl Iterator<Item = Point> {
    let cosine = most_turn.cos();
    let mut kept: Option<Point> = None;
    curve.iter().enumerate().filter_map(move |(i, point)| {
        let needed = match (kept, curve.get(i + 1)) {
            (Some(kept), Some(next)) => {
                kept.tangent.dot(next.tangent) < cosine
                    || kept.position.distance_squared(next.position) > most_length * most_length
            }
            _ => true,
        };
        needed.then(|| *kept.insert(*point))
    })
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
