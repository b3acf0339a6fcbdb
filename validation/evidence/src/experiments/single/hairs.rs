//! The rods of figure 3.

use frisure::rod::{
    Equilibrium, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant,
    equilibrium,
};
use glam::DVec3;

use crate::Stopped;
use crate::rods::to_accuracy;

pub(super) fn spec(
    length: f64,
    eccentricity: f64,
    natural: NaturalStrain,
) -> Result<RodSpec, Stopped> {
    Ok(RodSpec {
        length,
        section: Section::from_mean_radius(40e-6, eccentricity)?,
        material: Material::isotropic(3.9e9, 0.3, 1300.0)?,
        torsion: TorsionConstant::Polar,
        natural,
        root: Root::from_tangent(DVec3::ZERO, DVec3::new(1.0, 0.0, 0.4), DVec3::Y)?,
        load: Load::down(9.81),
    })
}

pub(super) fn rest(spec: &RodSpec) -> Result<Equilibrium, Stopped> {
    let rod = Rod::new(spec.clone())?;
    Ok(equilibrium(&rod, &[], &to_accuracy(&rod, 1e-4)))
}

/// The same curl at the same position, about the other axis of its section.
pub(super) fn stiff(spec: RodSpec) -> Result<RodSpec, Stopped> {
    let u = spec.natural.at(0.0);
    let frame = spec.root.frame();
    let root = Root::new(DVec3::ZERO, -frame.y_axis, frame.x_axis, frame.z_axis)?;
    let natural = NaturalStrain::Uniform(DVec3::new(0.0, u.x, u.z));
    Ok(RodSpec { natural, root, ..spec })
}
