//! The camera that a hand moves around the head.

use frisure::look::Camera;
use frisure_engine::Viewpoint;
use glam::DVec3;

/// A camera on a sphere around what it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// What it looks at (m).
    pub target: DVec3,
    /// Around the head (rad): 0 faces it, π/2 sees its left side.
    pub azimuth: f64,
    /// Above the horizon (rad).
    pub elevation: f64,
    /// From the target (m).
    pub distance: f64,
    /// From the picture's bottom to its top (rad).
    pub field_of_view: f64,
}

/// Views by name: azimuth and elevation (degrees).
pub const VIEWS: [(&str, f64, f64); 6] = [
    ("Front", 0.0, 3.0),
    ("Three-quarter", 35.0, 6.0),
    ("Left", 90.0, 3.0),
    ("Back", 180.0, 3.0),
    ("Right", -90.0, 3.0),
    ("Top", 0.0, 80.0),
];

/// Highest and lowest that the camera goes (rad).
const STEEPEST: f64 = 1.5;
/// Nearest and farthest (m).
const DISTANCES: (f64, f64) = (0.03, 20.0);
/// Farthest that the target goes from the origin (m).
const FARTHEST: f64 = 3.0;

impl Default for Orbit {
    fn default() -> Self {
        let target = DVec3::new(0.0, 0.0, -0.03);
        let (azimuth, elevation) = (35_f64.to_radians(), 6_f64.to_radians());
        Self { target, azimuth, elevation, distance: 1.0, field_of_view: 24_f64.to_radians() }
    }
}

impl Orbit {
    /// Turns the head under the hand, by angles (rad): to the right and up.
    pub fn turn(&mut self, right: f64, up: f64) {
        if right.is_finite() && up.is_finite() {
            self.azimuth = (self.azimuth - right).rem_euclid(std::f64::consts::TAU);
            self.elevation = (self.elevation + up).clamp(-STEEPEST, STEEPEST);
        }
    }

    /// Moves the picture, by parts of its height: to the right and up.
    pub fn pan(&mut self, right: f64, up: f64) {
        let height = 2.0 * self.distance * (0.5 * self.field_of_view).tan();
        let camera = self.camera();
        let moved = self.target - height * (right * camera.right() + up * camera.up());
        if moved.is_finite() {
            self.target = moved.clamp_length_max(FARTHEST);
        }
    }

    /// Comes nearer by a factor above 1, goes back by one below.
    pub fn zoom(&mut self, factor: f64) {
        let distance = self.distance / factor;
        if distance.is_finite() {
            self.distance = distance.clamp(DISTANCES.0, DISTANCES.1);
        }
    }

    /// Looks from a side, at what it looked at.
    pub fn look_from(&mut self, azimuth: f64, elevation: f64) {
        (self.azimuth, self.elevation) = (azimuth, elevation.clamp(-STEEPEST, STEEPEST));
    }

    /// Brings a box (m) into a picture of an aspect (width over height).
    pub fn frame(&mut self, bounds: (DVec3, DVec3), aspect: f64) {
        let camera = Camera::framing(bounds, self.azimuth, self.elevation, aspect);
        self.target = 0.5 * (bounds.0 + bounds.1);
        let tan = |angle: f64| (0.5 * angle).tan();
        // Framing is at a portrait lens' angle; another angle sees as much from another distance.
        let far = camera.eye().distance(self.target);
        self.distance = far * tan(camera.vertical_fov()) / tan(self.field_of_view);
        self.zoom(1.0);
    }

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> Camera {
        Camera::look_at(self.eye(), self.target, DVec3::Z, self.field_of_view).unwrap_or_default()
    }

    /// Its place (m).
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        let (sa, ca) = self.azimuth.sin_cos();
        let (se, ce) = self.elevation.sin_cos();
        self.target + self.distance * DVec3::new(sa * ce, -ca * ce, se)
    }

    /// The same for an order.
    #[must_use]
    pub fn viewpoint(&self) -> Viewpoint {
        let (eye, target) = (self.eye().to_array(), self.target.to_array());
        Viewpoint { eye, target, field_of_view: self.field_of_view }
    }

    /// Where a point (m) is in the picture, from −1 to 1 from left to right and from bottom to top;
    /// `None` behind the camera.
    #[must_use]
    pub fn project(&self, p: DVec3, aspect: f64) -> Option<[f64; 2]> {
        let camera = self.camera();
        let away = p - camera.eye();
        let depth = away.dot(camera.forward());
        let scale = (0.5 * self.field_of_view).tan() * depth;
        (depth > 1e-6)
            .then(|| [away.dot(camera.right()) / (scale * aspect), away.dot(camera.up()) / scale])
    }

    /// The ray through a place of the picture: origin (m) and unit direction.
    #[must_use]
    pub fn ray(&self, [x, y]: [f64; 2], aspect: f64) -> (DVec3, DVec3) {
        let camera = self.camera();
        let tan = (0.5 * self.field_of_view).tan();
        let way = camera.forward() + tan * (x * aspect * camera.right() + y * camera.up());
        (camera.eye(), way.normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_projected_lies_on_the_ray_of_its_place() {
        let mut orbit = Orbit::default();
        orbit.turn(1.0, 0.4);
        orbit.pan(0.1, -0.2);
        orbit.zoom(2.0);
        let p = DVec3::new(0.03, -0.05, 0.06);
        let place = orbit.project(p, 1.6).unwrap();
        let (from, way) = orbit.ray(place, 1.6);
        assert!((p - from).cross(way).length() < 1e-9);
    }

    #[test]
    fn a_hand_that_goes_mad_leaves_a_camera() {
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
    fn what_is_framed_is_in_the_picture() {
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
