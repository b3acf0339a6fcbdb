//! What one fibre is: section, material, natural curl.

use std::f64::consts::TAU;

use frisure_digest::digestible;
use frisure_rod::{InvalidQuantity, Material, Section, TorsionConstant};
use glam::DVec3;

use crate::random::Stream;
use crate::rod_digest::{add_material, add_section, add_torsion};

digestible! {
    /// Section and material of the fibres of a head.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Fibre {
        /// Elliptical section.
        pub section: Section => add_section,
        /// Elastic moduli and density.
        pub material: Material => add_material,
        /// Which torsion constant the section is given.
        pub torsion: TorsionConstant => add_torsion,
        /// Standard deviation of the diameter between hairs, as a fraction of the mean.
        pub variation: f64,
        /// Standard deviation between hairs of what the axis ratio exceeds 1 by, as a fraction of the
        /// mean: a circle stays one.
        pub axis_ratio_variation: f64,
        /// Standard deviations between guides, which stand for the mean hairs of their wisps, over those between hairs, 0 to 1.
        pub coherence: f64,
    }
}

/// How much less the mean hairs of wisps differ than hairs. The means of n hairs that have nothing in common differ by 1/√n, 0.05 for
/// a wisp of 450; neighbours are more alike than that, but nothing is measured. Chosen by eye: with 1, single wisps stand off a head of
/// straight hair.
pub(crate) const COHERENCE: f64 = 0.25;

impl Fibre {
    /// The section of the mean hair of one wisp, which is that of its guide.
    ///
    /// # Errors
    /// As [`Fibre::varied`].
    pub(crate) fn of_wisp(&self, random: &mut Stream) -> Result<Section, InvalidQuantity> {
        let variation = self.coherence * self.variation;
        let axis_ratio_variation = self.coherence * self.axis_ratio_variation;
        Self { variation, axis_ratio_variation, ..*self }.varied(random)
    }

    /// The section of one hair.
    ///
    /// # Errors
    /// [`InvalidQuantity`] if the mean section and its variation make none.
    pub(crate) fn varied(&self, random: &mut Stream) -> Result<Section, InvalidQuantity> {
        let diameter = 2.0 * self.section.mean_radius() * random.positive(self.variation);
        // Varied above 1, so that no section turns its axes.
        let excess = (self.section.axis_ratio() - 1.0) * random.positive(self.axis_ratio_variation);
        let section = Section::from_diameter(diameter, 1.0 + excess)?;
        // The longer axis stays where the mean section has it.
        let flat = self.section.a() >= self.section.b();
        if flat { Ok(section) } else { Section::from_semi_axes(section.b(), section.a()) }
    }
}

/// Which way curls turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Handedness {
    /// Each wisp as the strain says, or its mirror image, with equal chance.
    #[default]
    Random,
    /// All as the natural strain says.
    AsGiven,
}

digestible! {
    /// The natural curl of the wisps of a head, and how it varies along a hair and between wisps.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Curl {
        /// Mean natural strain (κ1⁰, κ2⁰, τ⁰) (rad/m), in the material frame.
        pub strain: DVec3,
        /// Which way curls turn.
        pub handedness: Handedness,
        /// Standard deviation of the strain's magnitude between wisps, as a fraction of the mean.
        pub variation_between: f64,
        /// Standard deviation of the strain along a hair, as a fraction of its magnitude.
        pub variation_along: f64,
        /// Correlation length of the variation along a hair (m).
        pub variation_scale: f64,
    }
}

impl Curl {
    /// Perfectly straight hair.
    pub const STRAIGHT: Self = Self {
        strain: DVec3::ZERO,
        handedness: Handedness::Random,
        variation_between: 0.0,
        variation_along: 0.0,
        variation_scale: 0.03,
    };

    /// A curl of radius `radius` (m) and pitch `pitch` (m per turn), without variation.
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the radius is positive and both are finite.
    pub fn helix(radius: f64, pitch: f64) -> Result<Self, InvalidQuantity> {
        let natural = frisure_rod::NaturalStrain::helix(radius, pitch)?;
        Ok(Self { strain: natural.at(0.0), ..Self::STRAIGHT })
    }

    /// Radius (m) and pitch (m per turn, 0 for a planar curl) of the mean natural helix; `None`
    /// for straight hair. The curvature is that of κ1⁰ and κ2⁰ together.
    #[must_use]
    pub fn radius_pitch(&self) -> Option<(f64, f64)> {
        let curvature = self.strain.truncate().length();
        let square = self.strain.length_squared();
        (curvature > 0.0).then(|| (curvature / square, TAU * self.strain.z / square))
    }
}

digestible! {
    /// The factors of the wet law: what full wetting makes of each property of a hair (swelling, softening, lengthening).
    ///
    /// `styling/wet_law.rs` applies them; [`Moisture`](crate::presets::Moisture) has the shares of them that humid air does.
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
        /// hairs together. Only of [`WetLocks::Factor`].
        pub wisp: f64,
        /// What draws wet hairs together.
        pub locks: WetLocks,
    }
}

/// What makes locks of wet hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WetLocks {
    /// Wisps are thinner by [`Wetting::wisp`], and their hairs lie as dry ones do. \[paper\] §3.2.1
    Factor,
    /// Hairs gather into locks by the surface tension of water ([`crate::capillary`]), and wisps are as much thinner as that
    /// makes them.
    Capillary,
}

impl Wetting {
    /// The paper's: Young's modulus ÷ 5, radius + 13 %, length + 1 %, wisps − 40 %. \[paper\] §3.2.1
    ///
    /// Its shear modulus follows from Poisson's ratio, so it falls as much.
    pub const PAPER: Self = Self {
        youngs_modulus: 0.2,
        shear_modulus: 0.2,
        diameter: 1.13,
        length: 1.01,
        wisp: 0.6,
        locks: WetLocks::Factor,
    };

    /// Measured in water against room-dry hair (Robbins 2012): moduli 3.9 → 1.7 GPa and
    /// 0.89 → 0.2 GPa; diameter and length from 60 % to 100 % relative humidity. Nobody measured
    /// wisps: theirs is the paper's.
    pub const MEASURED: Self = Self {
        youngs_modulus: 0.43,
        shear_modulus: 0.22,
        diameter: 1.065,
        length: 1.003,
        wisp: 0.6,
        locks: WetLocks::Factor,
    };
}
