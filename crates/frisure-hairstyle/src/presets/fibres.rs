//! The numbers of each hair type. `docs/hair-types.md` has the source of every one.

use super::hair_type::{HairType, NaturalCurl};
use crate::fibre::Wetting;

const PER_SQUARE_CENTIMETRE: f64 = 1e4;

/// Metres per second for a micrometre a day.
const MICROMETRE_PER_DAY: f64 = 1e-6 / 86_400.0;

/// Correlation length of the irregularity along a hair (m): by the eye. Chosen.
const SCALE: f64 = 0.03;

/// A helix of radius and pitch (m), with its variation between wisps and along a hair.
const fn helix(radius: f64, pitch: f64, between: f64, along: f64) -> NaturalCurl {
    NaturalCurl {
        radius,
        pitch,
        variation_between: between,
        variation_along: along,
        variation_scale: SCALE,
    }
}

/// Straight: a helix too wide for one turn.
const STRAIGHT_CURL: NaturalCurl = helix(0.12, 0.30, 0.1, 0.2);

/// Caucasian hair; what is the same for all (moduli, mass, wetting) stands here.
pub(super) const CAUCASIAN_STRAIGHT: HairType = HairType {
    density: 226.0 * PER_SQUARE_CENTIMETRE,
    diameter: 72e-6,
    diameter_variation: 0.11,
    axis_ratio: 1.41,
    axis_ratio_deviation: 0.20,
    paper_eccentricity: 0.05,
    youngs_modulus: 3.9e9,
    shear_modulus: 0.9e9,
    mass_density: 1300.0,
    friction: 0.47,
    curl: STRAIGHT_CURL,
    lift_scale: 1.0,
    growth_rate: 367.0 * MICROMETRE_PER_DAY,
    wetting: Wetting::MEASURED,
    paper_wetting: Wetting::PAPER,
};

pub(super) const CAUCASIAN_WAVY: HairType = HairType {
    axis_ratio: 1.45,
    paper_eccentricity: 0.08,
    friction: 0.54,
    curl: helix(0.012, 0.09, 0.12, 0.15),
    ..CAUCASIAN_STRAIGHT
};

pub(super) const CAUCASIAN_CURLY: HairType = HairType {
    axis_ratio: 1.50,
    paper_eccentricity: 0.1,
    friction: 0.51,
    curl: helix(0.010, 0.024, 0.12, 0.08),
    ..CAUCASIAN_STRAIGHT
};

pub(super) const ASIAN_STRAIGHT: HairType = HairType {
    density: 175.0 * PER_SQUARE_CENTIMETRE,
    diameter: 85e-6,
    axis_ratio: 1.25,
    axis_ratio_deviation: 0.20,
    paper_eccentricity: 0.0,
    lift_scale: 1.5,
    growth_rate: 411.0 * MICROMETRE_PER_DAY,
    ..CAUCASIAN_STRAIGHT
};

pub(super) const ASIAN_WAVY: HairType =
    HairType { friction: 0.54, curl: helix(0.012, 0.078, 0.12, 0.15), ..ASIAN_STRAIGHT };

pub(super) const AFRICAN_COILY: HairType = HairType {
    density: 161.0 * PER_SQUARE_CENTIMETRE,
    diameter: 74e-6,
    axis_ratio: 1.75,
    axis_ratio_deviation: 0.16,
    paper_eccentricity: 0.2,
    friction: 0.51,
    curl: helix(0.0028, 0.006, 0.25, 0.25),
    lift_scale: 0.6,
    growth_rate: 280.0 * MICROMETRE_PER_DAY,
    ..CAUCASIAN_STRAIGHT
};

pub(super) const AFRICAN_KINKY: HairType =
    HairType { curl: helix(0.0019, 0.0046, 0.3, 0.4), ..AFRICAN_COILY };

/// Hair of no one population: means of the three where there is no other number.
pub(super) const STRAIGHT: HairType = HairType {
    density: 190.0 * PER_SQUARE_CENTIMETRE,
    diameter: 75e-6,
    axis_ratio: 1.42,
    axis_ratio_deviation: 0.19,
    paper_eccentricity: 0.05,
    growth_rate: 400.0 * MICROMETRE_PER_DAY,
    ..CAUCASIAN_STRAIGHT
};

pub(super) const WAVY: HairType = HairType {
    axis_ratio: 1.51,
    paper_eccentricity: 0.1,
    friction: 0.54,
    curl: helix(0.010, 0.09, 0.12, 0.15),
    growth_rate: 370.0 * MICROMETRE_PER_DAY,
    ..STRAIGHT
};

pub(super) const CURLY: HairType = HairType {
    axis_ratio: 1.61,
    paper_eccentricity: 0.1,
    friction: 0.51,
    curl: helix(0.008, 0.020, 0.15, 0.1),
    growth_rate: 340.0 * MICROMETRE_PER_DAY,
    ..STRAIGHT
};

pub(super) const COILY: HairType = HairType {
    axis_ratio: 1.73,
    paper_eccentricity: 0.2,
    friction: 0.51,
    curl: helix(0.0040, 0.0090, 0.2, 0.2),
    lift_scale: 0.8,
    growth_rate: 300.0 * MICROMETRE_PER_DAY,
    ..STRAIGHT
};

pub(super) const KINKY: HairType = HairType {
    curl: helix(0.0021, 0.0050, 0.3, 0.4),
    lift_scale: 0.6,
    growth_rate: 270.0 * MICROMETRE_PER_DAY,
    ..COILY
};

/// Tight curls that no two neighbours share.
pub(super) const FRIZZY: HairType =
    HairType { curl: helix(0.0045, 0.012, 0.3, 0.35), lift_scale: 0.8, ..COILY };

/// The eight curl types of de la Mettrie et al. (2007), I to VIII.
pub(super) const CURL_TYPES: [HairType; 8] = [
    HairType { curl: helix(0.06, 0.20, 0.1, 0.2), growth_rate: rate(1), ..STRAIGHT },
    HairType { curl: helix(0.010, 0.10, 0.12, 0.15), growth_rate: rate(2), ..WAVY },
    HairType { curl: helix(0.011, 0.075, 0.12, 0.15), growth_rate: rate(3), ..WAVY },
    HairType { curl: helix(0.011, 0.045, 0.15, 0.12), growth_rate: rate(4), ..CURLY },
    HairType { curl: helix(0.008, 0.022, 0.15, 0.1), growth_rate: rate(5), ..CURLY },
    HairType { curl: helix(0.0052, 0.013, 0.2, 0.15), growth_rate: rate(6), ..COILY },
    HairType { curl: helix(0.0033, 0.0075, 0.2, 0.2), growth_rate: rate(7), ..COILY },
    HairType { curl: helix(0.0022, 0.0048, 0.3, 0.4), growth_rate: rate(8), ..KINKY },
];

/// Growth (m/s) of a curl type: measured from 1.3 (straight) to 0.8 cm a month (curliest).
const fn rate(curl_type: u8) -> f64 {
    let centimetres = 1.3 - 0.5 * (curl_type as f64 - 1.0) / 7.0;
    centimetres * 1e-2 / (30.44 * 86_400.0)
}
