//! A camera.

use frisure_digest::digest_fields;
use glam::{DMat3, DVec3};
use thiserror::Error;

/// Vertical field of view of [`Camera::framing`] (rad): that of a portrait lens, 24°.
const PORTRAIT_FOV: f64 = 24.0 * std::f64::consts::PI / 180.0;

/// Part of the picture's width or height that framing leaves free on each side; chosen by eye.
const MARGIN: f64 = 0.05;

/// Points on each rim of the cylinder that [`Camera::framing`] fits into the picture; chosen.
const AROUND: u32 = 32;

/// A perspective camera: an eye, an upright frame, a vertical field of view, and an aperture, if it is not a
/// pinhole.
///
/// ```
/// use frisure_look::{Aperture, Camera};
/// use glam::DVec3;
///
/// // From 1 m in front of the face, with a portrait lens of 85 mm at f/2.8.
/// let eye = DVec3::new(0.0, -1.0, 0.0);
/// let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Z, 24_f64.to_radians())?
///     .with_aperture(Aperture { radius: 0.015, focus: Some(0.9) })?;
/// assert_eq!(camera.right(), DVec3::X);
///
/// // Or as near as it can be with all of a box in the picture.
/// let bounds = (DVec3::splat(-0.12), DVec3::splat(0.12));
/// let framed = Camera::framing(bounds, 0.5, 0.1, 1.0);
/// assert!(framed.eye().length() > 0.5);
/// # Ok::<(), frisure_look::CameraError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    eye: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    vertical_fov: f64,
    aperture: Option<Aperture>,
}
digest_fields!(Camera { eye, forward, right, up, vertical_fov, aperture });

/// The opening of a thin lens: what is nearer or farther than its focus is blurred. For the path tracer
/// alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aperture {
    /// Radius of the opening (m). A lens of focal length f at the f-number N has f / 2N: 15 mm for a
    /// portrait lens of 85 mm at f/2.8.
    pub radius: f64,
    /// Distance along the view that is sharp (m); without it, that of the nearest thing in the middle of
    /// the picture.
    pub focus: Option<f64>,
}
digest_fields!(Aperture { radius, focus });

/// Why a camera cannot be made.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum CameraError {
    /// Eye and target coincide, are not finite, or the view is along the up direction.
    #[error("the camera has no direction: eye {eye}, target {target}, up {up}")]
    Direction {
        /// Position of the eye (m).
        eye: DVec3,
        /// Point looked at (m).
        target: DVec3,
        /// Up direction.
        up: DVec3,
    },
    /// The field of view is not strictly between 0 and π.
    #[error("the vertical field of view must lie between 0 and 180 deg, not {degrees} deg")]
    FieldOfView {
        /// The field of view given (degrees).
        degrees: f64,
    },
    /// An opening or a distance of focus that no lens has.
    #[error("the lens must have an opening of 0 to 1 m and a focus above 0 m, not {aperture:?}")]
    Aperture {
        /// The opening given.
        aperture: Aperture,
    },
}

impl Camera {
    /// A camera at `eye` (m) that looks at `target` (m), with `up` upwards in the picture and a
    /// field of view of `vertical_fov` (rad) from the bottom to the top of the picture.
    ///
    /// # Errors
    /// [`CameraError`], if these define no picture.
    pub fn look_at(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        vertical_fov: f64,
    ) -> Result<Self, CameraError> {
        if !(vertical_fov > 0.0 && vertical_fov < std::f64::consts::PI) {
            return Err(CameraError::FieldOfView { degrees: vertical_fov.to_degrees() });
        }
        let bad = CameraError::Direction { eye, target, up };
        let forward = (target - eye).try_normalize().ok_or(bad)?;
        let right = forward.cross(up).try_normalize().ok_or(bad)?;
        if !eye.is_finite() {
            return Err(bad);
        }
        Ok(Self { eye, forward, right, up: right.cross(forward), vertical_fov, aperture: None })
    }

