//! Lights as a scene describes them: around a camera and a head.

use glam::{DVec3, Vec3};

use super::environment_light::EnvironmentLight;
use super::environment_map::EnvironmentMap;
use super::error::InvalidLight;
use super::lamp::{AreaLight, DistantLight, Lamp, PointLight, SOFTBOX};
use super::lights::Lights;
use super::setup::{Setup, beside_camera};
use crate::camera::Camera;

/// Irradiance of the studio's main lamp (red, green and blue alike): the unit of [`LampSpec::strength`]. Chosen.
const MAIN: f32 = 5.0;

/// The lights of a scene, relative to the camera.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSpec {
    /// How the lamps are set.
    pub setup: Setup,
    /// Direction of the main lamp from the camera's, to the right and upwards (rad); `None` is the setup's own.
    pub direction: Option<(f64, f64)>,
    /// Angle from edge to edge of the main lamp (rad); `None` is the setup's own.
    pub size: Option<f64>,
    /// Factor on all lamps.
    pub strength: f64,
    /// Factor on the environment light.
    pub sky_strength: f64,
    /// Turn of an environment map towards the head's left (rad).
    pub environment_rotation: f64,
    /// Further lamps.
    pub lamps: Vec<LampSpec>,
}

/// A lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LampSpec {
    /// Where it is, and how large.
    pub place: LampPlace,
    /// Irradiance in the middle of the head, over that of the studio's main lamp.
    pub strength: f64,
    /// Its colour, linear sRGB.
    pub colour: Vec3,
}

/// Where a lamp is, and how large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LampPlace {
    /// Very far away.
    Far {
        /// From the camera's direction to the right, and upwards (rad).
        direction: (f64, f64),
        /// Angle from edge to edge (rad); `None` is a softbox's.
        angle: Option<f64>,
    },
    /// At a distance from the middle of the head.
    Beside {
        /// From the camera's direction to the right, and upwards (rad).
        direction: (f64, f64),
        /// Distance (m).
        distance: f64,
        /// Its face; `None` for a point light.
        face: Option<LampFace>,
    },
    /// At a position.
    At {
        /// Position (m).
        position: DVec3,
        /// Its face; `None` for a point light.
        face: Option<LampFace>,
    },
}

/// The face of an area light, which points at the head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LampFace {
    /// Its outline.
    pub size: Face,
    /// Whether a traced picture shows it.
    pub shown: bool,
}

/// The outline of a face (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Face {
    /// A disc of a diameter.
    Disc(f64),
    /// A rectangle of a width and a height.
    Rectangle([f64; 2]),
}

impl LightSpec {
    /// The lights for a camera and a head with its middle at `centre` (m). Studio lamps turn with the camera; daylight
    /// and environment map stay. The environment map replaces the setup's environment light.
    ///
    /// # Errors
    /// [`InvalidLight`], for a lamp at an impossible position.
    pub fn lights(
        &self,
        camera: &Camera,
        centre: DVec3,
        environment: Option<&EnvironmentMap>,
    ) -> Result<Lights, InvalidLight> {
        let mut lights = Lights::setup(&self.setup, camera)?;
        if let Some(Lamp::Distant(main)) = lights.lamps.first_mut() {
            if let Some((azimuth, elevation)) = self.direction {
                *main = main.from_direction(beside_camera(camera, azimuth, elevation))?;
            }
            if let Some(size) = self.size {
                *main = main.with_radius(0.5 * size)?;
            }
        }
        for lamp in &self.lamps {
            lights.lamps.push(lamp.lamp(camera, centre)?);
        }
        let strength = Vec3::splat(self.strength as f32);
        for lamp in &mut lights.lamps {
            *lamp = lamp.scaled(strength)?;
        }
        if let Some(map) = environment {
            lights.environment =
                EnvironmentLight::Map(map.clone().turned(self.environment_rotation));
        }
        lights.environment = lights.environment.scaled(self.sky_strength as f32);
        Ok(lights)
    }
}

