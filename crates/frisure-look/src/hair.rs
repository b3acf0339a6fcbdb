//! The material of hair.

use frisure_digest::{Digest, Digestible, digest_fields};
use glam::Vec3;

use crate::pigment::{Melanin, absorption};

/// Refractive index of keratin: the 1.55 of Marschner et al. 2003, table 1.
const HAIR_INDEX: f32 = 1.55;

/// Appearance of hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairLook {
    /// Natural pigment; a strand's `tint` multiplies it.
    pub melanin: Melanin,
    /// Instead of melanin: absorption per mean radius of the fibre, for linear sRGB.
    pub absorption: Option<Vec3>,
    /// Share of hairs without any pigment, 0 to 1: grey hair is white and dark hair mixed.
    pub white_share: f32,
    /// Standard deviation of the pigment from strand to strand, relative. Without a `tint`
    /// attribute it is all the variation there is.
    pub variation: f32,
    /// Pigment at the roots.
    pub roots: Fade,
    /// Pigment at the tips.
    pub tips: Fade,
    /// Dye on top of the pigment.
    pub dye: Option<Dye>,
    /// Surface and shape of the fibre, for light.
    pub surface: HairSurface,
    /// Seed that decides which hairs are white, dark or light.
    pub seed: u32,
    /// Whether strands that have colours of their own, the attribute `color`, are drawn in them: of all above they have the surface alone then.
    pub own_colours: bool,
}
digest_fields!(HairLook {
    melanin,
    absorption,
    white_share,
    variation,
    roots,
    tips,
    dye,
    surface,
    seed,
    own_colours
});

/// Natural pigment that differs at one end of the hairs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fade {
    /// Factor on the pigment at the end.
    pub factor: f32,
    /// Distance from the end over which it fades away (m).
    pub length: f32,
}
digest_fields!(Fade { factor, length });

impl Default for Fade {
    /// No difference.
    fn default() -> Self {
        Self { factor: 1.0, length: 0.0 }
    }
}

/// Dye: hair that is coloured on purpose, and natural again where it has grown since.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dye {
    /// Absorption of dyed hair, per mean radius, for linear sRGB
    /// ([`crate::absorption_of_colour`] computes it from a colour).
    pub absorption: Vec3,
    /// How much of the natural absorption it takes the place of, 0 to 1.
    pub strength: f32,
    /// Length from the root that has no dye (m).
    pub regrowth: f32,
}
digest_fields!(Dye { absorption, strength, regrowth });

/// Surface of the fibres, as light meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairSurface {
    /// Roughness along the fibre β_M, 0.01 to 1: how wide the highlights are.
    pub longitudinal_roughness: f32,
    /// Roughness around the fibre β_N, 0.01 to 1.
    pub azimuthal_roughness: f32,
    /// Tilt of the cuticle's scales (rad), −0.35 to 0.35.
    pub tilt: f32,
    /// Refractive index, 1.05 to 3.
    pub index: f32,
    /// How light is scattered.
    pub scattering: Scattering,
}
digest_fields!(HairSurface {
    longitudinal_roughness,
    azimuthal_roughness,
    tilt,
    index,
    scattering
});

/// A model of how a fibre scatters light, for final pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scattering {
    /// Chiang et al. 2016, with an exact ray through the elliptical section: it conserves energy.
    #[default]
    Chiang,
    /// Marschner et al. 2003, halved so that it scatters about the light that falls in, without light that is reflected more than once
    /// inside.
    Marschner,
}

impl Digestible for Scattering {
    fn add_to(&self, digest: &mut Digest) {
        let name = match self {
            Self::Chiang => "chiang",
            Self::Marschner => "marschner",
        };
        name.add_to(digest);
    }
}

impl Default for HairSurface {
    /// Clean hair: the highlight has a standard deviation of 13°, and the scales stand off by 3°. Marschner
    /// et al. 2003, table 1, has 5° to 10° for a fibre, and shifts that belong to scales of 2.5° to 5°. Fibres of a lock also stray from
    /// each other between the points of drawn hairs, by about 9° (chosen by eye), and √(10² + 9²) = 13. Around the fibre: chosen by eye.
    fn default() -> Self {
        Self {
            longitudinal_roughness: 0.25,
            azimuthal_roughness: 0.4,
            tilt: 0.0524,
            index: HAIR_INDEX,
            scattering: Scattering::Chiang,
        }
    }
}

impl HairLook {
    /// Absorption of a hair of the natural colour (per mean radius).
    #[must_use]
    pub fn natural(&self) -> Vec3 {
        self.absorption.unwrap_or_else(|| absorption(self.melanin))
    }
}

impl Default for HairLook {
    /// Brown.
    fn default() -> Self {
        Self {
            melanin: Melanin::default(),
            absorption: None,
            white_share: 0.0,
            variation: 0.18,
            roots: Fade::default(),
            tips: Fade::default(),
            dye: None,
            surface: HairSurface::default(),
            seed: 1,
            own_colours: false,
        }
    }
}
