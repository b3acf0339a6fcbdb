//! Materials: hair, skin, background and floor.

use frisure_digest::digest_fields;
use glam::{DVec3, Vec3};

use crate::camera::Camera;
use crate::hair::HairLook;
use crate::light::Lights;

/// The materials of everything in a picture.
///
/// ```
/// use frisure_look::{Background, HairLook, Look, Melanin, Shade};
///
/// let auburn = Shade::named("auburn").expect("a shade of the list");
/// let hair = HairLook { melanin: auburn.melanin, white_share: 0.1, ..HairLook::default() };
/// let look = Look { hair, background: Background::Transparent, ..Look::default() };
/// // Pigment absorbs blue most, so that brown and red hair is warm.
/// let absorption = look.hair.natural();
/// assert!(absorption.z > absorption.y && absorption.y > absorption.x);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// The hair.
    pub hair: HairLook,
    /// The head it grows on.
    pub skin: SkinLook,
    /// The background.
    pub background: Background,
    /// A floor under the head; drawn by the path tracer alone.
    pub floor: Option<Floor>,
}
digest_fields!(Look { hair, skin, background, floor });

/// Appearance of the head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinLook {
    /// Diffuse reflectance, linear sRGB.
    pub colour: Vec3,
    /// Strength of its soft gloss.
    pub gloss: f32,
    /// Strength of the fine structure of skin, lips and cloth: relief, blotches, freckles, threads. 0 for smooth surfaces, 1 as in a person.
    pub texture: f32,
    /// How far red light goes beneath the skin (m): the mean distance at which it comes out again is near it. 0 for none.
    pub scatter: f32,
    /// Diffuse reflectance of the irises of a head that has open eyes, linear sRGB.
    pub iris: Vec3,
    /// Diffuse reflectance of the garment of a head that wears one, linear sRGB.
    pub garment: Vec3,
}
digest_fields!(SkinLook { colour, gloss, texture, scatter, iris, garment });

impl Default for SkinLook {
    /// The matte plastic of a training head.
    fn default() -> Self {
        Self {
            colour: Vec3::new(0.40, 0.29, 0.235),
            gloss: 0.12,
            texture: 0.0,
            // Jensen et al. 2001 (doi:10.1145/383259.383319) measured 3.67 mm for red light in skin.
            scatter: 3.7e-3,
            iris: Vec3::new(0.085, 0.045, 0.022),
            garment: Vec3::new(0.045, 0.05, 0.06),
        }
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
digest_fields!(Floor { centre, radius, colour });

/// The background of a picture.
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
    /// The environment light, by direction.
    Environment,
}
digest_fields!(Background: Transparent, Gradient { centre, corner }, Environment);

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

/// The materials of a scene; what depends on lights and geometry is still open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LookSpec {
    /// The hair.
    pub hair: HairLook,
    /// The head.
    pub skin: SkinLook,
    /// The background.
    pub backdrop: Backdrop,
    /// Diffuse reflectance of a floor under the head, linear sRGB.
    pub floor: Option<Vec3>,
}

/// The description of a background, before its lights are known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Backdrop {
    /// The studio's wall, as bright as the lights make it.
    #[default]
    Wall,
    /// Nothing: the picture's alpha is the coverage.
    Transparent,
    /// The environment light.
    Environment,
    /// A colour, linear sRGB.
    Colour(Vec3),
}

impl LookSpec {
    /// The look in these lights, for a head with its middle at `centre` (m). It has no floor yet:
    /// [`Floor::under`] makes one.
    #[must_use]
    pub fn look(&self, lights: &Lights, camera: &Camera, centre: DVec3) -> Look {
        let background = self.backdrop.background(lights, camera, centre);
        Look { hair: self.hair, skin: self.skin, background, floor: None }
    }
}

