//! Cards of a groom, in all levels of detail.

use frisure_progress::Progress;
use frisure_strands::{Strands, Surface};
use glam::Vec3;

use crate::compare::Reference;
use crate::error::CardsError;
use crate::level::{Level, Maker};
use crate::ribbon::Even;

/// Most strands that are clustered and drawn: more add nothing that a texture can show. Chosen.
const MOST_STRANDS: usize = 30_000;

/// Locks of a level over those of the next.
const RATIO: f64 = 2.5;

/// What cards are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CardsOptions {
    /// Cards of the first level, about, 1 to 20 000; further levels have 2.5 times fewer each.
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
    let maker =
        Maker { drawn: &drawn, even: &even, centre, colour: options.colour, reference: &reference };
    let (clusters, round) = maker.locks(options.cards);
    let mut levels = vec![maker.finest(&clusters, options.texture)?];
    let mut last = clusters;
    for level in 1..options.levels {
        report(0.3 + 0.7 * level as f64 / options.levels as f64)?;
        let cards = options.cards as f64 / RATIO.powi(level as i32);
        // Fewer locks with a second strip across, or as many with one strip as there are cards: what is nearer to the strands.
        let crossed = last.merged(&drawn, (cards / (1.0 + round)).ceil() as usize);
        let flat = last.merged(&drawn, cards.ceil() as usize);
        let size = (options.texture >> level).max(64);
        let widening = levels[level - 1].widening;
        let (made, crosses) = maker.nearest(&crossed, &flat, level, size, widening)?;
        levels.push(made);
        last = if crosses { crossed } else { flat };
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
