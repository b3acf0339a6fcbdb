//! Light from everywhere around.

use glam::Vec3;

use super::EnvironmentMap;

/// What surrounds the scene, infinitely far away.
#[derive(Clone, Debug, PartialEq)]
pub enum Room {
    /// A soft room: even light from each height.
    Gradient {
        /// Radiance from straight above, linear sRGB; it fades into `ground` below.
        sky: Vec3,
        /// Radiance from straight below, linear sRGB.
        ground: Vec3,
    },
    /// A picture of everything around.
    Environment(EnvironmentMap),
}

impl Room {
    /// No light.
    pub const DARK: Self = Self::Gradient { sky: Vec3::ZERO, ground: Vec3::ZERO };

    /// Radiance (linear sRGB) from the unit direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Gradient { sky, ground } => {
                ground.lerp(*sky, (0.5 + 0.5 * towards.z).clamp(0.0, 1.0))
            }
            Self::Environment(map) => map.radiance(towards),
        }
    }

    /// Radiance (linear sRGB) as an eye should see it from the unit direction `towards`: without the edges of
    /// a picture's pixels.
    #[must_use]
    pub fn seen(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Gradient { .. } => self.radiance(towards),
            Self::Environment(map) => map.seen(towards),
        }
    }

    /// Mean radiance over all directions.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        match self {
            Self::Gradient { sky, ground } => 0.5 * (*sky + *ground),
            Self::Environment(map) => map.mean(),
        }
    }

    /// The same, brighter by a factor that is not negative.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        match self {
            Self::Gradient { sky, ground } => {
                Self::Gradient { sky: sky * factor, ground: ground * factor }
            }
            Self::Environment(map) => Self::Environment(map.scaled(factor)),
        }
    }
}
