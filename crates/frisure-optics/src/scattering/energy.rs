//! A: how much light each lobe gets, by colour.

use glam::Vec3;

use super::elementary::exp;
use super::section::Crossing;

/// Energies of R, TT, TRT and the rest for a unit of light, given the optical depth per mean radius
/// of way in the section.
///
/// What is still inside after TRT goes on with the mean of the four reflectances, a geometric series,
/// so that without absorption the sum is 1 exactly. For a circle, where all reflectances are equal,
/// this is the series itself: A0 = F, A1 = (1−F)² T, A2 = A1 T F, rest A2 T F/(1 − T F)
/// (Chiang et al. 2016, §3).
pub(super) fn energies(crossing: &Crossing, depth: Vec3, film: f32) -> [Vec3; 4] {
    let f = crossing.fresnel;
    let [first, second, third] = transmittances(depth, crossing.chord);
    let met = first * ((1.0 - film) * (1.0 - f[0]));
    let returned = second * met * f[1];
    // A ray that grazes has F = 1 and leaves nothing inside: keep 0/0 away.
    let mean = (0.25 * (f[0] + f[1] + f[2] + f[3])).min(0.9999);
    let series = third * (1.0 - mean) / (Vec3::ONE - third * mean);
    [
        Vec3::splat(film + (1.0 - film) * f[0]),
        met * (1.0 - f[1]),
        returned * (1.0 - f[2]),
        returned * f[2] * series,
    ]
}

/// e^(−τ) of the channels of three ways of length `chord` at optical depth `depth` per length.
#[inline]
fn transmittances(depth: Vec3, chord: [f32; 3]) -> [Vec3; 3] {
    let depth = -depth.extend(0.0);
    chord.map(|c| exp(depth * c).truncate())
}

/// Luminance of linear sRGB.
pub(super) fn luminance(colour: Vec3) -> f32 {
    colour.dot(Vec3::new(0.212_671, 0.715_160, 0.072_169))
}
