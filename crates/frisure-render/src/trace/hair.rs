//! The fibre that each strand is, for light.

use frisure_optics::absorption;
use frisure_optics::scattering::{Fibre, FibreError, FibreSpec};
use frisure_strands::{AttributeValues, Domain, Strands};

use crate::HairLook;
use crate::preview::pigment_levels;

/// Steps of wetness between dry and wet.
const WET_LEVELS: usize = 8;

/// Fibres by strand.
pub(super) struct Fibres {
    /// One for each level of pigment, of each level of wetness in turn.
    fibres: Vec<Fibre>,
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
        let mut fibres = Vec::with_capacity((steps + 1) * factors.len());
        for step in 0..=steps {
            let wetness = step as f32 / WET_LEVELS as f32;
            let base = Fibre::new(FibreSpec { wetness, ..FibreSpec::default() })?;
            for factor in &factors {
                fibres.push(base.with_absorption(absorption(look.melanin.scaled(*factor)))?);
            }
        }
        Ok(Self { fibres, level, levels: factors.len(), wet })
    }

    pub(super) fn of(&self, strand: u32) -> &Fibre {
        let strand = strand as usize;
        let wet = self.wet.as_ref().map_or(0, |wet| usize::from(wet[strand]));
        &self.fibres[wet * self.levels + usize::from(self.level[strand])]
    }
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
