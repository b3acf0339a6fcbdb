//! Cards of a groom, in all levels of detail.

use frisure_progress::Progress;
use frisure_strands::{Strands, Surface};
use glam::Vec3;
use rayon::prelude::*;
use thiserror::Error;

use crate::atlas::{Atlas, Paint};
use crate::clusters::Clusters;
use crate::compare::{Difference, Reference, VIEWS};
use crate::layout::layout;
use crate::mesh::CardMesh;
use crate::ribbon::{Even, Ribbon};

/// Most strands that are clustered and drawn: more add nothing that a texture can show. Chosen.
const MOST_STRANDS: usize = 30_000;

/// Cards of a level over those of the next.
const RATIO: f64 = 2.5;

/// How far the mesh of the first level may be from the strips (m); twice as far in each further level.
const TOLERANCE: f32 = 8e-4;

/// Rounds that fit the widths of the drawn strands, until cards cover what strands cover within [`ENOUGH`].
const ROUNDS: usize = 3;
const ENOUGH: f64 = 0.01;

/// What cards are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CardsOptions {
    /// Cards of the first level, 1 to 20 000; further levels have 2.5 times fewer each.
    pub cards: usize,
    /// Levels of detail, 1 to 8.
    pub levels: usize,
    /// Texels along a side of the first level's textures, 64 to 8192; half as many in each further level, at least 64.
    pub texture: usize,
    /// Colour of strands that have none of their own (linear, primaries of sRGB).
    pub colour: [f32; 3],
}

impl Default for CardsOptions {
    fn default() -> Self {
        Self { cards: 800, levels: 4, texture: 2048, colour: [0.1, 0.05, 0.025] }
    }
}

/// Why there are no cards.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum CardsError {
    /// No strand has a length.
    #[error("the groom has no strand with a length")]
    NoStrands,
    /// A number is outside of its range.
    #[error("{what} {value} is not between {least} and {most}")]
    Range {
        /// What it is.
        what: &'static str,
        /// The number given.
        value: usize,
        /// The least that it can be.
        least: usize,
        /// The most that it can be.
        most: usize,
    },
    /// The strips do not fit into the texture.
    #[error("{cards} cards do not fit into a texture of {size}x{size} texels")]
    Texture {
        /// Number of cards.
        cards: usize,
        /// Texels along a side.
        size: usize,
    },
    /// The caller asked to stop.
    #[error("the cards were cancelled")]
    Cancelled,
}

/// Cards in levels of detail, the finest first.
#[derive(Clone, Debug)]
pub struct Cards {
    /// The levels.
    pub levels: Vec<Level>,
    /// Strands with a length.
    pub strands: usize,
    /// Those of them that were drawn, wider, for all.
    pub drawn: usize,
}

/// A level of detail.
#[derive(Clone, Debug)]
pub struct Level {
    /// Number of cards.
    pub cards: usize,
    /// The cards.
    pub mesh: CardMesh,
    /// Their textures.
    pub atlas: Atlas,
    /// Factor on the widths of strands with which they are drawn, so that cards cover what strands cover.
    pub widening: f32,
    /// How far the level is from the strands, from each of [`VIEWS`].
    pub differences: [Difference; VIEWS.len()],
}

/// Cards of a groom; `head` hides what is behind it in the comparison, and tells where outside is.
///
/// # Errors
/// [`CardsError`].
pub fn cards(
    strands: &Strands,
    head: Option<&Surface>,
    options: CardsOptions,
    progress: &dyn Progress,
) -> Result<Cards, CardsError> {
    check(&options)?;
    let report = |done: f64| {
        progress.report("cards", done);
        progress.check().map_err(|_| CardsError::Cancelled)
    };
    report(0.0)?;
    let long = strands.thinned(strands.len()).rows.len();
    if long == 0 {
        return Err(CardsError::NoStrands);
    }
    let drawn = strands.thinned(MOST_STRANDS).strands;
    let even = Even::new(&drawn);
    report(0.1)?;
    let reference = Reference::new(&drawn, head);
    report(0.2)?;
    let centre = centre(&drawn, head);
    let mut clusters = Clusters::new(&drawn, options.cards);
    let mut levels = Vec::new();
    for level in 0..options.levels {
        if level > 0 {
            let count = (options.cards as f64 / RATIO.powi(level as i32)).ceil() as usize;
            clusters = clusters.merged(&drawn, count.max(1));
        }
        report(0.3 + 0.7 * level as f64 / options.levels as f64)?;
        let work = Work { drawn: &drawn, even: &even, clusters: &clusters, centre };
        let size = (options.texture >> level).max(64);
        levels.push(work.level(level, size, options.colour, &reference)?);
    }
    report(1.0)?;
    Ok(Cards { levels, strands: long, drawn: drawn.len() })
}

