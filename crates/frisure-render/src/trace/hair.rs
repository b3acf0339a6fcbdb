//! The fibre that each strand is, for light.

use frisure_optics::scattering::{Fibre, FibreError, FibreSpec};
use frisure_optics::{absorption, apparent_colour};
use frisure_strands::{AttributeValues, Domain, Strands};
use glam::Vec3;

use crate::HairLook;
use crate::preview::pigment_levels;

/// Steps of wetness between dry and wet.
const WET_LEVELS: usize = 8;

/// Axis ratios are rounded to this.
const RATIO_STEP: f32 = 0.05;

/// Fibres by strand.
pub(super) struct Fibres {
    /// One for each level of pigment, of each level of wetness, of each axis ratio in turn.
    fibres: Vec<Fibre>,
    /// Axis ratio of each strand, as one of those that there are.
    ratio: Option<Vec<u16>>,
    /// Director d1 at each point.
    directors: Option<Vec<[f32; 3]>>,
    /// First point of each strand.
    offsets: Vec<u32>,
    wet_levels: usize,
    /// Pigment of each strand.
    level: Vec<u8>,
    levels: usize,
    /// Wetness of each strand, if any is wet.
    wet: Option<Vec<u8>>,
}

impl Fibres {
    pub(super) fn new(strands: &Strands, look: &HairLook) -> Result<Self, FibreError> {
        let (factors, level) = pigment_levels(strands, look);
        let wet = wetness(strands);
        let steps = if wet.is_some() { WET_LEVELS } else { 0 };
        let (ratios, ratio) = ratios(strands);
        let mut fibres = Vec::with_capacity(ratios.len() * (steps + 1) * factors.len());
        for axis_ratio in ratios {
            for step in 0..=steps {
                let wetness = step as f32 / WET_LEVELS as f32;
                let base = Fibre::new(FibreSpec { wetness, axis_ratio, ..FibreSpec::default() })?;
                for factor in &factors {
                    fibres.push(base.with_absorption(absorption(look.melanin.scaled(*factor)))?);
                }
            }
        }
        let directors = match strands.attribute("d1").map(|a| (&a.values, a.domain)) {
            Some((AttributeValues::F32x3(d1), Domain::Point)) => Some(d1.clone()),
            _ => None,
        };
        let (offsets, levels) = (strands.offsets().to_vec(), factors.len());
        Ok(Self { fibres, ratio, directors, offsets, wet_levels: steps + 1, level, levels, wet })
    }

    pub(super) fn of(&self, strand: u32) -> &Fibre {
        let strand = strand as usize;
        let wet = self.wet.as_ref().map_or(0, |wet| usize::from(wet[strand]));
        let ratio = self.ratio.as_ref().map_or(0, |ratio| usize::from(ratio[strand]));
        let of = ratio * self.wet_levels + wet;
        &self.fibres[of * self.levels + usize::from(self.level[strand])]
    }

    /// Colour that much hair like a strand appears to have.
    pub(super) fn albedo(&self, strand: u32) -> Vec3 {
        let spec = self.of(strand).spec();
        apparent_colour(spec.absorption, spec.azimuthal_roughness)
    }

    /// Director d1 between a point of a strand and the next; none where the strands do not say.
    pub(super) fn director(&self, strand: u32, segment: u32, u: f32) -> Option<Vec3> {
        let directors = self.directors.as_ref()?;
        let first = (self.offsets[strand as usize] + segment) as usize;
        let next = (first + 1).min(self.offsets[strand as usize + 1] as usize - 1);
        Some(Vec3::from(directors[first]).lerp(directors[next].into(), u))
    }
}

/// The axis ratios that there are, rounded, and which each strand has.
fn ratios(strands: &Strands) -> (Vec<f32>, Option<Vec<u16>>) {
    let attribute = strands.attribute("axis_ratio").filter(|a| a.domain == Domain::Strand);
    let Some(AttributeValues::F32(ratios)) = attribute.map(|a| &a.values) else {
        return (vec![1.0], None);
    };
    // The fibre's own limits; steps of equal ratio.
    let step = |ratio: &f32| (ratio.clamp(0.2, 5.0).ln() / RATIO_STEP).round() as i16;
    let mut known: Vec<i16> = ratios.iter().map(step).collect();
    known.sort_unstable();
    known.dedup();
    let place = |ratio: &f32| known.partition_point(|k| *k < step(ratio)) as u16;
    let of_strand = ratios.iter().map(place).collect();
    let values = known.iter().map(|k| (f32::from(*k) * RATIO_STEP).exp().clamp(0.2, 5.0));
    (values.collect(), Some(of_strand))
}

/// Wetness of each strand: that of its root.
fn wetness(strands: &Strands) -> Option<Vec<u8>> {
    let attribute = strands.attribute("wetness").filter(|a| a.domain == Domain::Point)?;
    let AttributeValues::F32(values) = &attribute.values else { return None };
    let step = |first: &u32| {
        let wet = values.get(*first as usize).copied().unwrap_or(0.0);
        (wet.clamp(0.0, 1.0) * WET_LEVELS as f32).round() as u8
    };
    let offsets = strands.offsets();
    Some(offsets[..offsets.len() - 1].iter().map(step).collect())
}
