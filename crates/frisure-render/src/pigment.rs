//! Absorption along each strand: pigment, fades, dye and white hairs.

use frisure_look::{Dye, Fade, HairLook};
use frisure_strands::{AttributeValues, Domain, Strands};
use glam::Vec3;

use crate::hash::mix;

/// Relative deviation of the pigment from wisp to wisp, over that from strand to strand; chosen by eye.
const WISP_PART: f32 = 0.6;
/// Least and greatest factor on the pigment of a strand; chosen.
const FACTORS: (f32, f32) = (0.25, 4.0);
/// Length over which dye begins (m); chosen by eye.
const DYE_EDGE: f32 = 0.01;

/// The absorption of all hair.
pub(crate) struct Pigments {
    /// Absorption of a hair of the mean colour, per mean radius.
    natural: Vec3,
    /// Factor on the natural absorption of each strand; white hairs have 0.
    factors: Vec<f32>,
    along: Option<Along>,
}

/// How it changes from root to tip.
struct Along {
    /// First point of each strand.
    offsets: Vec<u32>,
    /// Distance of each point from its root (m).
    distance: Vec<f32>,
    roots: Fade,
    tips: Fade,
    dye: Option<Dye>,
}

impl Pigments {
    pub(crate) fn new(strands: &Strands, look: &HairLook) -> Self {
        let mut factors = match values(strands, "tint") {
            Some(AttributeValues::F32(tint)) => tint.iter().map(|&t| bounded(t)).collect(),
            _ => varied(strands, look),
        };
        if look.white_share > 0.0 {
            for (strand, factor) in factors.iter_mut().enumerate() {
                if is_white(strand as u32, look) {
                    *factor = 0.0;
                }
            }
        }
        let natural = look.natural().max(Vec3::ZERO);
        Self { natural, factors, along: Along::new(strands, look) }
    }

    /// Whether strands differ from root to tip.
    pub(crate) fn vary_along(&self) -> bool {
        self.along.is_some()
    }

    /// Absorption per mean radius of a strand, `place` points from its root: 2.5 is in the middle
    /// between the third point and the fourth.
    pub(crate) fn at(&self, strand: u32, place: f32) -> Vec3 {
        let natural = self.natural * self.factors[strand as usize];
        self.along.as_ref().map_or(natural, |along| along.at(natural, strand, place))
    }
}

impl Along {
    /// `None` where hair is the same from root to tip.
    fn new(strands: &Strands, look: &HairLook) -> Option<Self> {
        let HairLook { roots, tips, dye, .. } = *look;
        let plain = |fade: Fade| fade.factor == 1.0 || !(fade.length > 0.0);
        if plain(roots) && plain(tips) && dye.is_none() {
            return None;
        }
        let distance = strands.iter().flat_map(|strand| {
            let mut reached = 0.0;
            (0..strand.points.len()).map(move |i| {
                reached += strand.points[i].distance(strand.points[i.saturating_sub(1)]);
                reached
            })
        });
        let (distance, offsets) = (distance.collect(), strands.offsets().to_vec());
        Some(Self { offsets, distance, roots, tips, dye })
    }

    /// Distances of a strand's points from its root.
    fn points(&self, strand: u32) -> &[f32] {
        let strand = strand as usize;
        &self.distance[self.offsets[strand] as usize..self.offsets[strand + 1] as usize]
    }

    fn at(&self, natural: Vec3, strand: u32, place: f32) -> Vec3 {
        let points = self.points(strand);
        let Some(&length) = points.last() else { return natural };
        // The cast saturates.
        let before = (place as usize).min(points.len() - 1);
        let after = (before + 1).min(points.len() - 1);
        let part = (place - before as f32).clamp(0.0, 1.0);
        let from_root = points[before] + (points[after] - points[before]) * part;
        let factor = faded(self.roots, from_root) * faded(self.tips, length - from_root);
        let natural = natural * factor;
        self.dye.map_or(natural, |dye| natural.lerp(dye.absorption, strength(dye, from_root)))
    }
}

/// Factor on the pigment at a distance from the end that fades.
fn faded(fade: Fade, distance: f32) -> f32 {
    if !(fade.length > 0.0) {
        return 1.0;
    }
    fade.factor + (1.0 - fade.factor) * smooth(distance / fade.length)
}

/// How much of a dye there is at a distance from the root.
fn strength(dye: Dye, distance: f32) -> f32 {
    let edge =
        if dye.regrowth > 0.0 { smooth((distance - dye.regrowth) / DYE_EDGE + 0.5) } else { 1.0 };
    dye.strength.clamp(0.0, 1.0) * edge
}

/// 0 up to 0, 1 from 1 on, with level ends.
fn smooth(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Values of an attribute of the strands.
fn values<'a>(strands: &'a Strands, name: &str) -> Option<&'a AttributeValues> {
    let attribute = strands.attribute(name)?;
    (attribute.domain == Domain::Strand).then_some(&attribute.values)
}

/// Factors that vary from strand to strand, and from wisp to wisp if wisps are known.
fn varied(strands: &Strands, look: &HairLook) -> Vec<f32> {
    let guide = match values(strands, "guide") {
        Some(AttributeValues::U32(guide)) => Some(guide),
        _ => None,
    };
    let variation = if look.variation.is_finite() { look.variation.max(0.0) } else { 0.0 };
    let seed = mix(look.seed);
    (0..strands.len())
        .map(|i| {
            let wisp = guide.map_or(0.0, |g| deviate(g[i], seed ^ 0x9e37_79b9));
            let strand = deviate(i as u32, seed ^ 0x85eb_ca6b);
            // Log-normal: pigment varies by factors.
            bounded((variation * (strand + WISP_PART * wisp)).exp())
        })
        .collect()
}

/// Whether a strand is one of the white ones.
fn is_white(strand: u32, look: &HairLook) -> bool {
    let bits = mix(mix(strand ^ 0x51ed_270b) ^ look.seed);
    // 24 bits are exact.
    ((bits >> 8) as f32) < look.white_share * 16_777_216.0
}

/// A factor on the pigment, such as it can be; not-a-number is 1.
fn bounded(factor: f32) -> f32 {
    if factor.is_nan() { 1.0 } else { factor.clamp(FACTORS.0, FACTORS.1) }
}

/// A number of mean 0 and deviation about 1 that only `index` and `salt` decide.
pub(crate) fn deviate(index: u32, salt: u32) -> f32 {
    let bits = mix(index ^ salt);
    // The sum of four uniform bytes, of variance 4/12.
    let sum: f32 = bits.to_le_bytes().iter().map(|&b| f32::from(b) / 255.0 - 0.5).sum();
    sum * 3.0_f32.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviates_have_the_moments_they_should() {
        let n = 10_000;
        let all: Vec<f32> = (0..n).map(|i| deviate(i, 7)).collect();
        let mean = all.iter().sum::<f32>() / n as f32;
        let variance = all.iter().map(|x| x * x).sum::<f32>() / n as f32;
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.05, "{mean} {variance}");
    }
}
