//! Melanin, the absorption it causes, and the colour that a head of such hair appears to have.

use frisure_digest::digest_fields;
use glam::Vec3;

/// Absorption of eumelanin at concentration 1, per fibre radius, for linear sRGB.
///
/// The coefficients of d'Eon et al. 2011, as `pbrt-v3` prints them (its book, §"A model of hair
/// scattering": "hair color and pigmentation").
const EUMELANIN: Vec3 = Vec3::new(0.419, 0.697, 1.37);

/// Absorption of pheomelanin at concentration 1, per fibre radius; source as for eumelanin.
const PHEOMELANIN: Vec3 = Vec3::new(0.187, 0.4, 1.05);

/// The two pigments of hair, as concentrations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Melanin {
    /// Eumelanin, black-brown: about 0.1 blond, 0.8 brown, 3 black; 0 white.
    pub eumelanin: f32,
    /// Pheomelanin, yellow-red: 0 in most hair, about 1 in red hair with little eumelanin.
    pub pheomelanin: f32,
}
digest_fields!(Melanin { eumelanin, pheomelanin });

impl Default for Melanin {
    /// Brown.
    fn default() -> Self {
        Self::BROWN
    }
}

impl Melanin {
    /// Fair hair.
    pub const BLOND: Self = Self { eumelanin: 0.09, pheomelanin: 0.03 };
    /// Red hair.
    pub const RED: Self = Self { eumelanin: 0.08, pheomelanin: 1.1 };
    /// Brown hair.
    pub const BROWN: Self = Self { eumelanin: 0.8, pheomelanin: 0.0 };
    /// Black hair.
    pub const BLACK: Self = Self { eumelanin: 8.0, pheomelanin: 0.0 };
    /// Hair without pigment.
    pub const WHITE: Self = Self { eumelanin: 0.0, pheomelanin: 0.0 };

    /// The same pigments in another amount.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        Self { eumelanin: self.eumelanin * factor, pheomelanin: self.pheomelanin * factor }
    }
}

/// Absorption coefficient of the fibre's inside, per fibre radius, for linear sRGB.
///
/// Concentrations below zero, or not a number, count as zero.
#[must_use]
pub fn absorption(melanin: Melanin) -> Vec3 {
    melanin.eumelanin.max(0.0) * EUMELANIN + melanin.pheomelanin.max(0.0) * PHEOMELANIN
}

/// Colour (linear sRGB, 0 to 1) that *much* hair of absorption `sigma_a` (per radius) appears to
/// have under light from everywhere, after all its bounces.
///
/// The inverse of the fit by Chiang et al. 2016, §4.2, eq. (9): σ_a = (ln C / d(β_N))², with β_N
/// the azimuthal roughness (0.3 is ordinary hair). Its polynomial was compared term by term with
/// the one in `pbrt-v3`; the equation number is from memory.
#[must_use]
pub fn apparent_colour(sigma_a: Vec3, azimuthal_roughness: f32) -> Vec3 {
    let decay = reflectance_decay(azimuthal_roughness);
    sigma_a.max(Vec3::ZERO).map(|s| (-s.sqrt() * decay).exp())
}

/// Absorption per radius of hair that in quantity appears to have `colour` (linear sRGB): the inverse
/// of [`apparent_colour`], so for a measured reflectance or the colour of a dye.
///
/// Channels outside 0.001 to 1, or not numbers, count as the nearest of these.
#[must_use]
pub fn absorption_of_colour(colour: Vec3, azimuthal_roughness: f32) -> Vec3 {
    let decay = reflectance_decay(azimuthal_roughness);
    // `clamp` would keep NaN.
    #[expect(clippy::manual_clamp)]
    colour.map(|c| (c.max(1e-3).min(1.0).ln() / decay).powi(2))
}

/// d(β_N) of Chiang et al. 2016.
fn reflectance_decay(b: f32) -> f32 {
    5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_pigment_is_white_and_more_is_darker() {
        assert_eq!(apparent_colour(absorption(Melanin::WHITE), 0.3), Vec3::ONE);
        let of = |m| apparent_colour(absorption(m), 0.3);
        let shades = [Melanin::WHITE, Melanin::BLOND, Melanin::BROWN, Melanin::BLACK].map(of);
        for pair in shades.windows(2) {
            assert!(pair[1].cmplt(pair[0]).all(), "{pair:?}");
        }
    }

    #[test]
    fn pigment_takes_blue_first() {
        for melanin in [Melanin::BLOND, Melanin::BROWN, Melanin::RED] {
            let colour = apparent_colour(absorption(melanin), 0.3);
            assert!(colour.x > colour.y && colour.y > colour.z, "{colour}");
        }
    }

    #[test]
    fn red_hair_is_redder_than_brown() {
        let ratio = |m| {
            let c = apparent_colour(absorption(m), 0.3);
            c.x / c.y
        };
        assert!(ratio(Melanin::RED) > ratio(Melanin::BLOND));
    }

    #[test]
    fn absorption_is_linear_and_refuses_nothing() {
        let two = Melanin { eumelanin: 1.0, pheomelanin: 2.0 };
        assert_eq!(absorption(two), EUMELANIN + 2.0 * PHEOMELANIN);
        assert_eq!(absorption(Melanin { eumelanin: f32::NAN, pheomelanin: -1.0 }), Vec3::ZERO);
    }

    #[test]
    fn a_colour_gives_the_absorption_that_gives_it() {
        for roughness in [0.2, 0.3, 0.8] {
            let colour = Vec3::new(0.7, 0.35, 0.05);
            let back = apparent_colour(absorption_of_colour(colour, roughness), roughness);
            assert!((back - colour).abs().max_element() < 1e-5);
        }
        assert_eq!(absorption_of_colour(Vec3::splat(3.0), 0.3), Vec3::ZERO);
        assert!(absorption_of_colour(Vec3::new(-1.0, 0.0, f32::NAN), 0.3).is_finite());
    }

    #[test]
    fn colour_mapping_inverts_the_published_fit() {
        // σ_a = (ln C / d)², evaluated from the published polynomial at β = 0.3 in f64.
        let decay = 5.969 - 0.215 * 0.3 + 2.532 * 0.09 - 10.73 * 0.027
            + 5.574 * 0.0081
            + 0.245 * 0.00243_f64;
        let c = 0.2_f64;
        let sigma = (c.ln() / decay).powi(2);
        let back = apparent_colour(Vec3::splat(sigma as f32), 0.3);
        assert!((f64::from(back.x) - c).abs() < 1e-6);
    }
}
