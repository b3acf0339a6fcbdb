//! The fibre that each place of each strand is, for light.

use frisure_look::{HairLook, Scattering, apparent_colour};
use frisure_optics::scattering::{Fibre, FibreError, FibreSpec};
use frisure_strands::{AttributeValues, Domain, Strands};
use glam::Vec3;

use crate::pigment::Pigments;

/// Steps of wetness between dry and wet: fibres are prepared once for each. Chosen.
const WET_LEVELS: usize = 16;

/// Logarithm of the ratio between neighbouring axis ratios: fibres are prepared for steps of 5 %. Chosen.
const RATIO_STEP: f32 = 0.05;

/// Fibres by place.
pub(super) struct Fibres {
    /// One for each level of wetness, of each axis ratio in turn.
    fibres: Vec<Fibre>,
    scattering: Scattering,
    pigments: Pigments,
    /// Axis ratio of each strand, as one of those that there are.
    ratio: Option<Vec<u16>>,
    /// Director d1 at each point.
    directors: Option<Vec<[f32; 3]>>,
    /// First point of each strand.
    offsets: Vec<u32>,
    wet_levels: usize,
    /// Wetness at each point in levels, if any is wet.
    wet: Option<Vec<u8>>,
}

impl Fibres {
    pub(super) fn new(strands: &Strands, look: &HairLook) -> Result<Self, FibreError> {
        let wet = wetness(strands);
        let steps = if wet.is_some() { WET_LEVELS } else { 0 };
        let (ratios, ratio) = ratios(strands);
        let mut fibres = Vec::with_capacity(ratios.len() * (steps + 1));
        for axis_ratio in ratios {
            for step in 0..=steps {
                let wetness = step as f32 / WET_LEVELS as f32;
                fibres.push(Fibre::new(FibreSpec { wetness, axis_ratio, ..spec(look) })?);
            }
        }
        // Without directors a section has no orientation: hits then take any d1.
        let directors = match strands.attribute("d1").map(|a| (&a.values, a.domain)) {
            Some((AttributeValues::F32x3(d1), Domain::Point)) => Some(d1.clone()),
            _ => None,
        };
        let pigments = Pigments::new(strands, look);
        let (offsets, wet_levels) = (strands.offsets().to_vec(), steps + 1);
        let scattering = look.surface.scattering;
        Ok(Self { fibres, scattering, pigments, ratio, directors, offsets, wet_levels, wet })
    }

    /// The model by which fibres scatter light.
    pub(super) fn scattering(&self) -> Scattering {
        self.scattering
    }

    /// The fibre between a point of a strand and the next, and what it absorbs there.
    pub(super) fn at(&self, strand: u32, segment: u32, u: f32) -> (&Fibre, Vec3) {
        let ratio = self.ratio.as_ref().map_or(0, |ratio| usize::from(ratio[strand as usize]));
        let wet = self.wet.as_ref().map_or(0, |wet| {
            let [before, after] = self.points(strand, segment).map(|point| f32::from(wet[point]));
            (before + (after - before) * u).round() as usize
        });
        let fibre = &self.fibres[ratio * self.wet_levels + wet.min(self.wet_levels - 1)];
        (fibre, self.pigments.at(strand, segment as f32 + u))
    }

    /// Colour that much hair like a place of a strand appears to have.
    pub(super) fn albedo(&self, strand: u32, segment: u32, u: f32) -> Vec3 {
        let (fibre, absorption) = self.at(strand, segment, u);
        apparent_colour(absorption, fibre.spec().azimuthal_roughness)
    }

    /// Director d1 between a point of a strand and the next; none where the strands do not say.
    pub(super) fn director(&self, strand: u32, segment: u32, u: f32) -> Option<Vec3> {
        let directors = self.directors.as_ref()?;
        let [before, after] =
            self.points(strand, segment).map(|point| Vec3::from(directors[point]));
        Some(before.lerp(after, u))
    }

    /// A point of a strand and the next.
    fn points(&self, strand: u32, segment: u32) -> [usize; 2] {
        let first = (self.offsets[strand as usize] + segment) as usize;
        [first, (first + 1).min(self.offsets[strand as usize + 1] as usize - 1)]
    }
}

/// A dry round white hair of this look.
fn spec(look: &HairLook) -> FibreSpec {
    FibreSpec {
        index: look.surface.index,
        longitudinal_roughness: look.surface.longitudinal_roughness,
        azimuthal_roughness: look.surface.azimuthal_roughness,
        tilt: look.surface.tilt,
        ..FibreSpec::default()
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

/// Wetness at each point, in levels.
fn wetness(strands: &Strands) -> Option<Vec<u8>> {
    let attribute = strands.attribute("wetness").filter(|a| a.domain == Domain::Point)?;
    let AttributeValues::F32(values) = &attribute.values else { return None };
    // The cast takes not-a-number for 0.
    let level = |wet: &f32| (wet.clamp(0.0, 1.0) * WET_LEVELS as f32).round() as u8;
    values.iter().any(|wet| *wet > 0.0).then(|| values.iter().map(level).collect())
}
