//! What is measured of one type of hair.

use std::f64::consts::TAU;

use frisure_rod::{InvalidQuantity, Material, Section, TorsionConstant};

use crate::fibre::{COHERENCE, Curl, Fibre, Wetting};

/// What is known of one type of hair, dry at about 60 % relative humidity: numbers of fibre and
/// follicle, without any styling. The source of each number is in `docs/hair-types.md`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairType {
    /// Hairs per area of scalp (1/m²).
    pub density: f64,
    /// Mean diameter, that of a circle of the same area (m).
    pub diameter: f64,
    /// Standard deviation of the diameter between the hairs of a head, as a fraction.
    pub diameter_variation: f64,
    /// Mean ratio of the longer to the shorter axis of the section, as measured.
    pub axis_ratio: f64,
    /// Standard deviation of the axis ratio between hairs.
    pub axis_ratio_deviation: f64,
    /// Eccentricity ε that the paper gives such hair. \[paper\] §3.3
    pub paper_eccentricity: f64,
    /// Young's modulus (Pa).
    pub youngs_modulus: f64,
    /// Shear modulus (Pa).
    pub shear_modulus: f64,
    /// Mass per volume (kg/m³).
    pub mass_density: f64,
    /// Coefficient of friction of dry hair against a probe.
    pub friction: f64,
    /// The natural curl.
    pub curl: NaturalCurl,
    /// Factor on the measured angles between hair and skin.
    pub lift_scale: f64,
    /// Growth (m/s).
    pub growth_rate: f64,
    /// What wetting does, as measured.
    pub wetting: Wetting,
    /// What wetting does, as in the paper.
    pub paper_wetting: Wetting,
}

/// A helix, and how hair departs from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NaturalCurl {
    /// Radius of the helix (m).
    pub radius: f64,
    /// Advance of the helix per turn (m).
    pub pitch: f64,
    /// Standard deviation of the strain between wisps, as a fraction.
    pub variation_between: f64,
    /// Standard deviation of the strain along a hair, as a fraction.
    pub variation_along: f64,
    /// Correlation length of the variation along a hair (m).
    pub variation_scale: f64,
}

/// Which of a type's two shapes of the section is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ellipticity {
    /// The measured axis ratio, with its spread.
    #[default]
    Measured,
    /// The paper's eccentricity, which makes every section nearly a circle.
    Paper,
}

impl HairType {
    /// Section and material, with how the section varies between hairs.
    ///
    /// # Errors
    /// [`InvalidQuantity`] for numbers that make no fibre; those of the presets do.
    pub fn fibre(&self, ellipticity: Ellipticity) -> Result<Fibre, InvalidQuantity> {
        Ok(Fibre {
            section: self.section(ellipticity)?,
            material: Material::new(self.youngs_modulus, self.shear_modulus, self.mass_density)?,
            torsion: TorsionConstant::SaintVenant,
            variation: self.diameter_variation,
            axis_ratio_variation: match ellipticity {
                Ellipticity::Measured if self.axis_ratio > 1.0 => {
                    self.axis_ratio_deviation / (self.axis_ratio - 1.0)
                }
                Ellipticity::Measured | Ellipticity::Paper => 0.0,
            },
            coherence: COHERENCE,
        })
    }

    fn section(&self, ellipticity: Ellipticity) -> Result<Section, InvalidQuantity> {
        match ellipticity {
            Ellipticity::Measured => Section::from_diameter(self.diameter, self.axis_ratio),
            Ellipticity::Paper => {
                Section::from_mean_radius(0.5 * self.diameter, self.paper_eccentricity)
            }
        }
    }
}

impl NaturalCurl {
    /// The curl with its variation.
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the radius is positive and all is finite.
    pub fn curl(&self) -> Result<Curl, InvalidQuantity> {
        Ok(Curl {
            variation_between: self.variation_between,
            variation_along: self.variation_along,
            variation_scale: self.variation_scale,
            ..Curl::helix(self.radius, self.pitch)?
        })
    }

    /// Curvature κ of the helix (1/m).
    #[must_use]
    pub fn curvature(&self) -> f64 {
        let advance = self.pitch / TAU;
        self.radius / (self.radius * self.radius + advance * advance)
    }

    /// Curve diameter (m) as it is measured: hair laid flat keeps its curvature, and the circle that
    /// it follows has the diameter 2/κ (de la Mettrie et al. 2007).
    #[must_use]
    pub fn curve_diameter(&self) -> f64 {
        2.0 / self.curvature()
    }

    /// Curl index: length along the hair over the distance that it spans.
    #[must_use]
    pub fn curl_index(&self) -> f64 {
        (TAU * self.radius / self.pitch).hypot(1.0)
    }

    /// Turns of the helix per length of hair (1/m).
    #[must_use]
    pub fn turns_per_length(&self) -> f64 {
        (TAU * self.radius).hypot(self.pitch).recip()
    }
}
