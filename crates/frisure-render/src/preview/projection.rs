//! From the world to the picture.

use glam::Vec3;

use frisure_look::Camera;

/// Nearest depth that is drawn (m). Chosen.
pub(super) const NEAR: f32 = 0.01;

/// A camera with a picture in front of it.
pub(super) struct Projection {
    pub(super) eye: Vec3,
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    pub(super) forward: Vec3,
    /// Pixels per unit of slope.
    pub(super) focal: f32,
    pub(super) width: usize,
    pub(super) height: usize,
}

impl Projection {
    pub(super) fn new(camera: &Camera, width: usize, height: usize) -> Self {
        let focal = 0.5 * height as f64 / (0.5 * camera.vertical_fov()).tan();
        Self {
            eye: camera.eye().as_vec3(),
            right: camera.right().as_vec3(),
            up: camera.up().as_vec3(),
            forward: camera.forward().as_vec3(),
            focal: focal as f32,
            width,
            height,
        }
    }

    /// Position in the picture (pixels, from the top left) and depth (m). Meaningless in x and y
    /// where the depth is not above [`NEAR`].
    pub(super) fn project(&self, point: Vec3) -> Vec3 {
        let d = point - self.eye;
        let depth = d.dot(self.forward);
        let scale = self.focal / depth;
        Vec3::new(
            0.5 * self.width as f32 + scale * d.dot(self.right),
            0.5 * self.height as f32 - scale * d.dot(self.up),
            depth,
        )
    }

    /// The unit direction from the eye through a place in the picture (pixels, from the top left).
    pub(super) fn towards(&self, x: f32, y: f32) -> Vec3 {
        let right = (x - 0.5 * self.width as f32) * self.right;
        let up = (0.5 * self.height as f32 - y) * self.up;
        (self.focal * self.forward + right + up).normalize()
    }
}
