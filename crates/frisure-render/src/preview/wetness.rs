//! The wetness of strands.

use frisure_strands::Strands;

use super::curves::{along, point_wetness, portion};

/// The wetness of strands, from their attribute `wetness`.
pub struct Wetness<'a> {
    values: Option<&'a [f32]>,
    offsets: &'a [u32],
}

impl<'a> Wetness<'a> {
    /// The wetness of these strands.
    #[must_use]
    pub fn new(strands: &'a Strands) -> Self {
        Self { values: point_wetness(strands), offsets: strands.offsets() }
    }

    /// Wetness (0 to 1) of a strand, `place` points from its root.
    ///
    /// # Panics
    /// If there is no such strand or place.
    #[must_use]
    pub fn at(&self, strand: usize, place: f32) -> f32 {
        let Some(values) = self.values else { return 0.0 };
        let first = self.offsets[strand] as usize;
        along(place, |i| portion(values[first + i]))
    }
}