    /// A camera that shows what stands upright in the box `bounds` (smallest and largest corner, m)
    /// in a picture of `aspect` width/height, seen from `azimuth` and `elevation` (rad) with a
    /// portrait lens. It fits the elliptic cylinder that the box holds: heads have no corners, and
    /// whole boxes would make them small.
    ///
    /// Azimuth 0 faces the face (the eye is towards −y) and grows towards the head's left (+x);
    /// elevation grows upwards and is kept between ±85°. Bounds, angles or aspects that are not
    /// finite and positive are replaced: there is always a camera.
    #[must_use]
    pub fn framing(bounds: (DVec3, DVec3), azimuth: f64, elevation: f64, aspect: f64) -> Self {
        let (low, high) = usable_bounds(bounds);
        let aspect = if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 };
        let azimuth = if azimuth.is_finite() { azimuth } else { 0.0 };
        let limit = 85_f64.to_radians();
        let elevation = if elevation.is_finite() { elevation.clamp(-limit, limit) } else { 0.0 };

        let (sa, ca) = azimuth.sin_cos();
        let (se, ce) = elevation.sin_cos();
        let forward = -DVec3::new(sa * ce, -ca * ce, se);
        let right = forward.cross(DVec3::Z).normalize();
        let up = right.cross(forward);
        let centre = 0.5 * (low + high);

        let tan_v = (0.5 * PORTRAIT_FOV).tan() * (1.0 - 2.0 * MARGIN);
        let tan_h = tan_v * aspect;
        let half = 0.5 * (high - low);
        let distance = (0..2 * AROUND)
            .map(|i| {
                let turn = f64::from(i / 2) / f64::from(AROUND) * std::f64::consts::TAU;
                let end = if i % 2 == 0 { -1.0 } else { 1.0 };
                let rim = half * DVec3::new(turn.cos(), turn.sin(), end);
                let fit_h = rim.dot(right).abs() / tan_h;
                let fit_v = rim.dot(up).abs() / tan_v;
                fit_h.max(fit_v) - rim.dot(forward)
            })
            .fold(0.0, f64::max);
        let eye = centre - distance * forward;
        Self { eye, forward, right, up, vertical_fov: PORTRAIT_FOV, aperture: None }
    }

    /// The same camera with an opening.
    ///
    /// # Errors
    /// [`CameraError::Aperture`], if its numbers are impossible.
    pub fn with_aperture(self, aperture: Aperture) -> Result<Self, CameraError> {
        let sharp = aperture.focus.is_none_or(|focus| focus > 0.0 && focus.is_finite());
        match (0.0..=1.0).contains(&aperture.radius) && sharp {
            true => Ok(Self { aperture: Some(aperture), ..self }),
            false => Err(CameraError::Aperture { aperture }),
        }
    }

    /// The same camera, turned by `angle` (rad) about the vertical through `axis` (m), to the left of a
    /// head that looks towards −y.
    #[must_use]
    pub fn turned(self, axis: DVec3, angle: f64) -> Self {
        let turn = DMat3::from_rotation_z(angle);
        Self {
            eye: axis + turn * (self.eye - axis),
            forward: turn * self.forward,
            right: turn * self.right,
            up: turn * self.up,
            ..self
        }
    }

    /// The opening; none for a pinhole.
    #[must_use]
    pub fn aperture(&self) -> Option<Aperture> {
        self.aperture
    }

    /// Position of the eye (m).
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// Unit direction of view, into the picture.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        self.forward
    }

    /// Unit direction to the right in the picture.
    #[must_use]
    pub fn right(&self) -> DVec3 {
        self.right
    }

    /// Unit direction upwards in the picture.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// Angle from the bottom to the top of the picture (rad).
    #[must_use]
    pub fn vertical_fov(&self) -> f64 {
        self.vertical_fov
    }
}

impl Default for Camera {
    /// In front of a head at the origin.
    fn default() -> Self {
        Self::framing((DVec3::splat(-0.15), DVec3::splat(0.15)), 0.0, 0.0, 1.0)
    }
}

/// The box, or one around a head at the origin if it cannot be framed.
fn usable_bounds((low, high): (DVec3, DVec3)) -> (DVec3, DVec3) {
    let good = low.is_finite() && high.is_finite() && (high - low).min_element() >= 0.0;
    let size = (high - low).max_element();
    if good && size > 0.0 { (low, high) } else { (DVec3::splat(-0.15), DVec3::splat(0.15)) }
}

/// A direction around the head from which pictures are taken, by its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedCamera {
    /// The name, which is also in the names of files.
    pub name: &'static str,
    /// Where it is.
    pub description: &'static str,
    /// [`CameraSpec::azimuth`] (rad).
    pub azimuth: f64,
}

