//! The fibre of a lock in a photo: that of a hair type, with what is known of it.

use std::ops::RangeInclusive;

use frisure::hairstyle::{Ellipticity, HairType};
use frisure::measure::Fibre;
use frisure::rod::{InvalidQuantity, Material, Section};

/// Lengths of hairs (m) that can be given.
pub const LENGTHS: RangeInclusive<f64> = 1e-3..=3.0;

/// Mean diameters (m) that can be given; hair of the scalp has 40 to 120 µm.
pub const DIAMETERS: RangeInclusive<f64> = 5e-6..=5e-4;

/// Axis ratios that can be given.
pub const AXIS_RATIOS: RangeInclusive<f64> = 1.0..=20.0;

/// Young's moduli (Pa) that can be given; hair has 1 to 7 GPa.
pub const MODULI: RangeInclusive<f64> = 1e8..=1e11;

/// Standard deviation of Young's modulus between people, relative: docs/hair-types.md has 3 to 5 GPa. Chosen.
const MODULUS_SPREAD: f64 = 0.15;

/// Standard deviation of a number of the fibre that was measured, relative. Chosen.
const MEASURED_SPREAD: f64 = 0.03;

/// What is known of the fibres of a lock; what is not given is the type's.
#[derive(Clone, Copy, Debug)]
pub struct KnownFibre {
    /// The hair type.
    pub hair_type: &'static HairType,
    /// Mean diameter (m).
    pub diameter: Option<f64>,
    /// Longer over shorter axis of the section.
    pub axis_ratio: Option<f64>,
    /// Young's modulus (Pa).
    pub youngs_modulus: Option<f64>,
}

impl KnownFibre {
    /// The fibre; stiffness over weight goes with E d² and, of an ellipse, the inverse of the axis ratio.
    ///
    /// # Errors
    /// [`InvalidQuantity`], if the numbers are not those of a fibre.
    pub fn fibre(&self) -> Result<Fibre, InvalidQuantity> {
        let kind = self.hair_type;
        let of_type = kind.fibre(Ellipticity::Measured)?;
        let diameter = self.diameter.unwrap_or(kind.diameter);
        let ratio = self.axis_ratio.unwrap_or(kind.axis_ratio);
        let young = self.youngs_modulus.unwrap_or(kind.youngs_modulus);
        let spread = |given: bool, of_type: f64| if given { MEASURED_SPREAD } else { of_type };
        let deviations = [
            2.0 * spread(self.diameter.is_some(), kind.diameter_variation),
            spread(self.axis_ratio.is_some(), kind.axis_ratio_deviation / kind.axis_ratio),
            spread(self.youngs_modulus.is_some(), MODULUS_SPREAD),
        ];
        let density = of_type.material.density();
        Ok(Fibre {
            section: Section::from_diameter(diameter, ratio)?,
            material: Material::new(young, self.shear_modulus(young), density)?,
            torsion: of_type.torsion,
            spread: deviations.iter().map(|d| d * d).sum::<f64>().sqrt(),
        })
    }

    /// Young's and shear modulus (Pa), if the first is given: their ratio is the type's.
    #[must_use]
    pub fn moduli(&self) -> Option<[f64; 2]> {
        self.youngs_modulus.map(|young| [young, self.shear_modulus(young)])
    }

    fn shear_modulus(&self, young: f64) -> f64 {
        self.hair_type.shear_modulus * young / self.hair_type.youngs_modulus
    }
}
