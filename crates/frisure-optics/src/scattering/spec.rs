//! The optical properties of a fibre, and their ranges.

use core::fmt;

use glam::Vec3;

use crate::HAIR_INDEX;

/// Optical properties of a fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FibreSpec {
    /// Semi-axis along d1 over that along d2, 0.2 to 5; 1 is a circle.
    pub axis_ratio: f32,
    /// Refractive index, 1.05 to 3.
    pub index: f32,
    /// Roughness along the fibre β_M, 0.01 to 1.
    pub longitudinal_roughness: f32,
    /// Roughness around the fibre β_N, 0.01 to 1.
    pub azimuthal_roughness: f32,
    /// Tilt of the cuticle's scales α (rad), −0.35 to 0.35; positive where they open to the tip.
    pub tilt: f32,
    /// Absorption coefficient σ_a per mean radius √(ab), for linear sRGB, not negative.
    pub absorption: Vec3,
    /// 0 dry, 1 in a full film of water.
    pub wetness: f32,
}

impl Default for FibreSpec {
    /// Clean round white hair.
    fn default() -> Self {
        Self {
            axis_ratio: 1.0,
            index: HAIR_INDEX,
            longitudinal_roughness: 0.3,
            azimuthal_roughness: 0.3,
            tilt: 0.035,
            absorption: Vec3::ZERO,
            wetness: 0.0,
        }
    }
}

/// A property of a fibre that is out of its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FibreError {
    /// Name of the field.
    pub field: &'static str,
    /// Its value.
    pub value: f32,
    /// Least and greatest allowed value.
    pub allowed: (f32, f32),
}

impl fmt::Display for FibreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (least, most) = self.allowed;
        write!(f, "{} is {}; it must lie in {least} to {most}", self.field, self.value)
    }
}

impl core::error::Error for FibreError {}

/// Checks every property against its range.
pub(super) fn check(spec: &FibreSpec) -> Result<(), FibreError> {
    let rows = [
        ("axis_ratio", spec.axis_ratio, (0.2, 5.0)),
        ("index", spec.index, (1.05, 3.0)),
        ("longitudinal_roughness", spec.longitudinal_roughness, (0.01, 1.0)),
        ("azimuthal_roughness", spec.azimuthal_roughness, (0.01, 1.0)),
        ("tilt", spec.tilt, (-0.35, 0.35)),
        ("absorption", spec.absorption.x, (0.0, f32::MAX)),
        ("absorption", spec.absorption.y, (0.0, f32::MAX)),
        ("absorption", spec.absorption.z, (0.0, f32::MAX)),
        ("wetness", spec.wetness, (0.0, 1.0)),
    ];
    for (field, value, allowed) in rows {
        if !(value >= allowed.0 && value <= allowed.1) {
            return Err(FibreError { field, value, allowed });
        }
    }
    Ok(())
}
