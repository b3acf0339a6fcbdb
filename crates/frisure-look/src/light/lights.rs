//! All lights of a scene.

use glam::Vec3;

use super::environment_light::EnvironmentLight;
use super::lamp::Lamp;

/// All lights of a scene: lamps and the environment light.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights {
    /// Lamps.
    pub lamps: Vec<Lamp>,
    /// The light from infinitely far away.
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
