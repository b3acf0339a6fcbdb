//! What things are made of, as far as a picture can tell.

use frisure_optics::{LobeShape, Melanin};
use glam::{DVec3, Vec3};

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
    pub ground: Option<Ground>,
}

/// Appearance of hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairLook {
    /// Pigment; a strand's `tint` multiplies it.
    pub melanin: Melanin,
    /// Widths and shifts of the highlights.
    pub lobes: LobeShape,
    /// Strength of the white highlight; 1 is what the fibre's surface reflects.
    pub primary: f32,
    /// Strength of the coloured highlight; 1 is what the fibre returns.
    pub secondary: f32,
    /// Strength of the glow against the light; 1 is what the fibre lets through.
    pub transmission: f32,
    /// Strength of the diffuse light (many bounces between hairs); 1 is the model's estimate.
    pub diffuse: f32,
    /// Standard deviation of the pigment from strand to strand, relative. Without a `tint`
    /// attribute it is all the variation there is.
    pub variation: f32,
}

impl Default for HairLook {
    fn default() -> Self {
        Self {
            melanin: Melanin::default(),
            lobes: LobeShape::default(),
            // The lobes leave out the rise of reflection at grazing angles.
            primary: 1.4,
            secondary: 1.0,
            // What goes through once mostly meets another hair, which a preview does not follow.
            transmission: 0.6,
            diffuse: 1.0,
            variation: 0.18,
        }
    }
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
pub struct Ground {
    /// Its middle (m): the place under the head.
    pub middle: DVec3,
    /// Distance from the middle (m) at which only the background is seen.
    pub reach: f64,
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
    /// What lights the scene: sky and ground.
    Surroundings,
}

impl Default for Background {
    fn default() -> Self {
        Self::Gradient { centre: Vec3::new(0.46, 0.47, 0.48), corner: Vec3::new(0.17, 0.18, 0.195) }
    }
}

impl Background {
    /// Radiance (premultiplied) and alpha at `u`, `v`, from −1 to 1 across the picture; nothing where
    /// the direction decides.
    pub(crate) fn at(&self, u: f32, v: f32) -> (Vec3, f32) {
        match *self {
            Self::Transparent | Self::Surroundings => (Vec3::ZERO, 0.0),
            Self::Gradient { centre, corner } => {
                let r = (0.5 * (u * u + v * v)).min(1.0);
                (centre.lerp(corner, r * (2.0 - r)), 1.0)
            }
        }
    }
}
