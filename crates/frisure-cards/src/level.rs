//! A level of detail: the strips of its locks, their textures, and how wide strands are drawn in them.

use frisure_strands::Strands;
use glam::Vec3;
use rayon::prelude::*;

use crate::atlas::{Atlas, Paint};
use crate::clusters::Clusters;
use crate::compare::{Difference, Reference, VIEWS};
use crate::error::CardsError;
use crate::layout::{Place, Shape, layout};
use crate::mesh::CardMesh;
use crate::ribbon::{Even, Ribbon, Side};

/// How far the mesh of the first level may be from the strips (m); twice as far in each further level.
const TOLERANCE: f32 = 8e-4;

/// Locks that are thicker than this part of their width have a second strip across the first. Chosen.
const ROUND: f32 = 0.5;

/// From this part of round locks on, half as many locks as cards are kept.
const MOSTLY_ROUND: f64 = 0.9;

/// Rounds that fit the widths of the drawn strands, until cards cover what strands cover within [`ENOUGH`].
const ROUNDS: usize = 4;
const ENOUGH: f64 = 0.01;

/// Least growth of what is covered with the width, as exponent, and the largest factor: wider strands cover no more then, they only
/// lose their form. Chosen.
const LEAST_GROWTH: f32 = 0.15;
const MOST_WIDENING: f32 = 8.0;

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

/// What all levels are made from.
pub(crate) struct Maker<'a> {
    pub(crate) drawn: &'a Strands,
    pub(crate) even: &'a Even,
    /// Outward is away from it (m).
    pub(crate) centre: Vec3,
    /// Colour of strands that have none of their own (linear).
    pub(crate) colour: [f32; 3],
    pub(crate) reference: &'a Reference,
}

/// The strips of a level.
struct Strips<'a> {
    /// Each with its strands.
    strips: Vec<(&'a [usize], Ribbon)>,
    places: Vec<Place>,
    mesh: CardMesh,
    /// Texels along a side of the texture.
    size: usize,
}

/// Strips with their textures.
struct Drawn {
    widening: f32,
    atlas: Atlas,
    differences: [Difference; VIEWS.len()],
}

impl Drawn {
    fn mean(&self, of: impl Fn(&Difference) -> f64) -> f64 {
        self.differences.iter().map(of).sum::<f64>() / VIEWS.len() as f64
    }

    /// What the strips cover over what the strands cover.
    fn ratio(&self) -> f64 {
        self.mean(|d| d.ratio)
    }

    /// How far they are from the strands.
    fn distance(&self) -> f64 {
        self.mean(|d| d.silhouette + d.coverage)
    }
}