impl LampSpec {
    fn lamp(&self, camera: &Camera, centre: DVec3) -> Result<Lamp, InvalidLight> {
        let towards = |(azimuth, elevation)| beside_camera(camera, azimuth, elevation);
        let lamp: Lamp = match self.place {
            LampPlace::Far { direction, angle } => {
                let radius = angle.map_or(SOFTBOX, |angle| 0.5 * angle);
                DistantLight::new(towards(direction), Vec3::ONE, radius)?.into()
            }
            LampPlace::Beside { direction, distance, face } => {
                local(centre + distance * towards(direction), centre, face)?
            }
            LampPlace::At { position, face } => local(position, centre, face)?,
        };
        let given = lamp.arriving(centre).map_or(1.0, |(_, irradiance)| irradiance.x);
        lamp.scaled(self.colour * (MAIN * self.strength as f32 / given))
    }
}

/// A lamp at a position that points at `centre`.
fn local(at: DVec3, centre: DVec3, face: Option<LampFace>) -> Result<Lamp, InvalidLight> {
    let Some(LampFace { size, shown }) = face else {
        return Ok(PointLight::new(at, Vec3::ONE)?.into());
    };
    let facing = centre - at;
    let up =
        if facing.cross(DVec3::Z).length() > 1e-6 * facing.length() { DVec3::Z } else { DVec3::Y };
    let lamp = match size {
        Face::Disc(diameter) => AreaLight::disc(at, facing, 0.5 * diameter, Vec3::ONE)?,
        Face::Rectangle(sides) => AreaLight::rectangle(at, facing, up, sides, Vec3::ONE)?,
    };
    Ok(lamp.shown(shown).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lit(setup: Setup, direction: Option<(f64, f64)>, lamps: Vec<LampSpec>) -> Lights {
        let spec = LightSpec {
            setup,
            direction,
            size: None,
            strength: 1.0,
            sky_strength: 1.0,
            environment_rotation: 0.0,
            lamps,
        };
        spec.lights(&Camera::default(), DVec3::ZERO, None).unwrap()
    }

    #[test]
    fn the_main_lamp_stands_where_it_is_asked_for() {
        let direction = |azimuth: f64, elevation: f64| {
            let lights = lit(Setup::Studio, Some((azimuth, elevation)), Vec::new());
            lights.lamps[0].arriving(DVec3::ZERO).unwrap().0
        };
        let right = std::f64::consts::FRAC_PI_2;
        // The camera faces the face, which looks along −y.
        assert!(direction(0.0, 0.0).distance(-DVec3::Y) < 1e-12);
        assert!(direction(right, 0.0).distance(-DVec3::X) > 1.9);
        assert!(direction(0.3, right).distance(DVec3::Z) < 1e-9);
    }

    #[test]
    fn a_lamp_has_the_same_irradiance_at_every_place_and_size() {
        let direction = (0.0, 0.0);
        let face = |size| Some(LampFace { size, shown: false });
        let (disc, tall) = (Face::Disc(1.0), Face::Rectangle([0.5, 2.0]));
        let above = (0.0, std::f64::consts::FRAC_PI_2);
        let places = [
            LampPlace::Far { direction, angle: None },
            LampPlace::Far { direction, angle: Some(40_f64.to_radians()) },
            LampPlace::Beside { direction, distance: 1.0, face: None },
            LampPlace::Beside { direction, distance: 3.0, face: face(disc) },
            LampPlace::At { position: DVec3::new(0.0, -2.0, 0.0), face: face(tall) },
            LampPlace::Beside { direction: above, distance: 0.7, face: face(tall) },
        ];
        for place in places {
            let lamp = LampSpec { place, strength: 2.0, colour: Vec3::ONE };
            let lights = lit(Setup::Dark, None, vec![lamp]);
            let (towards, irradiance) = lights.lamps[0].arriving(DVec3::ZERO).unwrap();
            let expected = Vec3::splat(2.0 * MAIN);
            assert!((irradiance - expected).abs().max_element() < 1e-3, "{place:?}");
            assert!(towards.y < -0.99 || towards.z > 0.99);
        }
    }
}
