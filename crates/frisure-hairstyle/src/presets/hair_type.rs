//! What is measured of one type of hair.

use std::f64::consts::TAU;

use frisure_rod::{InvalidQuantity, Material, Section, TorsionConstant};

use crate::fibre::{Curl, Fibre};
use crate::spec::{InvalidSpec, range};

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

/// What water makes of the properties of a hair: a factor on each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wetting {
    /// Factor on Young's modulus.
    pub youngs_modulus: f64,
    /// Factor on the shear modulus.
    pub shear_modulus: f64,
    /// Factor on the diameter.
    pub diameter: f64,
    /// Factor on the length.
    pub length: f64,
    /// Factor on the radius of wisps, and on the distances that contact keeps: a film of water draws
    /// hairs together.
    pub wisp: f64,
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

impl Wetting {
    /// The paper's: Young's modulus ÷ 5, radius + 13 %, length + 1 %, wisps − 40 %. \[paper\] §3.2.1
    ///
    /// Its shear modulus follows from Poisson's ratio, so it falls as much.
    pub const PAPER: Self =
        Self { youngs_modulus: 0.2, shear_modulus: 0.2, diameter: 1.13, length: 1.01, wisp: 0.6 };

    /// Measured in water against room-dry hair (Robbins 2012): moduli 3.9 → 1.7 GPa and
    /// 0.89 → 0.2 GPa; diameter and length from 60 % to 100 % relative humidity. Nobody measured
    /// wisps: theirs is the paper's.
    pub const MEASURED: Self = Self {
        youngs_modulus: 0.43,
        shear_modulus: 0.22,
        diameter: 1.065,
        length: 1.003,
        wisp: 0.6,
    };

    /// Checks every factor against the range in which it means something.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        let softer = "between 0.01 and 1";
        range("hair.wetting.youngs_modulus", self.youngs_modulus, 0.01, 1.0, softer)?;
        range("hair.wetting.shear_modulus", self.shear_modulus, 0.01, 1.0, softer)?;
        range("hair.wetting.diameter", self.diameter, 1.0, 1.5, "between 1 and 1.5")?;
        range("hair.wetting.length", self.length, 1.0, 1.1, "between 1 and 1.1")?;
        range("hair.wetting.wisp", self.wisp, 0.1, 1.0, "between 0.1 and 1")
    }
}
