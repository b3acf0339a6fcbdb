//! Pigment of each strand, and what light makes of it.

use frisure_optics::{HAIR_INDEX, absorption, apparent_colour, fibre_energy};
use frisure_strands::{AttributeValues, Domain, Strands};
use glam::Vec3;

use crate::HairLook;

/// Levels of pigment between the least and the most: an odd number, so that 1 is one of them.
const LEVELS: usize = 65;
/// Factors on the pigment that the levels span, as powers of e.
const SPAN: f32 = 1.4;
/// Azimuthal roughness of ordinary hair in the terms of Chiang et al. 2016.
const AZIMUTHAL_ROUGHNESS: f32 = 0.3;
/// Relative deviation of the pigment from wisp to wisp, as part of that from strand to strand.
const WISP_PART: f32 = 0.6;

/// Length of the path of light that leaves on the side of the lamp, as part of that of all light.
/// Chosen by eye, so that brown of 1.3 is brown and blond of 0.3 is blond.
const PATH: f32 = 0.6;
/// Part of the light reflected by one hair that its neighbours reflect on to the eye.
const SHEEN: f32 = 0.12;
/// Deviation of the white highlight's strength from strand to strand, as a power of e.
const GLITTER_STRENGTH: f32 = 0.35;
/// Deviation of the highlights' place from strand to strand (rad).
const GLITTER_SHIFT: f32 = 0.05;

/// What light makes of one pigment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Material {
    /// Colour of light scattered by this hair and its neighbours.
    pub(super) diffuse: Vec3,
    /// Energy of the light reflected at the surface.
    pub(super) reflected: Vec3,
    /// Energy of the light let through.
    pub(super) transmitted: Vec3,
    /// Energy of the light returned from inside.
    pub(super) returned: Vec3,
}

/// The material of every strand.
pub(super) struct Materials {
    levels: Vec<Material>,
    of_strand: Vec<u8>,
    /// Part of the light that a hair takes away from what goes on past it.
    pub(super) taken: Vec3,
}

impl Materials {
    pub(super) fn new(strands: &Strands, look: &HairLook) -> Self {
        let (factors, of_strand) = pigment_levels(strands, look);
        let levels = factors.into_iter().map(|factor| material(look, factor)).collect();
        let middle = material(look, 1.0);
        Self { levels, of_strand, taken: Vec3::ONE - middle.transmitted }
    }

    pub(super) fn of(&self, strand: u32) -> &Material {
        &self.levels[usize::from(self.of_strand[strand as usize])]
    }
}

/// Factors on the pigment, and which of them each strand has.
pub(crate) fn pigment_levels(strands: &Strands, look: &HairLook) -> (Vec<f32>, Vec<u8>) {
    let of_strand = match values(strands, "tint") {
        Some(AttributeValues::F32(tint)) => tint.iter().map(|&t| level(t)).collect(),
        _ => varied(strands, look.variation),
    };
    ((0..LEVELS).map(level_factor).collect(), of_strand)
}

/// Values of an attribute of the strands.
fn values<'a>(strands: &'a Strands, name: &str) -> Option<&'a AttributeValues> {
    let attribute = strands.attribute(name)?;
    (attribute.domain == Domain::Strand).then_some(&attribute.values)
}

/// Levels that vary from strand to strand, and from wisp to wisp if wisps are known.
fn varied(strands: &Strands, variation: f32) -> Vec<u8> {
    let guide = match values(strands, "guide") {
        Some(AttributeValues::U32(guide)) => Some(guide),
        _ => None,
    };
    let variation = if variation.is_finite() { variation.max(0.0) } else { 0.0 };
    (0..strands.len())
        .map(|i| {
            let wisp = guide.map_or(0.0, |g| deviate(g[i], 0x9e37_79b9));
            let strand = deviate(i as u32, 0x85eb_ca6b);
            level((variation * (strand + WISP_PART * wisp)).exp())
        })
        .collect()
}

/// How a strand's highlights differ from its neighbours': factor on the white one, and shift (rad).
/// Scales wear and stand off unevenly, and it is this glitter that tells strands apart.
pub(super) fn glitter(strand: u32) -> (f32, f32) {
    let strength = (GLITTER_STRENGTH * deviate(strand, 0xc2b2_ae35)).exp();
    (strength, GLITTER_SHIFT * deviate(strand, 0x27d4_eb2f))
}

/// A number of mean 0 and deviation about 1 that only `index` and `salt` decide.
fn deviate(index: u32, salt: u32) -> f32 {
    let bits = hash(index ^ salt);
    // The sum of four uniform bytes, of variance 4/12.
    let sum: f32 = bits.to_le_bytes().iter().map(|&b| f32::from(b) / 255.0 - 0.5).sum();
    sum * 3.0_f32.sqrt()
}

/// A mixing of 32 bits (the finaliser of MurmurHash3).
fn hash(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x85eb_ca6b);
    x = (x ^ (x >> 13)).wrapping_mul(0xc2b2_ae35);
    x ^ (x >> 16)
}

/// Nearest level to a factor on the pigment; what is not positive is the least, NaN is 1.
fn level(factor: f32) -> u8 {
    let x = if factor.is_nan() { 0.0 } else { factor.max(1e-6).ln() / SPAN };
    let top = (LEVELS - 1) as f32;
    ((0.5 + 0.5 * x.clamp(-1.0, 1.0)) * top).round() as u8
}

fn level_factor(level: usize) -> f32 {
    let x = 2.0 * level as f32 / (LEVELS - 1) as f32 - 1.0;
    (SPAN * x).exp()
}

fn material(look: &HairLook, factor: f32) -> Material {
    let sigma_a = absorption(look.melanin.scaled(factor));
    let energy = fibre_energy(sigma_a, HAIR_INDEX);
    // The published colour is that of light from everywhere after all its bounces. A lamp's light
    // comes out of the lit side after fewer: a part of that path, hence the power.
    let colour = apparent_colour(sigma_a, AZIMUTHAL_ROUGHNESS).map(|c| c.powf(PATH));
    Material {
        // Among much hair some light only ever meets surfaces, and keeps its colour.
        diffuse: look.diffuse * (colour + SHEEN * energy.reflected),
        reflected: look.primary * energy.reflected,
        transmitted: look.transmission * energy.transmitted,
        returned: look.secondary * energy.returned,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_and_factors_agree() {
        for factor in [0.3_f32, 1.0, 1.1, 3.0] {
            let back = level_factor(usize::from(level(factor)));
            assert!((back / factor - 1.0).abs() < 0.025, "{factor} {back}");
        }
        assert_eq!(level_factor(usize::from(level(1.0))), 1.0);
        assert_eq!(level(f32::NAN), level(1.0));
        assert_eq!((level(-1.0), level(f32::INFINITY)), (0, 64));
    }

    #[test]
    fn deviates_have_the_moments_they_should() {
        let n = 10_000;
        let all: Vec<f32> = (0..n).map(|i| deviate(i, 7)).collect();
        let mean = all.iter().sum::<f32>() / n as f32;
        let variance = all.iter().map(|x| x * x).sum::<f32>() / n as f32;
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.05, "{mean} {variance}");
    }
}
