//! Absorption along each strand: pigment, fades, dye and white hairs.

use frisure_look::{
    Dye, Fade, HairLook, Melanin, absorption, absorption_of_colour, apparent_colour,
};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands, names};
use glam::Vec3;

use crate::hash::mix;
use crate::scene::{LASH_PIGMENT, PIGMENT};

/// Relative deviation of the pigment from wisp to wisp, over that from strand to strand; chosen by eye.
const WISP_PART: f32 = 0.6;
/// Correlation of the whiteness of two hairs of one wisp: hair turns grey in patches, so that locks differ. Chosen by eye.
const WHITE_CORRELATION: f32 = 0.15;
/// White hairs among those of brows, over the share on the head: brows turn grey later. Chosen by eye.
const WHITE_BROWS: f32 = 0.4;
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
    /// How much more pigment a strand has than others, over theirs; empty where none has.
    more: Vec<f32>,
    /// Absorption of as much of it as others have.
    ash: Vec3,
    along: Option<Along>,
    own: Option<Own>,
}

/// The absorption of strands that bring their colours.
struct Own {
    /// First point of each strand, if each point has a colour.
    offsets: Option<Vec<u32>>,
    /// Per mean radius, of each strand or point.
    absorption: Vec<Vec3>,
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
        let more = match values(strands, PIGMENT) {
            Some(AttributeValues::F32(all)) => all.iter().map(|&all| all - 1.0).collect(),
            _ => Vec::new(),
        };
        if look.white_share > 0.0 {
            let guides = guides(strands);
            let threshold = normal_quantile(look.white_share);
            let of_brows = normal_quantile(WHITE_BROWS * look.white_share);
            for (strand, factor) in factors.iter_mut().enumerate() {
                let more = more.get(strand).copied().unwrap_or(0.0);
                // Lashes seldom turn grey.
                let lash = more + 1.0 >= LASH_PIGMENT;
                let white = whiteness(strand as u32, guides.map(|g| g[strand]), look.seed);
                let below = if more > 0.0 { of_brows } else { threshold };
                if white < below && !lash {
                    *factor = 0.0;
                }
            }
        }
        let natural = look.natural().max(Vec3::ZERO);
        // Brows and lashes are darker than the hair of the head, not redder, and the skin between them reddens them: what they have more
        // is half eumelanin and half black, with the green of the natural pigments. Chosen by eye.
        let eumelanin = absorption(Melanin { eumelanin: 1.0, pheomelanin: 0.0 });
        let ash = (eumelanin / eumelanin.y + Vec3::ONE) * (0.5 * natural.y);
        let own = look.own_colours.then(|| Own::new(strands, look)).flatten();
        Self { natural, factors, more, ash, along: Along::new(strands, look), own }
    }

    /// Whether strands differ from root to tip.
    pub(crate) fn vary_along(&self) -> bool {
        match &self.own {
            Some(own) => own.offsets.is_some(),
            None => self.along.is_some(),
        }
    }

    /// Absorption per mean radius of a strand, `place` points from its root: 2.5 is in the middle
    /// between the third point and the fourth.
    pub(crate) fn at(&self, strand: u32, place: f32) -> Vec3 {
        if let Some(own) = &self.own {
            return own.at(strand, place);
        }
        let index = strand as usize;
        let more = self.more.get(index).copied().unwrap_or(0.0);
        let natural = (self.natural + self.ash * more) * self.factors[index];
        self.along.as_ref().map_or(natural, |along| along.at(natural, strand, place))
    }
}

/// The apparent colours (linear sRGB) of strands that one colour does not tell, as the attribute `color`: of each strand where some are white,
/// of each point where hair differs from root to tip. `None` where neither is so.
#[must_use]
pub fn strand_colours(strands: &Strands, look: &HairLook) -> Option<Attribute> {
    let pigments = Pigments::new(strands, look);
    if look.white_share <= 0.0 && !pigments.vary_along() {
        return None;
    }
    let colour =
        |absorption| apparent_colour(absorption, look.surface.azimuthal_roughness).to_array();
    let (domain, values) = if pigments.vary_along() {
        let each = strands.iter().zip(0_u32..).flat_map(|(strand, index)| {
            let pigments = &pigments;
            (0..strand.points.len()).map(move |k| pigments.at(index, k as f32))
        });
        (Domain::Point, each.map(colour).collect())
    } else {
        let each = (0..strands.len()).map(|index| pigments.at(index as u32, 0.0));
        (Domain::Strand, each.map(colour).collect())
    };
    Some(Attribute { name: names::COLOUR.into(), domain, values: AttributeValues::F32x3(values) })
}

impl Own {
    /// `None` where strands have no colours.
    fn new(strands: &Strands, look: &HairLook) -> Option<Self> {
        let Attribute { domain, values, .. } = strands.attribute(names::COLOUR)?;
        let AttributeValues::F32x3(colours) = values else { return None };
        let offsets = (*domain == Domain::Point).then(|| strands.offsets().to_vec());
        let of = |c: &[f32; 3]| {
            absorption_of_colour(Vec3::from_array(*c), look.surface.azimuthal_roughness)
        };
        Some(Self { offsets, absorption: colours.iter().map(of).collect() })
    }

    fn at(&self, strand: u32, place: f32) -> Vec3 {
        let strand = strand as usize;
        let Some(offsets) = &self.offsets else { return self.absorption[strand] };
        let points = &self.absorption[offsets[strand] as usize..offsets[strand + 1] as usize];
        let (before, after, part) = between(points.len(), place);
        points[before].lerp(points[after], part)
    }
}

