//! All lights of a scene.

use frisure_digest::digest_fields;
use glam::Vec3;

use super::environment_light::EnvironmentLight;
use super::lamp::Lamp;

/// All lights of a scene: lamps and the environment light.
///
/// ```
/// use frisure_look::{Camera, DistantLight, Lights, Setup};
/// use glam::{DVec3, Vec3};
///
/// // As photographers set them, or lamp by lamp.
/// let camera = Camera::default();
/// let mut lights = Lights::setup(&Setup::Rembrandt, &camera)?;
/// let sun = DistantLight::new(DVec3::new(1.0, -1.0, 2.0), Vec3::splat(3.0), 0.0047)?;
/// lights.lamps.push(sun.into());
/// assert_eq!(lights.lamps.len(), 4);
/// # Ok::<(), frisure_look::InvalidLight>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Lights {
    /// Lamps.
    pub lamps: Vec<Lamp>,
    /// The light from infinitely far away.
    pub environment: EnvironmentLight,
}
digest_fields!(Lights { lamps, environment });

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
