//! A fibre to scatter light, checked and prepared.

use glam::{Vec2, Vec2Swizzles, Vec3, Vec4};

use super::azimuthal::Azimuthal;
use super::film::under_film;
use super::longitudinal::{Inclinations, Longitudinal};
use super::spec::{FibreError, FibreSpec, check};

/// A checked fibre, with all that does not depend on the hit computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    spec: FibreSpec,
    pub(super) axes: Vec2,
    pub(super) index: f32,
    pub(super) absorption: Vec3,
    pub(super) wetness: f32,
    pub(super) longitudinal: Longitudinal,
    pub(super) azimuthal: Azimuthal,
    /// Sines and cosines of the angles by which each lobe turns the inclination.
    turn: (Vec4, Vec4),
}

impl Fibre {
    /// Checks the description and computes what all hits on the fibre share.
    ///
    /// # Errors
    ///
    /// Names the first field that is out of its range.
    pub fn new(spec: FibreSpec) -> Result<Self, FibreError> {
        check(&spec)?;
        let wet = under_film(&spec);
        // 2α, −α, −4α and 0 for R, TT, TRT and the rest: normals of scales that open to the tip lean to the root, so light from
        // across the fibre is reflected to −2α. `pbrt-v3` counts α the other way. docs/theory.md, "Light in a fibre"
        let turn = Vec4::new(2.0, -1.0, -4.0, 0.0) * wet.tilt;
        Ok(Self {
            spec,
            axes: axes(spec.axis_ratio),
            index: wet.index,
            absorption: spec.absorption,
            wetness: spec.wetness,
            longitudinal: Longitudinal::new(wet.longitudinal_roughness),
            azimuthal: Azimuthal::new(wet.azimuthal_roughness),
            turn: (turn.sin(), turn.cos()),
        })
    }

    /// Returns the description.
    #[must_use]
    pub fn spec(&self) -> &FibreSpec {
        &self.spec
    }

    /// Returns the same fibre with another absorption, at little cost: hairs differ in pigment.
    ///
    /// # Errors
    ///
    /// If a channel is negative or not a number.
    pub fn with_absorption(&self, absorption: Vec3) -> Result<Self, FibreError> {
        let spec = FibreSpec { absorption, ..self.spec };
        check(&spec)?;
        Ok(Self { spec, absorption, ..*self })
    }

    /// The same fibre of another axis ratio.
    ///
    /// # Errors
    ///
    /// If the ratio is out of its range.
    pub fn with_axis_ratio(&self, axis_ratio: f32) -> Result<Self, FibreError> {
        let spec = FibreSpec { axis_ratio, ..self.spec };
        check(&spec)?;
        Ok(Self { spec, axes: axes(axis_ratio), ..*self })
    }

    /// Half the width in mean radii, as seen from local direction `w`.
    #[must_use]
    pub fn half_width(&self, w: Vec3) -> f32 {
        // √(b² cos² φ + a² sin² φ): the largest distance of the ellipse from the line through its centre along φ.
        (towards(w) * self.axes.yx()).length()
    }

    /// Offset h, −1 to 1, at which a ray to local direction `w` passes the point `at` (mean radii, in
    /// the section): along w × t, over half the width.
    #[must_use]
    pub fn offset(&self, w: Vec3, at: Vec2) -> f32 {
        (at.perp_dot(towards(w)) / self.half_width(w)).clamp(-1.0, 1.0)
    }

    /// Whether the section is a circle.
    pub(super) fn is_round(&self) -> bool {
        self.axes.x == self.axes.y
    }

    /// The inclination of each lobe: tilted by 2α, −α and −4α, the rest not.
    pub(super) fn tilted(&self, sine: f32, cosine: f32) -> Inclinations {
        // Sine and cosine of a sum; a cosine that turned negative belongs to a direction beyond the pole.
        let (s, c) = self.turn;
        Inclinations { sine: c * sine + s * cosine, cosine: (c * cosine - s * sine).abs() }
    }
}

/// Unit direction of `w` seen along the fibre; d1 if it is along the fibre.
pub(super) fn towards(w: Vec3) -> Vec2 {
    w.truncate().try_normalize().unwrap_or(Vec2::X)
}

fn axes(axis_ratio: f32) -> Vec2 {
    if axis_ratio == 1.0 {
        return Vec2::ONE;
    }
    // In mean radii: a b = 1.
    Vec2::new(axis_ratio.sqrt(), axis_ratio.sqrt().recip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_by_name() {
        let of = |spec| Fibre::new(spec).unwrap_err().field;
        assert_eq!(of(FibreSpec { axis_ratio: f32::NAN, ..Default::default() }), "axis_ratio");
        assert_eq!(of(FibreSpec { index: 0.9, ..Default::default() }), "index");
        assert_eq!(of(FibreSpec { wetness: 1.1, ..Default::default() }), "wetness");
        let error = Fibre::new(FibreSpec { tilt: 2.0, ..Default::default() }).unwrap_err();
        assert_eq!(error.to_string(), "tilt is 2; it must lie in -0.35 to 0.35");
    }

    #[test]
    fn offset_is_the_share_of_the_width() {
        let fibre = Fibre::new(FibreSpec { axis_ratio: 1.5, ..Default::default() }).unwrap();
        // From d1 the width is b; a point at d2 = +b lies along −(w × t) there.
        let b = 1.0 / 1.5_f32.sqrt();
        assert!((fibre.half_width(Vec3::X) - b).abs() < 1e-6);
        assert!((fibre.offset(Vec3::X, Vec2::new(0.0, b)) + 1.0).abs() < 1e-6);
        assert!((Vec3::X.cross(Vec3::Z) + Vec3::Y).length() < 1e-6);
        assert!((fibre.half_width(Vec3::Y) * b - 1.0).abs() < 1e-6);
    }
}