impl Maker<'_> {
    /// Locks that have about `cards` strips together, and the part of them that is round. Half as many where most are round, which
    /// have two strips.
    pub(crate) fn locks(&self, cards: usize) -> (Clusters, f64) {
        let few = Clusters::new(self.drawn, cards.div_ceil(2));
        let round = self.round(&few.members);
        if round >= MOSTLY_ROUND {
            return (few, round);
        }
        let more = Clusters::new(self.drawn, (cards as f64 / (1.0 + round)).ceil() as usize);
        let round = self.round(&more.members);
        (more, round)
    }

    /// Part of the locks that are round.
    fn round(&self, locks: &[Vec<usize>]) -> f64 {
        let is_round = |rows: &Vec<usize>| self.is_round(rows, &self.strip(rows, Side::Wide, 0));
        let round = locks.par_iter().filter(|rows| is_round(rows)).count();
        round as f64 / locks.len().max(1) as f64
    }

    /// The first level.
    ///
    /// # Errors
    /// [`CardsError::Texture`].
    pub(crate) fn finest(&self, locks: &Clusters, size: usize) -> Result<Level, CardsError> {
        let strips = self.strips(&locks.members, true, 0, size)?;
        let first = self.draw(&strips, 1.0);
        Ok(self.fitted(strips, first))
    }

    /// A further level: of `crossed` locks of which the round ones have two strips, or of `flat` ones with one each, whichever is
    /// nearer to the strands, and whether it is of the first.
    ///
    /// # Errors
    /// [`CardsError::Texture`].
    pub(crate) fn nearest(
        &self,
        crossed: &Clusters,
        flat: &Clusters,
        level: usize,
        size: usize,
        widening: f32,
    ) -> Result<(Level, bool), CardsError> {
        let crossed = self.strips(&crossed.members, true, level, size)?;
        let flat = self.strips(&flat.members, false, level, size)?;
        let (a, b) = (self.draw(&crossed, widening), self.draw(&flat, widening));
        let crosses = a.distance() <= b.distance();
        let (strips, first) = if crosses { (crossed, a) } else { (flat, b) };
        Ok((self.fitted(strips, first), crosses))
    }

    fn strip(&self, rows: &[usize], side: Side, level: usize) -> Ribbon {
        let outward = |p: Vec3| (p - self.centre).normalize_or(Vec3::Z);
        Ribbon::new(self.even, rows, outward, side, TOLERANCE * (1 << level) as f32)
    }

    fn is_round(&self, rows: &[usize], wide: &Ribbon) -> bool {
        wide.roundness(self.even, rows) > ROUND
    }

    /// The strips of locks in a texture of `size` texels a side; with `crosses` round locks have two.
    fn strips<'a>(
        &self,
        locks: &'a [Vec<usize>],
        crosses: bool,
        level: usize,
        size: usize,
    ) -> Result<Strips<'a>, CardsError> {
        let of_lock = |rows: &'a Vec<usize>| {
            let wide = self.strip(rows, Side::Wide, level);
            let second = crosses && self.is_round(rows, &wide);
            let thick = second.then(|| self.strip(rows, Side::Thick, level));
            [Some(wide), thick].into_iter().flatten().map(|ribbon| (rows.as_slice(), ribbon))
        };
        let strips: Vec<_> = locks.par_iter().flat_map_iter(of_lock).collect();
        let shapes: Vec<Shape> = strips.iter().map(|(_, ribbon)| Shape::of(ribbon)).collect();
        let cards = strips.len();
        let places = layout(&shapes, size).ok_or(CardsError::Texture { cards, size })?;
        let mut mesh = CardMesh::default();
        strips.iter().zip(&places).for_each(|((_, r), place)| mesh.push(r, place, size));
        Ok(Strips { strips, places, mesh, size })
    }

    /// Draws the strands, their widths times `widening`.
    fn draw(&self, strips: &Strips<'_>, widening: f32) -> Drawn {
        let paint = Paint { strands: self.drawn, even: self.even, colour: self.colour, widening };
        let atlas = Atlas::new(&paint, &strips.strips, &strips.places, strips.size);
        let differences = self.reference.differences(&strips.mesh, &atlas);
        Drawn { widening, atlas, differences }
    }

    /// Strips whose strands are drawn so wide that cards cover what strands cover, by the secant method.
    fn fitted(&self, strips: Strips<'_>, first: Drawn) -> Level {
        // Logarithms of the last widening and of what was covered with it.
        let mut last: Option<[f32; 2]> = None;
        let mut best = first;
        let mut now = [best.widening.ln(), (best.ratio() as f32).ln()];
        for _ in 1..ROUNDS {
            if (best.ratio() - 1.0).abs() < ENOUGH || !(best.ratio() > 0.0) {
                break;
            }
            // Covered area grows slower than widths, the slower the denser hair is.
            let growth = last.map_or(1.0 / 1.5, |last| (now[1] - last[1]) / (now[0] - last[0]));
            let growth = if growth.is_finite() { growth.clamp(LEAST_GROWTH, 1.0) } else { 1.0 };
            let widening = (now[0] - now[1] / growth).exp().clamp(0.2, MOST_WIDENING);
            let drawn = self.draw(&strips, widening);
            last = Some(now);
            now = [widening.ln(), (drawn.ratio() as f32).ln()];
            if (drawn.ratio() - 1.0).abs() < (best.ratio() - 1.0).abs() {
                best = drawn;
            }
        }
        let Drawn { widening, atlas, differences } = best;
        let Strips { strips, mesh, .. } = strips;
        Level { cards: strips.len(), mesh, atlas, widening, differences }
    }
}
