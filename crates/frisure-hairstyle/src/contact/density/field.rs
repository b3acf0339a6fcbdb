//! The density of all wisps as a field in which one guide lies.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

use super::hair::Density;
use super::variation::DensityVariation;

impl Density {
    /// One guide among the others, where all are now.
    pub(crate) fn around(&self, guide: usize) -> AmongDensity<'_> {
        AmongDensity { density: self, guide, variation: None }
    }

    /// The same, of which the derivatives are known.
    pub(crate) fn around_with<'a>(
        &'a self,
        guide: usize,
        variation: &'a DensityVariation,
    ) -> AmongDensity<'a> {
        AmongDensity { variation: Some(variation), ..self.around(guide) }
    }

    /// The point of a guide at the arc length `s` (m).
    pub(super) fn point_at(&self, guide: usize, s: f64) -> usize {
        let range = self.of_guide(guide);
        // Rounding finds the point at s; the first is one spacing from the root.
        let k = (s / self.spacing[guide]).round() as usize;
        range.start + k.clamp(1, range.len()) - 1
    }
}

/// One guide in the density of all, as a field in which it lies: `Σ_k V_k (k_hair/48) max(0, φ_k − φ₀)³` over its points,
/// with φ_k the fraction of space that hair takes at one. docs/theory.md (D1), (D2)
///
/// The energy is the guide's own term of the sum over the head; the derivatives are those of the whole sum. Both are known at
/// the points of the guide where all guides are now, and nowhere else.
#[derive(Clone, Copy)]
pub(crate) struct AmongDensity<'a> {
    density: &'a Density,
    guide: usize,
    variation: Option<&'a DensityVariation>,
}

impl Field for AmongDensity<'_> {
    fn energy(&self, s: f64, _: DVec3) -> f64 {
        let k = self.density.point_at(self.guide, s);
        self.density.energy(k) / self.density.points.length[k]
    }

    fn derivatives(&self, s: f64, _: DVec3) -> Option<(DVec3, DMat3)> {
        let k = self.density.point_at(self.guide, s);
        let derivatives = match self.variation {
            Some(variation) => variation.derivatives(k),
            None => self.density.derivatives(k),
        };
        let (force, stiffness) = derivatives?;
        let per_length = 1.0 / self.density.points.length[k];
        Some((force * per_length, stiffness * per_length))
    }
}
