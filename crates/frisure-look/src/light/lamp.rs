//! Lamps: distant lights, point lights and area lights.

use std::f64::consts::{FRAC_PI_2, PI};

use frisure_digest::digest_fields;
use glam::{DVec3, Vec3};

use super::error::{InvalidLight, amount, direction, place, within};

/// Angular radius of a softbox of 1.2 m two metres away (rad).
pub const SOFTBOX: f64 = 0.3;

/// Any lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lamp {
    /// One very far away.
    Distant(DistantLight),
    /// One at a place, of no size.
    Point(PointLight),
    /// One with a face that shines.
    Area(AreaLight),
}
digest_fields!(Lamp: Distant(light), Point(light), Area(light));

/// Light from very far away: the sun, or a studio lamp seen from a head. It fills a disc of even
/// radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistantLight {
    direction: DVec3,
    irradiance: Vec3,
    radius: f64,
}
digest_fields!(DistantLight { direction, irradiance, radius });

/// A point light, which shines the same in all directions: a delta light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    position: DVec3,
    intensity: Vec3,
}
digest_fields!(PointLight { position, intensity });

/// A flat lamp that shines from one side, the same from each place and in each direction. Light
/// passes through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaLight {
    shape: AreaShape,
    centre: DVec3,
    /// From the centre to the edge, at right angles (m).
    arms: [DVec3; 2],
    facing: DVec3,
    radiance: Vec3,
    shown: bool,
}
digest_fields!(AreaLight { shape, centre, arms, facing, radiance, shown });

/// The outline of an area light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AreaShape {
    /// A circle.
    Disc,
    /// A rectangle.
    Rectangle,
}
digest_fields!(AreaShape: Disc, Rectangle);

impl DistantLight {
    /// Light from `direction` (from the scene *to* the light; need not be a unit vector) that is seen
    /// under `radius`, half the angle from edge to edge (rad), at most π/2; below 1e-4 it is a delta light. `irradiance` is that of a surface that faces it, linear sRGB: π makes a white
    /// wall 1.
    ///
    /// # Errors
    /// [`InvalidLight`].
    pub fn new(dir: DVec3, irradiance: Vec3, radius: f64) -> Result<Self, InvalidLight> {
        let direction = direction("the lamp's direction", dir)?;
        let irradiance = amount("the lamp's irradiance", irradiance)?;
        Self { direction, irradiance, radius: 0.0 }.with_radius(radius)
    }

    /// Unit direction from the scene *to* the light.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// Irradiance on a surface that faces the light, linear sRGB.
    #[must_use]
    pub fn irradiance(&self) -> Vec3 {
        self.irradiance
    }

    /// Half the angle from edge to edge (rad).
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The same light from another direction.
    ///
    /// # Errors
    /// [`InvalidLight`], if the direction has no length or is not finite.
    pub fn from_direction(self, dir: DVec3) -> Result<Self, InvalidLight> {
        Ok(Self { direction: direction("the lamp's direction", dir)?, ..self })
    }

    /// The same irradiance from a disc of another radius (rad).
    ///
    /// # Errors
    /// [`InvalidLight`], if it is not between 0 and π/2.
    pub fn with_radius(self, radius: f64) -> Result<Self, InvalidLight> {
        let allowed = "between 0 and pi/2 rad";
        let radius = within("the lamp's angular radius", radius, (0.0, FRAC_PI_2), allowed)?;
        Ok(Self { radius, ..self })
    }
}

impl PointLight {
    /// A lamp at `position` (m) of an `intensity` (irradiance times square metres, linear sRGB).
    ///
    /// # Errors
    /// [`InvalidLight`].
    pub fn new(position: DVec3, intensity: Vec3) -> Result<Self, InvalidLight> {
        let position = place("the lamp's position", position)?;
        Ok(Self { position, intensity: amount("the lamp's intensity", intensity)? })
    }

    /// Position (m).
    #[must_use]
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Irradiance that it gives at a metre, linear sRGB.
    #[must_use]
    pub fn intensity(&self) -> Vec3 {
        self.intensity
    }
}

