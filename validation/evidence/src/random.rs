//! Hair drawn at random, the same on every machine.

use frisure::rod::{
    InvalidQuantity, Load, Material, NaturalStrain, RodSpec, Root, Section, SplitMix64,
    StrainProfile, TorsionConstant,
};
use glam::{DMat3, DVec3};

/// The random stream of one item of an experiment.
pub(crate) fn stream(seed: u64, item: usize) -> SplitMix64 {
    let mut random = SplitMix64(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ (item as u64) << 20);
    // Neighbouring seeds give unrelated streams.
    random.unit();
    random
}

/// Realistic hair: 1 to 60 cm, 45 to 110 µm, straight to the tightest coil, a tenth of it
/// curled in a plane, its root in any direction.
pub(crate) fn realistic(random: &mut SplitMix64) -> Result<RodSpec, InvalidQuantity> {
    let natural = if random.unit() < 0.15 {
        NaturalStrain::STRAIGHT
    } else {
        let radius = random.decades(0.0015, 0.06);
        let pitch = if random.unit() < 0.12 { 0.0 } else { random.decades(0.002, 0.1) };
        NaturalStrain::helix(radius, if random.unit() < 0.5 { pitch } else { -pitch })?
    };
    let (tangent, d1) = (random.direction(), random.direction());
    Ok(RodSpec {
        length: random.decades(0.01, 0.6),
        section: Section::from_diameter(random.between(45e-6, 110e-6), random.between(1.0, 2.0))?,
        material: Material::new(random.between(1e9, 5e9), random.between(0.4e9, 1.4e9), 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural,
        root: Root::from_tangent(DVec3::ZERO, tangent, d1)?,
        load: Load::down(9.81),
    })
}

/// Realistic hair with two curls: half of it changes linearly from one to the other, half jumps, as permed hair
/// does that has grown.
pub(crate) fn two_curls(random: &mut SplitMix64) -> Result<RodSpec, InvalidQuantity> {
    let spec = realistic(random)?;
    let length = spec.length;
    let mut strain = || {
        let radius = random.decades(0.0015, 0.06);
        let pitch = radius * random.between(-3.0, 3.0);
        let about = random.between(0.0, std::f64::consts::TAU);
        let helix = NaturalStrain::helix(radius, pitch)?.at(0.0);
        Ok(DMat3::from_rotation_z(about) * helix)
    };
    let (upper, lower) = (strain()?, strain()?);
    let at = length * random.between(0.02, 0.98);
    let knots = if random.unit() < 0.5 {
        vec![(0.0, upper), (length, lower)]
    } else {
        vec![(0.0, upper), (at, upper), (at + 1e-9 * length, lower), (length, lower)]
    };
    Ok(RodSpec { natural: NaturalStrain::Varying(StrainProfile::new(knots)?), ..spec })
}

/// Fibres of the length and thickness of hair that hardly resist twist, up to thirteen times as wide as thick.
pub(crate) fn soft_in_twist(random: &mut SplitMix64) -> Result<RodSpec, InvalidQuantity> {
    let spec = realistic(random)?;
    let young = spec.material.youngs_modulus();
    let diameter = random.between(45e-6, 110e-6);
    Ok(RodSpec {
        section: Section::from_diameter(diameter, random.decades(1.0, 13.0))?,
        material: Material::new(young, young * random.decades(1e-4, 3e-3), 1300.0)?,
        ..spec
    })
}

/// Absurd hair: from a bristle of a millimetre to ten metres of thread, rubber to
/// diamond, weightless to the surface of a dwarf star, curled up to forty times.
pub(crate) fn absurd(random: &mut SplitMix64) -> Result<RodSpec, InvalidQuantity> {
    let length = random.decades(1e-3, 10.0);
    let strain = random.direction() * (random.decades(0.01, 250.0) / length);
    let natural = match random.unit() {
        u if u < 0.15 => DVec3::ZERO,
        u if u < 0.35 => DVec3::new(strain.length(), 0.0, 0.0),
        _ => strain,
    };
    let (tangent, d1) = match random.unit() {
        u if u < 0.2 => (DVec3::Z, DVec3::X),
        u if u < 0.3 => (DVec3::NEG_Z, DVec3::X),
        _ => (random.direction(), random.direction()),
    };
    let section = Section::from_diameter(random.decades(1e-6, 1e-2), random.decades(1.0, 10.0))?;
    let young = random.decades(1e5, 1e12);
    let material =
        Material::new(young, young * random.decades(0.02, 2.0), random.decades(1.0, 2e4))?;
    // From almost weightless to heavier than a metre of silk.
    let heaviness = random.decades(1e-4, 3e4);
    let unit = material.density() * section.area() * length.powi(3);
    let bend = young * section.i1().min(section.i2());
    Ok(RodSpec {
        length,
        section,
        material,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::Uniform(natural),
        root: Root::from_tangent(random.cube() * 10.0, tangent, d1)?,
        load: Load::down(if random.unit() < 0.05 { 0.0 } else { heaviness * bend / unit }),
    })
}
