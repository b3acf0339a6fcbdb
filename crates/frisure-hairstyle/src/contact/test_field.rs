//! What the tests of contact share.

use frisure_rod::potential::Field;
use frisure_rod::{Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant};
use glam::DVec3;

use super::Thickness;

/// A wisp a few millimetres thick.
pub(super) fn wisp() -> Thickness {
    let rod = Rod::new(RodSpec {
        length: 0.2,
        section: Section::from_diameter(70e-6, 1.0).unwrap(),
        material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.01, 0.02).unwrap(),
        root: Root::from_tangent(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap(),
        load: Load::down(9.81),
    });
    let rod = rod.unwrap();
    Thickness::new(&rod, rod.natural().at(0.0), 300.0, 1.0, 0.05, 1.0)
}

/// The field is felt at `p`, and its derivatives are those of its energy.
pub(super) fn agrees_with_differences(field: &impl Field, s: f64, p: DVec3) {
    let (gradient, hessian) = field.derivatives(s, p).expect("the field is felt");
    let h = 1e-7;
    for axis in 0..3 {
        let mut step = DVec3::ZERO;
        step[axis] = h;
        let slope = (field.energy(s, p + step) - field.energy(s, p - step)) / (2.0 * h);
        assert!((slope - gradient[axis]).abs() < 1e-5 * gradient.length(), "{p}");
        let at = |p| field.derivatives(s, p).unwrap().0;
        let column = (at(p + step) - at(p - step)) / (2.0 * h);
        let error = (column - hessian.col(axis)).length();
        assert!(error < 1e-4 * hessian.col(axis).length().max(1.0), "{p}: {error}");
    }
}