fn check(options: &CardsOptions) -> Result<(), CardsError> {
    for (what, value, least, most) in [
        ("the number of cards", options.cards, 1, 20_000),
        ("the number of levels", options.levels, 1, 8),
        ("the size of the texture", options.texture, 64, 8192),
    ] {
        if !(least..=most).contains(&value) {
            return Err(CardsError::Range { what, value, least, most });
        }
    }
    Ok(())
}

/// The middle of the head, or of the roots (m): outward is away from it.
fn centre(strands: &Strands, head: Option<&Surface>) -> Vec3 {
    let roots: Vec<Vec3> = strands.iter().map(|s| s.points[0]).collect();
    let mean = roots.iter().sum::<Vec3>() / roots.len() as f32;
    // A neck and shoulders are no part of where hair grows: the height is that of the roots, less a little.
    head.map_or(mean, |head| {
        let (low, high) = head.bounds();
        let middle = (0.5 * (low + high)).as_vec3();
        Vec3::new(middle.x, 0.5 * (middle.y + mean.y), mean.z - 0.03)
    })
}

/// What all levels are made from.
struct Work<'a> {
    drawn: &'a Strands,
    even: &'a Even,
    clusters: &'a Clusters,
    centre: Vec3,
}

impl Work<'_> {
    fn level(
        &self,
        level: usize,
        size: usize,
        colour: [f32; 3],
        reference: &Reference,
    ) -> Result<Level, CardsError> {
        let members = &self.clusters.members;
        let outward = |p: Vec3| (p - self.centre).normalize_or(Vec3::Z);
        let tolerance = TOLERANCE * (1 << level) as f32;
        let ribbons: Vec<Ribbon> = members
            .par_iter()
            .map(|rows| Ribbon::new(self.even, rows, outward, tolerance))
            .collect();
        let shapes: Vec<[f32; 2]> = ribbons.iter().map(|r| [r.width(), r.length()]).collect();
        let cards = members.len();
        let places = layout(&shapes, size).ok_or(CardsError::Texture { cards, size })?;
        let mut mesh = CardMesh::default();
        ribbons.iter().zip(&places).for_each(|(r, place)| mesh.push(r, place, size));
        let strips: Vec<(&[usize], &Ribbon)> =
            members.iter().map(Vec::as_slice).zip(&ribbons).collect();
        let mut widening = 1.0;
        let mut best: Option<(f64, f32, Atlas, [Difference; VIEWS.len()])> = None;
        for _ in 0..ROUNDS {
            let paint = Paint { strands: self.drawn, even: self.even, colour, widening };
            let atlas = Atlas::new(&paint, &strips, &places, size);
            let differences = reference.differences(&mesh, &atlas);
            let ratio = differences.iter().map(|d| d.ratio).sum::<f64>() / VIEWS.len() as f64;
            if best.as_ref().is_none_or(|b| (ratio - 1.0).abs() < (b.0 - 1.0).abs()) {
                best = Some((ratio, widening, atlas, differences));
            }
            if (ratio - 1.0).abs() < ENOUGH || !(ratio > 0.0) {
                break;
            }
            // Covered area saturates where hair is dense: a step is longer than in proportion.
            widening = (widening * (ratio as f32).powf(-1.5)).clamp(0.2, 8.0);
        }
        let (_, widening, atlas, differences) = best.expect("there is a first round");
        Ok(Level { cards, mesh, atlas, widening, differences })
    }
}
