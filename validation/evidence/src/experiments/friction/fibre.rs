//! The fibres of these experiments, and how their rest is sought.

use frisure::rod::{
    ElementKind, Equilibrium, InvalidQuantity, Load, Material, NaturalStrain, Options, Resolution,
    Rod, RodSpec, Root, Section, Stability, TorsionConstant,
};

use crate::Stopped;

/// A round fibre.
pub(super) fn fibre(
    length: f64,
    radius: f64,
    load: Load,
    natural: NaturalStrain,
    root: Root,
) -> Result<Rod, InvalidQuantity> {
    Rod::new(RodSpec {
        length,
        section: Section::circular(radius)?,
        material: Material::new(3.9e9, 1.5e9, 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural,
        root,
        load,
    })
}

pub(super) fn options(elements: usize) -> Options {
    Options {
        resolution: Resolution::Elements(elements),
        element: ElementKind::Helix,
        tolerance: 1e-10,
        estimate_error: false,
        eigenvalue: false,
        ..Options::default()
    }
}

/// An error if a rod is not at a minimum of its energy.
pub(super) fn at_rest(rest: &Equilibrium) -> Result<(), Stopped> {
    match rest.certificate.stability {
        Stability::Stable => Ok(()),
        other => Err(Stopped::Other(format!("a fibre is not at rest: {other:?}"))),
    }
}
