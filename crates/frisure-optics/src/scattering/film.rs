//! Wet hair: a film of water around the fibre.
//!
//! The film is thin against the fibre, so that both its surfaces lie as the fibre's own. A ray then bends
//! as without it (the sine of its angle is divided by the index of water and by that of hair against
//! water, which is that of hair), but meets two surfaces of little reflectance instead of one:
//! with F_w of air and water and F_h of water and hair, and all that goes to and fro between them,
//!
//! ```text
//! F = F_w + (1 − F_w)² F_h / (1 − F_w F_h),
//! ```
//!
//! 0.026 at normal incidence and 0.047 without water. It is the same from inside, so that the energies of a
//! ray still sum to 1. More light goes on deeper into the hair and is absorbed there: wet hair is
//! darker. Water also fills the gaps between the scales: half the longitudinal roughness and no
//! tilt, so that the highlight is narrow. Fibres that stick together lie in water, which has no
//! model here but that they lie close.

use glam::Vec4;

use super::spec::FibreSpec;

/// Refractive index of water in visible light at room temperature.
pub const WATER_INDEX: f32 = 1.33;

/// The fibre under its film: between dry and wet in proportion to its wetness.
pub(super) fn under_film(spec: &FibreSpec) -> FibreSpec {
    // Half the roughness and no tilt in a full film: chosen, since water fills the gaps between scales but not their bulk.
    let w = spec.wetness;
    FibreSpec {
        longitudinal_roughness: spec.longitudinal_roughness * (1.0 - 0.5 * w),
        tilt: spec.tilt * (1.0 - w),
        ..*spec
    }
}

/// Reflectances of a fibre of relative index `index` under a film, at the cosines outside and inside.
pub(super) fn reflectance(outer: Vec4, inner: Vec4, index: f32) -> Vec4 {
    // The ray in the film, by Snell; the bound below stands for total reflection between both surfaces.
    let sine2 = (Vec4::ONE - outer * outer) * (WATER_INDEX * WATER_INDEX).recip();
    let water = (Vec4::ONE - sine2).max(Vec4::ZERO).sqrt();
    let (air, hair) =
        (fresnel(outer, water, WATER_INDEX), fresnel(water, inner, index / WATER_INDEX));
    let through = Vec4::ONE - air;
    air + through * through * hair / (Vec4::ONE - air * hair).max(Vec4::splat(1e-6))
}

/// Reflectances between rays outside and inside that meet a surface of relative index `index` at these
/// cosines; 1 where `outer` is 0.
#[inline(always)]
pub(super) fn fresnel(outer: Vec4, inner: Vec4, index: f32) -> Vec4 {
    // Both polarisations, unpolarised light having half of each. The bound keeps 0/0 away where both cosines vanish.
    let (dense_outer, dense_inner) = (outer * index, inner * index);
    let least = Vec4::splat(1e-20);
    let parallel = (dense_outer - inner) / (dense_outer + inner).max(least);
    let perpendicular = (outer - dense_inner) / (outer + dense_inner).max(least);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}
