//! Rods that several experiments use, and measurements of them.

use frisure::rod::{
    ElementKind, Equilibrium, InvalidQuantity, Load, Material, NaturalStrain, Options, Resolution,
    Rod, RodSpec, Root, Section, TorsionConstant,
};
use glam::{DMat3, DVec3};

/// The numbers without units that determine the shape of a rod. The rod is 10 cm of hair; gravity follows from
/// the heaviness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bar {
    /// ρSgL³/EI, EI about d1.
    pub(crate) gamma: f64,
    /// Axis along d1 over that along d2: less than 1 turns the stiff axis into the soft one.
    pub(crate) ratio: f64,
    /// Natural strain times length.
    pub(crate) natural: DVec3,
    /// Direction of the root.
    pub(crate) tangent: DVec3,
    /// Approximate director d1 at the root, made perpendicular to the tangent.
    pub(crate) d1: DVec3,
    /// Shear modulus over Young's.
    pub(crate) shear: f64,
}

/// G/E of an incompressible isotropic material: GJ/EI is 2/3 of a round hair.
pub(crate) const INCOMPRESSIBLE: f64 = 1.0 / 3.0;

/// G/E of the hair types, 0.9 over 3.9 GPa: GJ/EI is 0.462 of a round hair.
pub(crate) const HAIR_SHEAR: f64 = 0.9 / 3.9;

/// Length of a [`Bar`] (m).
pub(crate) const LENGTH: f64 = 0.1;

impl Bar {
    /// Straight, round, horizontal, of an incompressible isotropic material.
    pub(crate) const STRAIGHT: Self = Self {
        gamma: 1.0,
        ratio: 1.0,
        natural: DVec3::ZERO,
        tangent: DVec3::X,
        d1: DVec3::Y,
        shear: INCOMPRESSIBLE,
    };

    pub(crate) fn spec(&self) -> Result<RodSpec, InvalidQuantity> {
        let mean: f64 = 40e-6;
        let root = self.ratio.sqrt();
        let section = Section::from_semi_axes(mean * root, mean / root)?;
        let (e, density) = (3e9, 1300.0);
        let bend = e * section.i1();
        Ok(RodSpec {
            length: LENGTH,
            section,
            material: Material::new(e, e * self.shear, density)?,
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::Uniform(self.natural / LENGTH),
            root: Root::from_tangent(DVec3::ZERO, self.tangent, self.d1)?,
            load: Load::down(self.gamma * bend / (density * section.area() * LENGTH.powi(3))),
        })
    }

    pub(crate) fn rod(&self) -> Result<Rod, InvalidQuantity> {
        Rod::new(self.spec()?)
    }
}

/// The search to an accuracy that is a part of the length, with the certificate.
pub(crate) fn to_accuracy(rod: &Rod, part: f64) -> Options {
    Options { resolution: Resolution::Accuracy(part * rod.length()), ..Options::default() }
}

/// Options for `count` elements, and nothing beyond the equilibrium itself.
pub(crate) fn elements(count: usize, element: ElementKind) -> Options {
    Options {
        resolution: Resolution::Elements(count),
        element,
        estimate_error: false,
        eigenvalue: false,
        ..Options::default()
    }
}

/// Material frame at a part of the arc length.
pub(crate) fn frame(found: &Equilibrium) -> impl Fn(f64) -> DMat3 + '_ {
    let chain = found.chain();
    move |x| found.at(&chain, x).1
}

/// Position over length at a part of the arc length, relative to the root.
pub(crate) fn line(found: &Equilibrium) -> impl Fn(f64) -> DVec3 + '_ {
    let chain = found.chain();
    let (root, length) = (found.rod.root().position(), found.rod.length());
    move |x| (found.at(&chain, x).0 - root) / length
}
