//! Places for strips in a square texture.

use crate::ribbon::Ribbon;

/// Texels between two places, so that filtering mixes none of them.
pub(crate) const GAP: usize = 4;

/// Texels along the hair for one across it: across are the edges of hairs, along little changes, but where curls are drawn.
/// Chosen.
const ALONG: f32 = 0.4;
const ALONG_CURLS: f32 = 0.8;

/// What a strip needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// Width and length (m).
    pub(crate) size: [f32; 2],
    /// Texels along the strip for one across it.
    pub(crate) grain: f32,
}

impl Shape {
    /// The shape of a strip.
    pub(crate) fn of(ribbon: &Ribbon) -> Self {
        let grain = if ribbon.along_axis { ALONG_CURLS } else { ALONG };
        Self { size: [ribbon.width(), ribbon.length()], grain }
    }
}

/// A place in a texture, in texels from its upper left corner. The root is above.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) x: usize,
    pub(crate) y: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

/// Places for strips in a texture of `size` texels a side, as large as all of them fit; none if they
/// do not fit at a texel of width each.
pub(crate) fn layout(strips: &[Shape], size: usize) -> Option<Vec<Place>> {
    // Texels per metre, by halves: what fits at one scale fits at smaller ones in practice, and if it does not, the last that
    // did is taken.
    let (mut low, mut high) = (0.0_f32, 1e6_f32);
    let mut found = None;
    for _ in 0..40 {
        let middle = if low > 0.0 { (low * high).sqrt() } else { 0.05 * high };
        match placed(strips, middle, size) {
            Some(places) => {
                found = Some(places);
                low = middle;
            }
            None => high = middle,
        }
        if high < 1e-3 {
            return placed(strips, 0.0, size);
        }
    }
    found
}

/// Rows of strips, the longest first, at a scale (texels per metre); none if they do not fit.
fn placed(strips: &[Shape], scale: f32, size: usize) -> Option<Vec<Place>> {
    let texels = |length: f32, least: usize| ((length * scale).ceil() as usize).max(least);
    let shape = |&Shape { size: [width, length], grain }: &Shape| {
        (texels(width, 2), texels(grain * length, 4))
    };
    let shapes: Vec<(usize, usize)> = strips.iter().map(shape).collect();
    let mut order: Vec<usize> = (0..strips.len()).collect();
    order.sort_by_key(|&i| (std::cmp::Reverse(shapes[i].1), i));
    let mut places = vec![Place::default(); strips.len()];
    let (mut x, mut y, mut row) = (GAP, GAP, 0);
    for i in order {
        let (width, height) = shapes[i];
        if x + width + GAP > size {
            (x, y, row) = (GAP, y + row + GAP, 0);
        }
        if x + width + GAP > size || y + height + GAP > size {
            return None;
        }
        places[i] = Place { x, y, width, height };
        x += width + GAP;
        row = row.max(height);
    }
    Some(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strip(width: f32, length: f32) -> Shape {
        Shape { size: [width, length], grain: ALONG }
    }

    #[test]
    fn places_are_apart_and_fill_the_texture() {
        let strips: Vec<Shape> = (0..200)
            .map(|i| strip(0.004 + 0.0001 * (i % 37) as f32, 0.05 + 0.002 * (i % 91) as f32))
            .collect();
        let places = layout(&strips, 1024).unwrap();
        let mut taken = vec![false; 1024 * 1024];
        for place in &places {
            for y in place.y..place.y + place.height {
                for x in place.x..place.x + place.width {
                    assert!(!std::mem::replace(&mut taken[y * 1024 + x], true));
                }
            }
        }
        let part = taken.iter().filter(|t| **t).count() as f64 / taken.len() as f64;
        assert!(part > 0.6, "{part}");
    }

    #[test]
    fn what_does_not_fit_has_no_places() {
        assert!(layout(&[strip(0.01, 0.1); 1000], 64).is_none());
        assert_eq!(layout(&[strip(0.01, 0.1)], 64).map(|p| p.len()), Some(1));
        assert!(layout(&[strip(0.0, 0.0); 3], 64).is_some());
    }
}
