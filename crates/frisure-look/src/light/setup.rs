//! Lights that photographers set, around a camera.

use glam::{DVec3, Vec3};

use super::daylight::Daylight;
use super::environment_light::EnvironmentLight;
use super::error::InvalidLight;
use super::lamp::{DistantLight, SOFTBOX};
use super::lights::Lights;
use crate::camera::Camera;

/// A way to set the lights.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Setup {
    /// A main light high at the left, a weak fill at the right, a rim light behind, a soft ambient light.
    #[default]
    Studio,
    /// Large soft lights from the front with a bright environment: colour more than form.
    Soft,
    /// One light before the face and above it, and a weak one below: symmetrical, glossy.
    Butterfly,
    /// One light at the side and above with a dark environment: half of the hair in shadow.
    Rembrandt,
    /// Two lights behind: a bright edge, and light that comes through the hair.
    Rim,
    /// Sun and clear sky.
    Daylight(Daylight),
    /// A sky full of clouds.
    Overcast,
    /// No light.
    Dark,
}

/// A lamp of a setup: degrees to the right of the camera and above the horizon, seen from the head,
/// irradiance, half its angle from edge to edge (rad).
type Stand = (f64, f64, [f32; 3], f64);

/// The unit direction to a lamp that stands `azimuth` to the right of the camera, seen from the head, and
/// `elevation` above the horizon (rad).
#[must_use]
pub fn beside_camera(camera: &Camera, azimuth: f64, elevation: f64) -> DVec3 {
    let (right, back) = (camera.right(), camera.right().cross(DVec3::Z));
    let (sa, ca) = azimuth.sin_cos();
    let level = sa * right + ca * back;
    (elevation.cos() * level + elevation.sin() * DVec3::Z).normalize()
}

impl Lights {
    /// The lights of a setup, which turn with the camera; those of the day do not. The first lamp, if
    /// there is any, is the main one.
    ///
    /// # Errors
    /// [`InvalidLight`], of a day that cannot be.
    pub fn setup(setup: &Setup, camera: &Camera) -> Result<Self, InvalidLight> {
        Ok(match setup {
            Setup::Studio => Self::studio(camera),
            Setup::Soft => standing(camera, &SOFT, [0.80, 0.80, 0.80], [0.42, 0.41, 0.40]),
            Setup::Butterfly => {
                standing(camera, &BUTTERFLY, [0.1, 0.105, 0.11], [0.05, 0.05, 0.05])
            }
            Setup::Rembrandt => standing(camera, &REMBRANDT, [0.1, 0.1, 0.11], [0.05, 0.05, 0.05]),
            Setup::Rim => standing(camera, &RIM, [0.1, 0.105, 0.115], [0.05, 0.05, 0.05]),
            Setup::Daylight(day) => return Self::daylight(day),
            Setup::Overcast => Self::overcast(),
            Setup::Dark => Self::dark(),
        })
    }

    /// A portrait studio that turns with the camera: a key light high at the left, a weak fill at
    /// the right, a rim light behind, and a soft ambient light.
    #[must_use]
    pub fn studio(camera: &Camera) -> Self {
        let lamp = |[right, up, back]: [f64; 3], irradiance: Vec3, radius: f64| {
            let direction = right * camera.right() + up * camera.up() - back * camera.forward();
            softbox(direction, irradiance, radius)
        };
        let lamps = [
            lamp([-0.55, 0.8, 0.9], Vec3::new(4.6, 4.5, 4.3), KEY),
            lamp([0.9, 0.2, 0.8], Vec3::new(1.5, 1.53, 1.6), SOFTBOX),
            lamp([0.55, 0.8, -0.8], Vec3::new(1.2, 1.23, 1.28), SOFTBOX),
        ];
        let environment = EnvironmentLight::Gradient {
            sky: Vec3::new(0.56, 0.58, 0.62),
            ground: Vec3::new(0.2, 0.19, 0.185),
        };
        Self { lamps: lamps.map(Into::into).to_vec(), environment }
    }
}