/// The points before and after a place, counted from the root, of a strand with so many, and how far it is from one to the other.
fn between(points: usize, place: f32) -> (usize, usize, f32) {
    // The cast saturates.
    let before = (place as usize).min(points - 1);
    (before, (before + 1).min(points - 1), (place - before as f32).clamp(0.0, 1.0))
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
        let (before, after, part) = between(points.len(), place);
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
    let guide = guides(strands);
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

/// The wisp of each strand, if wisps are known.
fn guides(strands: &Strands) -> Option<&[u32]> {
    match values(strands, "guide") {
        Some(AttributeValues::U32(guides)) => Some(guides),
        _ => None,
    }
}

/// A standard normal number of a strand; those whose number is below the quantile of the share of white hairs are white,
/// so that a larger share keeps the same hairs white. Strands of one wisp have correlated numbers (a Gaussian copula): the
/// share of the head is as asked for, and that of a wisp varies about it.
fn whiteness(strand: u32, wisp: Option<u32>, seed: u32) -> f32 {
    let own = normal_quantile(unit(mix(mix(strand ^ 0x51ed_270b) ^ seed)));
    wisp.map_or(own, |wisp| {
        let shared = normal_quantile(unit(mix(mix(wisp ^ 0x2545_f491) ^ seed)));
        (1.0 - WHITE_CORRELATION).sqrt() * own + WHITE_CORRELATION.sqrt() * shared
    })
}

/// A number between 0 and 1, neither of them, from random bits.
fn unit(bits: u32) -> f32 {
    // 23 bits and a half are exact.
    ((bits >> 9) as f32 + 0.5) / 8_388_608.0
}

/// The standard normal number below which a share of all is: Abramowitz & Stegun, *Handbook of Mathematical Functions*,
/// 26.2.23, to within 4.5e-4; infinite at 0 and 1.
fn normal_quantile(share: f32) -> f32 {
    let tail = share.min(1.0 - share);
    if tail.is_nan() || tail <= 0.0 {
        return if share > 0.5 { f32::INFINITY } else { f32::NEG_INFINITY };
    }
    let t = (-2.0 * tail.ln()).sqrt();
    let above = t
        - (2.515_517 + t * (0.802_853 + t * 0.010_328))
            / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)));
    if share < 0.5 { -above } else { above }
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
    fn normal_quantiles_are_those_of_the_table() {
        for (share, x) in [(0.5, 0.0), (0.841_345, 1.0), (0.977_25, 2.0), (0.158_655, -1.0)] {
            assert!((normal_quantile(share) - x).abs() < 1e-3, "{share}");
        }
        assert_eq!([0.0, 1.0].map(normal_quantile), [f32::NEG_INFINITY, f32::INFINITY]);
    }

    #[test]
    fn the_head_has_the_share_of_white_hairs_and_wisps_differ() {
        let (wisps, hairs) = (300, 400);
        let threshold = normal_quantile(0.4);
        let share = |wisp: u32| {
            let white =
                (0..hairs).filter(|h| whiteness(wisp * hairs + h, Some(wisp), 3) < threshold);
            white.count() as f32 / hairs as f32
        };
        let shares: Vec<f32> = (0..wisps).map(share).collect();
        let mean = shares.iter().sum::<f32>() / wisps as f32;
        let variance = shares.iter().map(|s| (s - mean).powi(2)).sum::<f32>() / wisps as f32;
        // Independent hairs would differ by √(0.24/400) = 0.024; a wisp whose shared number is one deviation off has 0.26 or 0.56.
        assert!((mean - 0.4).abs() < 0.03, "{mean}");
        assert!((0.11..0.19).contains(&variance.sqrt()), "{}", variance.sqrt());
    }

    /// Hairs of 10 cm with 3 points.
    fn hairs(count: u32) -> Strands {
        let mut strands = Strands::new();
        for i in 0..count {
            let place = |k: u8| Vec3::new(i as f32, 0.0, -0.05 * f32::from(k));
            strands.push(&[place(0), place(1), place(2)], &[4e-5; 3]);
        }
        strands
    }

    #[test]
    fn colours_of_strands_tell_what_one_colour_does_not() {
        let mut strands = hairs(4000);
        assert_eq!(strand_colours(&strands, &HairLook::default()), None);
        let grey = HairLook { white_share: 0.4, ..HairLook::default() };
        let Attribute { domain, values, .. } = strand_colours(&strands, &grey).unwrap();
        let AttributeValues::F32x3(colours) = values else { panic!() };
        let white = colours.iter().filter(|c| **c == [1.0; 3]).count();
        assert!(domain == Domain::Strand && (1500..1700).contains(&white), "{domain:?} {white}");
        // Regrown hair is dyed from 4 cm on. In their own colours strands are as dark as in the look that they come from.
        let absorption = absorption_of_colour(Vec3::new(0.1, 0.2, 0.8), 0.3);
        let dye = Some(Dye { absorption, strength: 1.0, regrowth: 0.04 });
        let look = HairLook { dye, ..grey };
        let colours = strand_colours(&strands, &look).unwrap();
        assert_eq!(colours.domain, Domain::Point);
        strands.set_attribute(colours).unwrap();
        let own = Pigments::new(&strands, &HairLook { own_colours: true, ..HairLook::default() });
        let pigments = Pigments::new(&strands, &look);
        assert!(own.vary_along());
        // No colour is darker than a thousandth.
        let darkest = absorption_of_colour(Vec3::ZERO, look.surface.azimuthal_roughness);
        for strand in 0..100 {
            for place in [0.0, 1.0, 2.0] {
                let (a, b) = (own.at(strand, place), pigments.at(strand, place).min(darkest));
                assert!(a.distance(b) < 1e-3 * b.length() + 1e-6, "{strand} {place}: {a} {b}");
            }
        }
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
