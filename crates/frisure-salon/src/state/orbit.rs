//! The orbit camera.

use frisure::look::Camera;
use frisure_engine::Viewpoint;
use glam::DVec3;

/// A camera on a sphere around its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// The target (m).
    pub target: DVec3,
    /// The azimuth (rad): 0 is in front of the face, π/2 at its left side.
    pub azimuth: f64,
    /// The elevation above the horizon (rad).
    pub elevation: f64,
    /// The distance from the target (m).
    pub distance: f64,
    /// The vertical field of view (rad).
    pub field_of_view: f64,
}

/// Standard views: name, azimuth and elevation (degrees).
pub const VIEWS: [(&str, f64, f64); 6] = [
    ("view-front", 0.0, 3.0),
    ("view-three-quarter", 35.0, 6.0),
    ("view-left", 90.0, 3.0),
    ("view-back", 180.0, 3.0),
    ("view-right", -90.0, 3.0),
    ("view-top", 0.0, 80.0),
];

/// Maximum elevation (rad), below the pole, where the azimuth is undefined.
const MAX_ELEVATION: f64 = 1.5;
/// Minimum and maximum distance (m).
const DISTANCES: (f64, f64) = (0.03, 20.0);
/// Maximum distance of the target from the origin (m).
const MAX_TARGET_DISTANCE: f64 = 3.0;

impl Default for Orbit {
    fn default() -> Self {
        let target = DVec3::new(0.0, 0.0, -0.03);
        let (azimuth, elevation) = (35_f64.to_radians(), 6_f64.to_radians());
        Self { target, azimuth, elevation, distance: 1.0, field_of_view: 24_f64.to_radians() }
    }
}

impl Orbit {
    /// Orbits by angles (rad), so that the head turns to the right and up.
    pub fn turn(&mut self, right: f64, up: f64) {
        if right.is_finite() && up.is_finite() {
            self.azimuth = (self.azimuth - right).rem_euclid(std::f64::consts::TAU);
            self.elevation = (self.elevation + up).clamp(-MAX_ELEVATION, MAX_ELEVATION);
        }
    }

    /// Pans, so that the picture moves right and up by fractions of its height.
    pub fn pan(&mut self, right: f64, up: f64) {
        let height = 2.0 * self.distance * (0.5 * self.field_of_view).tan();
        let camera = self.camera();
        let moved = self.target - height * (right * camera.right() + up * camera.up());
        if moved.is_finite() {
            self.target = moved.clamp_length_max(MAX_TARGET_DISTANCE);
        }
    }

    /// Divides the distance by a factor.
    pub fn zoom(&mut self, factor: f64) {
        let distance = self.distance / factor;
        if distance.is_finite() {
            self.distance = distance.clamp(DISTANCES.0, DISTANCES.1);
        }
    }

    /// Looks at the target from an azimuth and an elevation (rad).
    pub fn look_from(&mut self, azimuth: f64, elevation: f64) {
        (self.azimuth, self.elevation) = (azimuth, elevation.clamp(-MAX_ELEVATION, MAX_ELEVATION));
    }

    /// Frames a box (m) in a picture of an aspect ratio (width over height).
    pub fn frame(&mut self, bounds: (DVec3, DVec3), aspect: f64) {
        let camera = Camera::framing(bounds, self.azimuth, self.elevation, aspect);
        self.target = 0.5 * (bounds.0 + bounds.1);
        let tan = |angle: f64| (0.5 * angle).tan();
        // `Camera::framing` uses its own field of view; the same extent fits this one at another distance.
        let distance = camera.eye().distance(self.target);
        self.distance = distance * tan(camera.vertical_fov()) / tan(self.field_of_view);
        self.zoom(1.0);
    }

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> Camera {
        Camera::look_at(self.eye(), self.target, DVec3::Z, self.field_of_view).unwrap_or_default()
    }

    /// Its position (m).
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        let (sa, ca) = self.azimuth.sin_cos();
        let (se, ce) = self.elevation.sin_cos();
        self.target + self.distance * DVec3::new(sa * ce, -ca * ce, se)
    }

    /// The camera as part of a request.
    #[must_use]
    pub fn viewpoint(&self) -> Viewpoint {
        let (eye, target) = (self.eye().to_array(), self.target.to_array());
        Viewpoint { eye, target, field_of_view: self.field_of_view }
    }

    /// Projects a point (m) into the picture (−1 to 1, right and up); `None` behind the camera.
    #[must_use]
    pub fn project(&self, p: DVec3, aspect: f64) -> Option<[f64; 2]> {
        let camera = self.camera();
        let offset = p - camera.eye();
        let depth = offset.dot(camera.forward());
        let scale = (0.5 * self.field_of_view).tan() * depth;
        (depth > 1e-6).then(|| {
            [offset.dot(camera.right()) / (scale * aspect), offset.dot(camera.up()) / scale]
        })
    }

    /// The ray through a point of the picture: origin (m) and unit direction.
    #[must_use]
    pub fn ray(&self, [x, y]: [f64; 2], aspect: f64) -> (DVec3, DVec3) {
        let camera = self.camera();
        let tan = (0.5 * self.field_of_view).tan();
        let direction = camera.forward() + tan * (x * aspect * camera.right() + y * camera.up());
        (camera.eye(), direction.normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_lies_on_the_ray_through_its_projection() {
        let mut orbit = Orbit::default();
        orbit.turn(1.0, 0.4);
        orbit.pan(0.1, -0.2);
        orbit.zoom(2.0);
        let p = DVec3::new(0.03, -0.05, 0.06);
        let at = orbit.project(p, 1.6).unwrap();
        let (from, direction) = orbit.ray(at, 1.6);
        assert!((p - from).cross(direction).length() < 1e-9);
    }

    #[test]
    fn absurd_motion_leaves_a_valid_camera() {
        let mut orbit = Orbit::default();
        for x in [f64::NAN, f64::INFINITY, -1e300, 1e300, 0.0] {
            orbit.turn(x, x);
            orbit.pan(x, x);
            orbit.zoom(x);
            assert!(orbit.eye().is_finite() && orbit.distance > 0.0);
        }
        orbit.elevation = 1.5;
        assert!(orbit.camera().forward().z < -0.9);
    }

    #[test]
    fn a_framed_box_is_inside_the_picture() {
        let mut orbit = Orbit::default();
        let bounds = (DVec3::new(-0.2, -0.15, -0.4), DVec3::new(0.2, 0.15, 0.12));
        for aspect in [0.6, 1.0, 1.9] {
            orbit.frame(bounds, aspect);
            let (middle, half) = (0.5 * (bounds.0 + bounds.1), 0.5 * (bounds.1 - bounds.0));
            for way in [DVec3::X, DVec3::Y, DVec3::Z] {
                for p in [middle + half * way, middle - half * way] {
                    let [x, y] = orbit.project(p, aspect).unwrap();
                    assert!(x.abs() < 1.0 && y.abs() < 1.0, "{x} {y}");
                }
            }
        }
    }
}