const fn named(name: &'static str, description: &'static str, degrees: f64) -> NamedCamera {
    NamedCamera { name, description, azimuth: degrees.to_radians() }
}

/// The cameras that have names.
pub const CAMERAS: [NamedCamera; 6] = [
    named("front", "In front of the face", 0.0),
    named("three-quarter", "Between front and left side", 35.0),
    named("side", "The head's left side", 90.0),
    named("left", "The same", 90.0),
    named("back", "Behind", 180.0),
    named("right", "The head's right side", -90.0),
];

/// A camera by its direction from the subject; its distance follows from what it must show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSpec {
    /// Around the head (rad): 0 faces it, π/2 sees its left side.
    pub azimuth: f64,
    /// Above the horizon (rad).
    pub elevation: f64,
    /// Field of view from the picture's bottom to its top (rad).
    pub field_of_view: f64,
    /// Focal length over the diameter of the aperture; none for a pinhole.
    pub f_number: Option<f64>,
    /// Focus distance (m).
    pub focus: Option<f64>,
}

impl Default for CameraSpec {
    /// In front of the head, to its left, with a portrait lens.
    fn default() -> Self {
        Self {
            azimuth: 30_f64.to_radians(),
            elevation: 5_f64.to_radians(),
            field_of_view: 24_f64.to_radians(),
            f_number: None,
            focus: None,
        }
    }
}