/// Least and greatest size of an area light (m); chosen.
const SIZES: (f64, f64) = (1e-4, 1e3);

/// [`SIZES`] in words.
const SIZE: &str = "between 0.1 mm and 1 km";

impl AreaLight {
    /// A disc of `radius` (m) about `position` (m) that shines in the direction `facing`.
    ///
    /// # Errors
    /// [`InvalidLight`].
    pub fn disc(
        position: DVec3,
        facing: DVec3,
        radius: f64,
        radiance: Vec3,
    ) -> Result<Self, InvalidLight> {
        let radius = within("the lamp's radius", radius, SIZES, SIZE)?;
        let facing = direction("where the lamp faces", facing)?;
        let (x, y) = facing.any_orthonormal_pair();
        Self::new(AreaShape::Disc, position, facing, [x * radius, y * radius], radiance)
    }

    /// A rectangle of `width` and `height` (m) about `position` (m) that shines in the direction
    /// `facing`; its height is along `up`, as far as that is across `facing`.
    ///
    /// # Errors
    /// [`InvalidLight`], also if `up` is along `facing`.
    pub fn rectangle(
        position: DVec3,
        facing: DVec3,
        up: DVec3,
        [width, height]: [f64; 2],
        radiance: Vec3,
    ) -> Result<Self, InvalidLight> {
        let width = within("the lamp's width", width, SIZES, SIZE)?;
        let height = within("the lamp's height", height, SIZES, SIZE)?;
        let facing = direction("where the lamp faces", facing)?;
        let across = direction("the lamp's upward direction across its facing", up.cross(facing))?;
        let arms = [across * (0.5 * width), facing.cross(across) * (0.5 * height)];
        Self::new(AreaShape::Rectangle, position, facing, arms, radiance)
    }

    fn new(
        shape: AreaShape,
        position: DVec3,
        facing: DVec3,
        arms: [DVec3; 2],
        radiance: Vec3,
    ) -> Result<Self, InvalidLight> {
        let centre = place("the lamp's position", position)?;
        let radiance = amount("the lamp's radiance", radiance)?;
        Ok(Self { shape, centre, arms, facing, radiance, shown: false })
    }

    /// The same lamp, visible in the picture or not; a new lamp is not.
    #[must_use]
    pub fn shown(self, shown: bool) -> Self {
        Self { shown, ..self }
    }

    /// Whether it is visible in the picture.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        self.shown
    }

    /// Its outline.
    #[must_use]
    pub fn shape(&self) -> AreaShape {
        self.shape
    }

    /// Its middle (m).
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// From the middle to the edge, at right angles (m).
    #[must_use]
    pub fn arms(&self) -> [DVec3; 2] {
        self.arms
    }

    /// Unit direction in which it shines.
    #[must_use]
    pub fn facing(&self) -> DVec3 {
        self.facing
    }

    /// Radiance from its face, linear sRGB.
    #[must_use]
    pub fn radiance(&self) -> Vec3 {
        self.radiance
    }

    /// Area of its face (m²).
    #[must_use]
    pub fn area(&self) -> f64 {
        let [x, y] = self.arms.map(DVec3::length);
        match self.shape {
            AreaShape::Disc => PI * x * y,
            AreaShape::Rectangle => 4.0 * x * y,
        }
    }

    /// Irradiance at `distance` (m) straight in front of the middle, over the radiance (sr).
    #[must_use]
    pub fn form_factor(&self, distance: f64) -> f64 {
        let [x, y] = self.arms.map(|arm| arm.length() / distance.max(1e-9));
        match self.shape {
            // π sin² of the angular radius, exact on the axis.
            AreaShape::Disc => PI * x * x / (1.0 + x * x),
            AreaShape::Rectangle => {
                // Four times a rectangle seen from above its corner.
                let side = |a: f64, b: f64| {
                    let root = a.hypot(1.0);
                    a / root * (b / root).atan()
                };
                2.0 * (side(x, y) + side(y, x))
            }
        }
    }
}

