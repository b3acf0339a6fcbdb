//! The material of hair at each place of a strand, as colours and energies of the preview's shading.

use frisure_look::apparent_colour;
use frisure_optics::{FibreEnergy, fibre_energy};
use frisure_strands::Strands;
use glam::Vec3;

use crate::pigment::{Pigments, deviate};
use frisure_look::HairLook;

/// Entries of the table for each factor of e in absorption, and the logarithms of the least and the
/// greatest absorption in it. Chosen.
const PER_E: f32 = 8.0;
const LEAST: f32 = -16.0;
const GREATEST: f32 = 8.0;

/// Decay of the colour of much hair with the root of its absorption, as part of that of the published
/// fit for all light from everywhere; and the absorption of the same effect as the light that leaves a
/// head for its ends and its skin. Both fitted to traced heads.
const DECAY: f32 = 0.93;
/// Diffuse light of white hair, as part of that of Kajiya & Kay; fitted likewise.
const DIFFUSE: f32 = 1.12;
const LOSS: f32 = 0.006;
/// Part of the light reflected by one hair that its neighbours reflect on to the eye.
const SHEEN: f32 = 0.04;
/// Part of the light reflected at a surface that the lobes should have, which have more in the middle of
/// a highlight than the traced ones.
const PRIMARY: f32 = 0.9;
/// Factor on light that passes a hair: most of it meets another hair, which a preview does not follow.
const TRANSMISSION: f32 = 0.6;
/// Points of the hair whose mean is the extinction per hair; chosen.
const EXTINCTION_SAMPLES: usize = 4096;
/// Deviation of the white highlight's strength from strand to strand, as a power of e.
const GLITTER_STRENGTH: f32 = 0.35;
/// Deviation of the highlights' place from strand to strand (rad).
const GLITTER_SHIFT: f32 = 0.05;

/// The material at one place of a strand.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    /// Colour of light scattered by this hair and its neighbours.
    pub diffuse: Vec3,
    /// Energy of the light reflected at the surface.
    pub reflected: Vec3,
    /// Energy of the light let through.
    pub transmitted: Vec3,
    /// Energy of the light returned from inside.
    pub returned: Vec3,
}

/// The material of every place.
pub struct Materials {
    pigments: Pigments,
    /// Diffuse, transmitted and returned light by absorption; each colour is looked up for itself.
    table: Vec<[f32; 3]>,
    reflected: Vec3,
}

impl Materials {
    /// The materials of all strands in a look.
    #[must_use]
    pub fn new(strands: &Strands, look: &HairLook) -> Self {
        let pigments = Pigments::new(strands, look);
        let absorptions = (0..=((GREATEST - LEAST) * PER_E) as u16)
            .map(|i| if i == 0 { 0.0 } else { (LEAST + f32::from(i) / PER_E).exp() });
        let table = absorptions.map(|sigma| entry(sigma, look)).collect();
        let reflected = PRIMARY * fibre_energy(Vec3::ZERO, look.surface.index).reflected;
        Self { pigments, table, reflected }
    }

    /// The material of a strand, `place` points from its root.
    ///
    /// # Panics
    /// If there is no such strand.
    #[must_use]
    pub fn at(&self, strand: u32, place: f32) -> Material {
        self.of(self.pigments.at(strand, place))
    }

    /// Energy of the light reflected at the surface, the same everywhere.
    #[must_use]
    pub fn reflected(&self) -> Vec3 {
        self.reflected
    }

    /// Whether strands differ from root to tip.
    #[must_use]
    pub fn vary_along(&self) -> bool {
        self.pigments.vary_along()
    }

    /// Extinction per hair, the part of the light that does not pass it: the mean over some of the
    /// places (strand, points from its root), of which there are `count`.
    #[must_use]
    pub fn extinction(&self, count: usize, places: impl Iterator<Item = (u32, f32)>) -> Vec3 {
        let (mut through, mut visited) = (Vec3::ZERO, 0.0);
        for (strand, place) in places.step_by(count / EXTINCTION_SAMPLES + 1) {
            through += self.at(strand, place).transmitted;
            visited += 1.0;
        }
        // Light that goes straight on through a fibre is not taken away.
        Vec3::ONE - through / f32::max(visited, 1.0)
    }

    fn of(&self, absorption: Vec3) -> Material {
        let [x, y, z] = absorption.to_array().map(|sigma| self.look_up(sigma));
        let part = |i: usize| Vec3::new(x[i], y[i], z[i]);
        let (diffuse, transmitted, returned) = (part(0), part(1), part(2));
        Material { diffuse, reflected: self.reflected, transmitted, returned }
    }

    fn look_up(&self, sigma: f32) -> [f32; 3] {
        let last = (self.table.len() - 1) as f32;
        // The logarithm of 0 is the table's first entry; the cast saturates.
        let x = ((sigma.ln() - LEAST) * PER_E).max(0.0).min(last);
        let before = (x as usize).min(self.table.len() - 2);
        let part = x - before as f32;
        let (a, b) = (&self.table[before], &self.table[before + 1]);
        [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part)
    }
}

/// Diffuse, transmitted and returned light of an absorption.
fn entry(sigma: f32, look: &HairLook) -> [f32; 3] {
    let FibreEnergy { reflected, transmitted, returned } =
        fibre_energy(Vec3::splat(sigma), look.surface.index);
    let of_all = |sigma| apparent_colour(Vec3::splat(sigma), look.surface.azimuthal_roughness).x;
    // Multiple scattering as the published colour of much hair, with the loss of light at the edges of a head: exactly
    // white without pigment.
    let colour = (of_all(sigma + LOSS) / of_all(LOSS)).powf(DECAY);
    // Among much hair some light only ever meets surfaces, and keeps its colour.
    [DIFFUSE * colour + SHEEN * reflected.x, TRANSMISSION * transmitted.x, returned.x]
}

/// How a strand's highlights differ from its neighbours': factor on the white one, and shift (rad).
/// Scales wear and stand off unevenly, and it is this glitter that tells strands apart.
#[must_use]
pub fn glitter(strand: u32) -> (f32, f32) {
    let strength = (GLITTER_STRENGTH * deviate(strand, 0xc2b2_ae35)).exp();
    (strength, GLITTER_SHIFT * deviate(strand, 0x27d4_eb2f))
}