impl CameraSpec {
    /// The camera that is as near as it can be with all points (m) in a picture of `aspect` width/height.
    #[must_use]
    pub fn frame(&self, points: impl Iterator<Item = DVec3> + Clone, aspect: f64) -> Camera {
        let extent = |axis: DVec3| {
            points
                .clone()
                .map(|p| p.dot(axis))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let unit = (DVec3::splat(-1.0), DVec3::ONE);
        let framed = Camera::framing(unit, self.azimuth, self.elevation, aspect);
        let (right, up, forward) = (framed.right, framed.up, framed.forward);
        let centre: DVec3 = [right, up, forward]
            .map(|axis| {
                let (low, high) = extent(axis);
                axis * (0.5 * (low + high))
            })
            .iter()
            .sum();
        let tan_v = (0.5 * self.field_of_view).tan() * (1.0 - 2.0 * MARGIN);
        let tan_h = tan_v * aspect;
        let distance = points
            .map(|p| {
                let d = p - centre;
                (d.dot(right).abs() / tan_h).max(d.dot(up).abs() / tan_v) - d.dot(forward)
            })
            .fold(0.0, f64::max);
        let eye = centre - distance * forward;
        // Points without extent give no direction of view; the framing has one.
        let camera = Camera::look_at(eye, centre, DVec3::Z, self.field_of_view).unwrap_or(framed);
        match self.aperture(aspect) {
            // An impossible lens is a pinhole.
            Some(aperture) => camera.with_aperture(aperture).unwrap_or(camera),
            None => camera,
        }
    }

    /// The camera with this lens at another place: `eye` and `target` in m, `field_of_view` from the picture's bottom
    /// to its top (rad).
    ///
    /// # Errors
    /// [`CameraError`], for an eye at the target, or an impossible field of view.
    pub fn at(
        &self,
        eye: DVec3,
        target: DVec3,
        field_of_view: f64,
        aspect: f64,
    ) -> Result<Camera, CameraError> {
        let camera = Camera::look_at(eye, target, DVec3::Z, field_of_view)?;
        match (Self { field_of_view, ..*self }).aperture(aspect) {
            Some(aperture) => camera.with_aperture(aperture),
            None => Ok(camera),
        }
    }

    /// The aperture of a lens of this field of view on film of 24 × 36 mm; none for a pinhole.
    fn aperture(&self, aspect: f64) -> Option<Aperture> {
        let f_number = self.f_number?;
        let height = if aspect > 1.0 { 0.024 } else { 0.036 };
        let focal_length = 0.5 * height / (0.5 * self.field_of_view).tan();
        Some(Aperture { radius: 0.5 * focal_length / f_number, focus: self.focus })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_view_has_the_left_of_the_head_on_its_right() {
        let camera = Camera::default();
        assert!(camera.eye().y < -0.3 && camera.eye().x.abs() < 1e-12);
        assert!((camera.right() - DVec3::X).length() < 1e-12);
        assert!((camera.up() - DVec3::Z).length() < 1e-12);
    }

    #[test]
    fn a_quarter_turn_goes_from_the_face_to_its_left() {
        let camera = Camera::default().turned(DVec3::ZERO, std::f64::consts::FRAC_PI_2);
        assert!(camera.eye().x > 0.3 && camera.eye().y.abs() < 1e-12);
        assert!((camera.right() - DVec3::Y).length() < 1e-12);
    }

    #[test]
    fn framing_holds_the_cylinder() {
        let bounds = (DVec3::new(-0.1, -0.12, -0.3), DVec3::new(0.1, 0.09, 0.15));
        let (centre, half) = (0.5 * (bounds.0 + bounds.1), 0.5 * (bounds.1 - bounds.0));
        for (azimuth, elevation, aspect) in [(0.0, 0.0, 1.0), (0.8, 0.3, 0.6), (-2.0, -0.5, 1.8)] {
            let camera = Camera::framing(bounds, azimuth, elevation, aspect);
            let tan = (0.5 * camera.vertical_fov()).tan();
            let mut largest = 0.0_f64;
            for i in 0..720 {
                let (s, c) = f64::from(i).to_radians().sin_cos();
                let rim = DVec3::new(c, s, if i % 2 == 0 { -1.0 } else { 1.0 });
                let d = centre + half * rim - camera.eye();
                let depth = d.dot(camera.forward());
                let v = d.dot(camera.up()).abs() / (depth * tan);
                let h = d.dot(camera.right()).abs() / (depth * tan * aspect);
                largest = largest.max(v).max(h);
            }
            assert!((largest - (1.0 - 2.0 * MARGIN)).abs() < 2e-3, "{largest}");
        }
    }

    #[test]
    fn impossible_cameras_are_refused_and_framing_never_fails() {
        let look = |eye, up, fov| Camera::look_at(eye, DVec3::ZERO, up, fov);
        assert!(look(DVec3::Y, DVec3::Z, 0.5).is_ok());
        assert!(look(DVec3::ZERO, DVec3::Z, 0.5).is_err());
        assert!(look(DVec3::Z, DVec3::Z, 0.5).is_err());
        assert!(look(DVec3::Y * f64::NAN, DVec3::Z, 0.5).is_err());
        assert!(look(DVec3::Y, DVec3::Z, f64::NAN).is_err());
        let camera = Camera::framing((DVec3::NAN, DVec3::ONE), f64::NAN, 9.0, 0.0);
        assert!(camera.eye().is_finite());
    }

    const BOX: (DVec3, DVec3) = (DVec3::new(-0.1, -0.12, -0.3), DVec3::new(0.1, 0.09, 0.15));

    fn corners() -> impl Iterator<Item = DVec3> + Clone {
        (0..8_u8).map(|corner| {
            let pick = |bit: u8| f64::from(corner >> bit & 1);
            BOX.0 + DVec3::new(pick(0), pick(1), pick(2)) * (BOX.1 - BOX.0)
        })
    }

    #[test]
    fn a_framed_box_is_in_every_picture() {
        for degrees in [1.0, 24.0, 120.0] {
            for (azimuth, elevation, aspect) in
                [(0.0, 0.0, 1.0), (2.0, 1.4, 0.3), (-9.0, -1.4, 4.0)]
            {
                let field_of_view = f64::to_radians(degrees);
                let spec =
                    CameraSpec { azimuth, elevation, field_of_view, f_number: None, focus: None };
                let camera = spec.frame(corners(), aspect);
                let tan = (0.5 * field_of_view).tan();
                assert!((camera.vertical_fov() - field_of_view).abs() < 1e-12);
                for corner in corners() {
                    let d = corner - camera.eye();
                    let depth = d.dot(camera.forward());
                    assert!(depth > 0.0);
                    assert!(d.dot(camera.up()).abs() < depth * tan);
                    assert!(d.dot(camera.right()).abs() < depth * tan * aspect);
                }
            }
        }
    }

    #[test]
    fn a_portrait_lens_at_2_8_opens_by_15_mm() {
        let (azimuth, elevation, field_of_view) = (0.0, 0.0, f64::to_radians(23.9));
        let f_number = Some(2.8);
        let spec = CameraSpec { azimuth, elevation, field_of_view, f_number, focus: None };
        let camera = spec.frame(corners(), 0.8);
        assert!((camera.aperture().unwrap().radius - 0.0152).abs() < 2e-4);
    }
}
