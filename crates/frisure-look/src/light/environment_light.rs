//! The environment light: light from infinitely far away, in every direction.

use frisure_digest::digest_fields;
use glam::Vec3;

use super::environment_map::EnvironmentMap;

/// The environment light: radiance from infinitely far away, by direction.
#[derive(Clone, Debug, PartialEq)]
pub enum EnvironmentLight {
    /// A gradient from above to below, the same all around.
    Gradient {
        /// Radiance from straight above, linear sRGB; it fades into `ground` below.
        sky: Vec3,
        /// Radiance from straight below, linear sRGB.
        ground: Vec3,
    },
    /// An image of the environment.
    Map(EnvironmentMap),
}
digest_fields!(EnvironmentLight: Gradient { sky, ground }, Map(map));

impl EnvironmentLight {
    /// No light.
    pub const DARK: Self = Self::Gradient { sky: Vec3::ZERO, ground: Vec3::ZERO };

    /// Radiance (linear sRGB) from the unit direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Gradient { sky, ground } => {
                ground.lerp(*sky, (0.5 + 0.5 * towards.z).clamp(0.0, 1.0))
            }
            Self::Map(map) => map.radiance(towards),
        }
    }

    /// Radiance (linear sRGB) from the unit direction `towards`, interpolated between the pixels of a map: for
    /// backgrounds.
    #[must_use]
    pub fn radiance_interpolated(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Gradient { .. } => self.radiance(towards),
            Self::Map(map) => map.radiance_interpolated(towards),
        }
    }

    /// Mean radiance over all directions.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        match self {
            Self::Gradient { sky, ground } => 0.5 * (*sky + *ground),
            Self::Map(map) => map.mean(),
        }
    }

    /// The same, brighter by a factor that is not negative.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        match self {
            Self::Gradient { sky, ground } => {
                Self::Gradient { sky: sky * factor, ground: ground * factor }
            }
            Self::Map(map) => Self::Map(map.scaled(factor)),
        }
    }
}