impl Backdrop {
    /// The background in these lights, behind a head with its middle at `centre` (m).
    #[must_use]
    pub fn background(self, lights: &Lights, camera: &Camera, centre: DVec3) -> Background {
        match self {
            Self::Wall => wall(lights, camera, centre),
            Self::Transparent => Background::Transparent,
            Self::Environment => Background::Environment,
            Self::Colour(colour) => Background::Gradient { centre: colour, corner: colour },
        }
    }
}

/// The studio's wall in these lights: [`Background::default`] is how it looks in the studio's own.
fn wall(lights: &Lights, camera: &Camera, middle: DVec3) -> Background {
    let studio = irradiance_on_wall(&Lights::studio(camera), camera, middle);
    let factor = irradiance_on_wall(lights, camera, middle) / studio;
    match Background::default() {
        Background::Gradient { centre, corner } => {
            Background::Gradient { centre: centre * factor, corner: corner * factor }
        }
        other => other,
    }
}

/// Irradiance on a wall that faces the camera, as far behind the head as the lamps are in front of it, so that a
/// quarter of their light arrives.
fn irradiance_on_wall(lights: &Lights, camera: &Camera, middle: DVec3) -> Vec3 {
    let lamps = lights.lamps.iter().filter_map(|lamp| lamp.arriving(middle));
    let cosine = |towards: DVec3| (-towards.dot(camera.forward())).max(0.0) as f32;
    let lamps: Vec3 = lamps.map(|(towards, light)| 0.25 * cosine(towards) * light).sum();
    lamps + std::f32::consts::PI * lights.environment.mean()
}

impl Floor {
    /// Depth to which the foot of a bust, which is round at its edge, sinks into the floor (m): it would seem to float
    /// otherwise. Chosen by eye.
    const FOOT: f64 = 0.02;

    /// Radius at which the floor has faded into the background (m); chosen by eye.
    const RADIUS: f64 = 1.6;

    /// A floor under everything from `low` to `high` (m), of which a bust stands on it (`on_foot`), of diffuse
    /// reflectance `colour`.
    #[must_use]
    pub fn under((low, high): (DVec3, DVec3), on_foot: bool, colour: Vec3) -> Self {
        let sunk = if on_foot { Self::FOOT } else { 0.0 };
        let centre = (0.5 * (low + high)).with_z(low.z + sunk);
        Self { centre, radius: Self::RADIUS, colour }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{LampPlace, LampSpec, LightSpec, Setup};

    fn wall_of(setup: Setup, strength: f64, lamps: Vec<LampSpec>) -> Vec3 {
        let camera = Camera::default();
        let spec = LightSpec {
            setup,
            direction: None,
            size: None,
            strength,
            sky_strength: strength,
            environment_rotation: 0.0,
            lamps,
        };
        let lights = spec.lights(&camera, DVec3::ZERO, None).unwrap();
        match Backdrop::Wall.background(&lights, &camera, DVec3::ZERO) {
            Background::Gradient { centre, .. } => centre,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_wall_has_the_light_of_the_setup() {
        let Background::Gradient { centre: studio, .. } = Background::default() else {
            unreachable!()
        };
        assert_eq!(wall_of(Setup::Studio, 1.0, Vec::new()), studio);
        assert_eq!(wall_of(Setup::Dark, 1.0, Vec::new()), Vec3::ZERO);
        let of = |setup| wall_of(setup, 1.0, Vec::new()).y / studio.y;
        let setups = [Setup::Soft, Setup::Studio, Setup::Butterfly, Setup::Rembrandt, Setup::Rim];
        let scale = setups.map(of);
        assert!(scale.is_sorted_by(|a, b| a > b), "{scale:?}");
        // Lamps behind the head do not reach the wall's face.
        let place = LampPlace::Far { direction: (std::f64::consts::PI, 0.0), angle: None };
        let behind = LampSpec { place, strength: 1.0, colour: Vec3::ONE };
        assert_eq!(wall_of(Setup::Dark, 1.0, vec![behind]), Vec3::ZERO);
        let twice = wall_of(Setup::Studio, 2.0, Vec::new());
        assert!((twice / studio - Vec3::splat(2.0)).abs().max_element() < 1e-5);
    }
}
