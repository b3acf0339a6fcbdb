//! Wet hair: a film of water around the fibre.
//!
//! Under water a fibre bends and reflects light less: its index relative to water is 1.55/1.33. So
//! more light goes on deeper into the hair, is absorbed there, and the hair is darker. Water
//! fills the gaps between the scales: half the longitudinal roughness and no tilt, so that the
//! highlight is narrow; and the surface of the water reflects too, without colour. The film's own
//! bending of the ray, and what its surface throws back from inside, are left out.
//!
//! How much darker depends on how the hair is lit: a deep layer of brown fibres has half of its dry
//! colour, a lock five fibres thick that is lit from all sides 0.97, 0.88, 0.78 (red, green, blue).

use super::fibre::FibreSpec;
use crate::fibre::fresnel;

/// Refractive index of water.
pub const WATER_INDEX: f32 = 1.33;

/// The fibre under its film: between dry and wet in proportion to its wetness.
pub(super) fn under_film(spec: &FibreSpec) -> FibreSpec {
    let w = spec.wetness;
    FibreSpec {
        index: (spec.index * (1.0 - w + w / WATER_INDEX)).max(1.0 + 1e-3),
        longitudinal_roughness: spec.longitudinal_roughness * (1.0 - 0.5 * w),
        tilt: spec.tilt * (1.0 - w),
        ..*spec
    }
}

/// Share of the light that the surface of the water reflects, at the cosine of incidence that
/// `facing` computes: only for wet hair, since most is dry.
#[inline]
pub(super) fn reflected(wetness: f32, facing: impl FnOnce() -> f32) -> f32 {
    if wetness > 0.0 { wetness * fresnel(facing(), WATER_INDEX) } else { 0.0 }
}
