//! A: how much light each lobe gets, by colour.

use glam::{Mat4, Vec3, Vec4};

use super::elementary::exp;
use super::section::Crossing;

/// Energies of R, TT, TRT and the rest for a unit of light, given the optical depth per mean radius
/// of way in the section.
///
/// What is still inside after TRT goes on with the mean of the four reflectances, a geometric series,
/// so that without absorption the sum is 1 exactly. For a circle, where all reflectances are equal,
/// this is the series itself: A0 = F, A1 = (1−F)² T, A2 = A1 T F, rest A2 T F/(1 − T F)
/// (Chiang et al. 2016, §3).
///
/// A column for each lobe: red, green, blue, and the lobe's share in the luminance.
#[inline]
pub(super) fn energies(crossing: &Crossing, depth: Vec3) -> Mat4 {
    let (f, chord) = (crossing.fresnel, crossing.chord);
    let depth = -depth.extend(0.0);
    let [first, second, third] = [chord.x, chord.y, chord.z].map(|way| exp(depth * way));
    // (1 − F) T on the first way; then F T for each further reflection inside.
    let met = first * (1.0 - f.x);
    let returned = second * met * f.y;
    // T (1 − F) + T² F (1 − F) + … = T (1 − F)/(1 − T F). A ray that grazes has F = 1 and leaves nothing inside: keep 0/0
    // away.
    let mean = (0.25 * f.element_sum()).min(0.9999);
    let series = third * (1.0 - mean) / (Vec4::ONE - third * mean);
    with_shares([
        Vec4::splat(f.x),
        met * (1.0 - f.y),
        returned * (1.0 - f.z),
        returned * f.z * series,
    ])
}

/// Energies as columns, each with its share in the luminance of linear sRGB.
#[inline]
fn with_shares(energy: [Vec4; 4]) -> Mat4 {
    // Y of the linear primaries of sRGB (Rec. 709, D65).
    let luminance = Vec4::new(0.212_671, 0.715_160, 0.072_169, 0.0);
    let light = Vec4::from_array(energy.map(|e| e.dot(luminance)));
    let share = light / light.element_sum();
    Mat4::from_cols(
        energy[0].with_w(share.x),
        energy[1].with_w(share.y),
        energy[2].with_w(share.z),
        energy[3].with_w(share.w),
    )
}
