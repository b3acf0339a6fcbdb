//! What lights the scene.

use glam::{DVec3, Vec3};

use crate::Camera;

/// Light from very far away, such as the sun or a studio lamp seen from a head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Unit direction from the scene *to* the light.
    pub direction: DVec3,
    /// Irradiance on a surface that faces the light, linear sRGB: π makes a white wall 1.
    pub irradiance: Vec3,
}

/// All the lights of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights {
    /// Lamps; each has its shadows.
    pub lamps: Vec<DirectionalLight>,
    /// Radiance from straight above, linear sRGB; it fades into `ground` below.
    pub sky: Vec3,
    /// Radiance from straight below, linear sRGB.
    pub ground: Vec3,
}

impl Lights {
    /// A portrait studio that turns with the camera: a key light high at the left, a weak fill at
    /// the right, a rim light behind, and a soft room.
    #[must_use]
    pub fn studio(camera: &Camera) -> Self {
        let lamp = |right: f64, up: f64, back: f64, irradiance: Vec3| DirectionalLight {
            direction: (right * camera.right() + up * camera.up() - back * camera.forward())
                .normalize(),
            irradiance,
        };
        Self {
            lamps: vec![
                lamp(-0.5, 0.95, 0.85, Vec3::new(5.0, 4.85, 4.6)),
                lamp(0.9, 0.15, 0.75, Vec3::new(0.9, 0.95, 1.05)),
                lamp(0.55, 0.8, -0.8, Vec3::new(3.2, 3.25, 3.4)),
            ],
            sky: Vec3::new(0.46, 0.49, 0.54),
            ground: Vec3::new(0.13, 0.12, 0.115),
        }
    }

    /// Radiance of the room (linear sRGB) from the unit direction `towards`.
    #[must_use]
    pub fn room(&self, towards: Vec3) -> Vec3 {
        self.ground.lerp(self.sky, (0.5 + 0.5 * towards.z).clamp(0.0, 1.0))
    }
}

impl Default for Lights {
    /// The studio for the default camera, in front of the face.
    fn default() -> Self {
        Self::studio(&Camera::default())
    }
}
