//! What lights the scene.

mod daylight;
mod directional;
mod environment_light;
mod environment_map;
mod error;
mod lamp;
mod setup;

use glam::Vec3;

use crate::Camera;

pub use daylight::{Daylight, SUN_RADIUS, colour_of_temperature};
pub(crate) use directional::DirectionalLights;
pub use environment_light::EnvironmentLight;
pub use environment_map::{EnvironmentMap, MAX_ENVIRONMENT_WIDTH};
pub use error::InvalidLight;
pub use lamp::{AreaLight, AreaShape, DistantLight, Lamp, PointLight, SOFTBOX};
pub use setup::{Setup, beside_camera};

/// All the lights of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights {
    /// Lamps.
    pub lamps: Vec<Lamp>,
    /// What is around.
    pub environment: EnvironmentLight,
}

impl Lights {
    /// No light.
    #[must_use]
    pub fn dark() -> Self {
        Self { lamps: Vec::new(), environment: EnvironmentLight::DARK }
    }

    /// The same light from everywhere, linear sRGB.
    #[must_use]
    pub fn even(radiance: Vec3) -> Self {
        Self {
            lamps: Vec::new(),
            environment: EnvironmentLight::Gradient { sky: radiance, ground: radiance },
        }
    }
}

impl Default for Lights {
    /// The studio for the default camera, in front of the face.
    fn default() -> Self {
        Self::studio(&Camera::default())
    }
}
