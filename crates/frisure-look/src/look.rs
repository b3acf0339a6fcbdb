//! Materials: hair, skin, background and floor.

use glam::{DVec3, Vec3};

use crate::hair::HairLook;

/// Appearance of everything in a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// The hair.
    pub hair: HairLook,
    /// The head it grows on.
    pub skin: SkinLook,
    /// What is behind.
    pub background: Background,
    /// A floor under the head; drawn by the path tracer alone.
    pub floor: Option<Floor>,
}

/// Appearance of the head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinLook {
    /// Diffuse reflectance, linear sRGB.
    pub colour: Vec3,
    /// Strength of its soft gloss.
    pub gloss: f32,
}

impl Default for SkinLook {
    /// The matte plastic of a training head.
    fn default() -> Self {
        Self { colour: Vec3::new(0.40, 0.29, 0.235), gloss: 0.12 }
    }
}

/// A level floor, lit and shaded like everything else, that is lost in the background far from its
/// middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// Its middle (m): the place under the head.
    pub centre: DVec3,
    /// Distance from the middle (m) at which only the background is seen.
    pub radius: f64,
    /// Diffuse reflectance, linear sRGB.
    pub colour: Vec3,
}

/// What is behind the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// Nothing: the picture's alpha is the coverage.
    Transparent,
    /// A wall lit from the middle: radiance at the picture's centre and at its corners, linear sRGB.
    Gradient {
        /// Radiance at the centre.
        centre: Vec3,
        /// Radiance at the corners.
        corner: Vec3,
    },
    /// What is around the scene and lights it, as the direction has it.
    Environment,
}

impl Default for Background {
    fn default() -> Self {
        Self::Gradient { centre: Vec3::new(0.46, 0.47, 0.48), corner: Vec3::new(0.17, 0.18, 0.195) }
    }
}

impl Background {
    /// Radiance (premultiplied) and alpha at `u`, `v`, from −1 to 1 across the picture; nothing where
    /// the direction decides.
    #[must_use]
    pub fn at(&self, u: f32, v: f32) -> (Vec3, f32) {
        match *self {
            Self::Transparent | Self::Environment => (Vec3::ZERO, 0.0),
            Self::Gradient { centre, corner } => {
                let r = (0.5 * (u * u + v * v)).min(1.0);
                (centre.lerp(corner, r * (2.0 - r)), 1.0)
            }
        }
    }
}