impl Default for Lights {
    /// The studio for the default camera, in front of the face.
    fn default() -> Self {
        Self::studio(&Camera::default())
    }
}

/// Angular radius of the studio's key light (rad): a softbox of 1.2 m two metres away. A larger one is too faint to be seen in the eyes: 2.5 % of its radiance
/// is reflected there. The rim light is a quarter of the key light: a brighter one shows through brown hair as orange patches.
const KEY: f64 = 0.3;

// Positions, irradiances and sizes of the setups are chosen by eye, after the photographers' setups of these names.
const SOFT: [Stand; 3] = [
    (-25.0, 35.0, [3.0, 2.96, 2.9], 0.5),
    (40.0, 15.0, [1.7, 1.72, 1.75], 0.5),
    (170.0, 55.0, [1.6, 1.6, 1.65], 0.3),
];

const BUTTERFLY: [Stand; 3] = [
    (0.0, 54.0, [6.2, 6.1, 5.95], SOFTBOX),
    (0.0, -35.0, [0.6, 0.6, 0.6], 0.3),
    (180.0, 50.0, [1.4, 1.4, 1.45], SOFTBOX),
];

const REMBRANDT: [Stand; 3] = [
    (-48.0, 42.0, [6.2, 5.95, 5.6], 0.12),
    (60.0, 5.0, [0.3, 0.31, 0.33], 0.3),
    (150.0, 45.0, [1.1, 1.1, 1.15], SOFTBOX),
];

const RIM: [Stand; 3] = [
    (-145.0, 30.0, [7.5, 7.3, 7.0], SOFTBOX),
    (140.0, 20.0, [5.5, 5.6, 5.9], SOFTBOX),
    (10.0, 25.0, [1.0, 1.0, 1.0], 0.4),
];

fn standing(camera: &Camera, stands: &[Stand], sky: [f32; 3], ground: [f32; 3]) -> Lights {
    let lamp = |&(azimuth, elevation, irradiance, radius): &Stand| {
        let direction = beside_camera(camera, azimuth.to_radians(), elevation.to_radians());
        softbox(direction, irradiance.into(), radius).into()
    };
    let environment = EnvironmentLight::Gradient { sky: sky.into(), ground: ground.into() };
    Lights { lamps: stands.iter().map(lamp).collect(), environment }
}

fn softbox(direction: DVec3, irradiance: Vec3, radius: f64) -> DistantLight {
    DistantLight::new(direction, irradiance, radius).expect("cameras and setups are finite")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_setups_have_light_but_one() {
        let camera = Camera::default();
        let day = Daylight::default();
        let setups = [
            Setup::Studio,
            Setup::Soft,
            Setup::Butterfly,
            Setup::Rembrandt,
            Setup::Rim,
            Setup::Daylight(day),
            Setup::Overcast,
        ];
        for setup in setups {
            let lights = Lights::setup(&setup, &camera).unwrap();
            let lamps = lights.lamps.iter().filter_map(|l| l.arriving(DVec3::ZERO)).map(|l| l.1);
            let all = lamps.sum::<Vec3>() + 9.87 * lights.environment.mean();
            assert!((6.0..18.0).contains(&all.y), "{setup:?} {all}");
        }
        assert_eq!(Lights::setup(&Setup::Dark, &camera).unwrap(), Lights::dark());
    }

    #[test]
    fn lamps_stand_beside_the_camera() {
        let camera = Camera::default();
        let right = std::f64::consts::FRAC_PI_2;
        // The camera faces the face, which looks along −y.
        assert!(beside_camera(&camera, 0.0, 0.0).distance(-DVec3::Y) < 1e-12);
        assert!(beside_camera(&camera, right, 0.0).distance(camera.right()) < 1e-12);
        assert!(beside_camera(&camera, 0.3, right).distance(DVec3::Z) < 1e-12);
    }
}