impl Lamp {
    /// The same lamp, brighter by a factor in each of red, green and blue.
    ///
    /// # Errors
    /// [`InvalidLight`], if it would be brighter than any or negative.
    pub fn scaled(self, factor: Vec3) -> Result<Self, InvalidLight> {
        let times = |light: Vec3| amount("the lamp's light", light * factor);
        Ok(match self {
            Self::Distant(l) => {
                Self::Distant(DistantLight { irradiance: times(l.irradiance)?, ..l })
            }
            Self::Point(l) => Self::Point(PointLight { intensity: times(l.intensity)?, ..l }),
            Self::Area(l) => Self::Area(AreaLight { radiance: times(l.radiance)?, ..l }),
        })
    }

    /// Unit direction to the lamp's middle from a place (m), and the irradiance of a surface there
    /// that faces it; `None` if no light gets there. Of an area light seen at an angle this is an
    /// estimate.
    #[must_use]
    pub fn arriving(&self, at: DVec3) -> Option<(DVec3, Vec3)> {
        match self {
            Self::Distant(lamp) => Some((lamp.direction, lamp.irradiance)),
            Self::Point(lamp) => {
                let way = lamp.position - at;
                let towards = way.try_normalize()?;
                Some((towards, lamp.intensity / way.length_squared().max(1e-12) as f32))
            }
            Self::Area(lamp) => {
                let way = lamp.centre - at;
                let towards = way.try_normalize()?;
                let seen = -towards.dot(lamp.facing) * lamp.form_factor(way.length());
                (seen > 0.0).then(|| (towards, lamp.radiance * seen as f32))
            }
        }
    }
}

impl From<DistantLight> for Lamp {
    fn from(lamp: DistantLight) -> Self {
        Self::Distant(lamp)
    }
}

impl From<PointLight> for Lamp {
    fn from(lamp: PointLight) -> Self {
        Self::Point(lamp)
    }
}

impl From<AreaLight> for Lamp {
    fn from(lamp: AreaLight) -> Self {
        Self::Area(lamp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_lamps_are_refused_with_what_is_wrong() {
        let (z, one) = (DVec3::Z, Vec3::ONE);
        let says = |error: InvalidLight, part: &str| {
            assert!(error.to_string().contains(part), "{error}");
        };
        says(DistantLight::new(DVec3::ZERO, one, 0.1).unwrap_err(), "direction is [0, 0, 0]");
        says(DistantLight::new(z, -one, 0.1).unwrap_err(), "irradiance is [-1, -1, -1]");
        says(DistantLight::new(z, one, 1.6).unwrap_err(), "1.6; it must be between 0 and pi/2");
        says(DistantLight::new(z, one, f64::NAN).unwrap_err(), "NaN");
        says(PointLight::new(z * f64::INFINITY, one).unwrap_err(), "position");
        says(PointLight::new(z, Vec3::NAN).unwrap_err(), "intensity");
        says(AreaLight::disc(z, -z, 0.0, one).unwrap_err(), "radius is 0");
        says(AreaLight::disc(z, DVec3::NAN, 1.0, one).unwrap_err(), "faces");
        let rectangle = |up, size| AreaLight::rectangle(z, -z, up, size, one);
        says(rectangle(z, [1.0; 2]).unwrap_err(), "upward");
        says(rectangle(DVec3::X, [-1.0, 1.0]).unwrap_err(), "width is -1");
        assert!(rectangle(DVec3::X, [1.0, 2.0]).is_ok());
        assert!(Lamp::from(PointLight::new(z, one).unwrap()).scaled(-one).is_err());
    }

    #[test]
    fn a_small_face_shines_as_its_area_and_a_vast_one_as_the_sky() {
        for size in [1e-3, 1e3] {
            let disc = AreaLight::disc(DVec3::Z, -DVec3::Z, 0.5 * size, Vec3::ONE).unwrap();
            let square =
                AreaLight::rectangle(DVec3::Z, -DVec3::Z, DVec3::X, [size; 2], Vec3::ONE).unwrap();
            for lamp in [disc, square] {
                let expected = if size < 1.0 { lamp.area() } else { PI };
                assert!((lamp.form_factor(1.0) / expected - 1.0).abs() < 1e-5, "{lamp:?}");
            }
        }
    }
}
