//! Hair drawn at random, the same on every machine.

use frisure::rod::{
    InvalidQuantity, Material, NaturalStrain, RodSpec, Root, Section, TorsionConstant,
};
use glam::DVec3;

/// Steele, Lea & Flood's `SplitMix64`.
pub(crate) struct Random(u64);

impl Random {
    /// The random stream of one item of an experiment.
    pub(crate) fn new(seed: u64, item: usize) -> Self {
        let mut random = Self(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ (item as u64) << 20);
        // Neighbouring seeds give unrelated streams.
        random.unit();
        random
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Evenly spread logarithms.
    pub(crate) fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// Uniform in the cube [−1, 1]³.
    pub(crate) fn cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - DVec3::ONE
    }

    /// Uniform on the unit sphere.
    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.cube();
            if v.length_squared() > 1e-4 && v.length_squared() < 1.0 {
                return v.normalize();
            }
        }
    }

    /// Realistic hair: 1 to 60 cm, 45 to 110 µm, straight to the tightest coil, a tenth of it
    /// curled in a plane, its root in any direction.
    pub(crate) fn realistic(&mut self) -> Result<RodSpec, InvalidQuantity> {
        let natural = if self.chance(0.15) {
            NaturalStrain::STRAIGHT
        } else {
            let radius = self.decades(0.0015, 0.06);
            let pitch = if self.chance(0.12) { 0.0 } else { self.decades(0.002, 0.1) };
            NaturalStrain::helix(radius, if self.chance(0.5) { pitch } else { -pitch })?
        };
        let (tangent, d1) = (self.direction(), self.direction());
        Ok(RodSpec {
            length: self.decades(0.01, 0.6),
            section: Section::from_diameter(self.between(45e-6, 110e-6), self.between(1.0, 2.0))?,
            material: Material::new(self.between(1e9, 5e9), self.between(0.4e9, 1.4e9), 1300.0)?,
            torsion: TorsionConstant::SaintVenant,
            natural,
            root: Root::from_tangent(DVec3::ZERO, tangent, d1)?,
            gravity: 9.81,
        })
    }

    /// Absurd hair: from a bristle of a millimetre to ten metres of thread, rubber to
    /// diamond, weightless to the surface of a dwarf star, curled up to forty times.
    pub(crate) fn absurd(&mut self) -> Result<RodSpec, InvalidQuantity> {
        let length = self.decades(1e-3, 10.0);
        let strain = self.direction() * (self.decades(0.01, 250.0) / length);
        let natural = match self.unit() {
            u if u < 0.15 => DVec3::ZERO,
            u if u < 0.35 => DVec3::new(strain.length(), 0.0, 0.0),
            _ => strain,
        };
        let (tangent, d1) = match self.unit() {
            u if u < 0.2 => (DVec3::Z, DVec3::X),
            u if u < 0.3 => (DVec3::NEG_Z, DVec3::X),
            _ => (self.direction(), self.direction()),
        };
        let section = Section::from_diameter(self.decades(1e-6, 1e-2), self.decades(1.0, 10.0))?;
        let young = self.decades(1e5, 1e12);
        let material =
            Material::new(young, young * self.decades(0.02, 2.0), self.decades(1.0, 2e4))?;
        // From almost weightless to heavier than a metre of silk.
        let heaviness = self.decades(1e-4, 3e4);
        let unit = material.density() * section.area() * length.powi(3);
        let bend = young * section.i1().min(section.i2());
        Ok(RodSpec {
            length,
            section,
            material,
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::Uniform(natural),
            root: Root::from_tangent(self.cube() * 10.0, tangent, d1)?,
            gravity: if self.chance(0.05) { 0.0 } else { heaviness * bend / unit },
        })
    }
}
