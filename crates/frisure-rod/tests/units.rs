//! The same rod in three systems of units: every length and energy scales as it must, so no
//! formula mixes dimensions.

mod common;

use common::{Spring, elements, hair};
use frisure_rod::minimise::Problem;
use frisure_rod::potential::Potential;
use frisure_rod::{
    Chain, ElementKind, Load, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root,
    Section, SplitMix64, equilibrium,
};
use glam::DVec3;

/// How many of a system's units of length and mass make up a metre and a kilogram; seconds stay.
#[derive(Clone, Copy, Debug)]
struct Units {
    length: f64,
    mass: f64,
}

const CENTIMETRE_GRAM: Units = Units { length: 1e2, mass: 1e3 };
const MILLIMETRE_GRAM: Units = Units { length: 1e3, mass: 1e3 };

impl Units {
    fn energy(self) -> f64 {
        self.mass * self.length.powi(2)
    }

    fn spec(self, si: &RodSpec) -> RodSpec {
        let (l, m) = (self.length, self.mass);
        let pressure = m / l;
        let NaturalStrain::Uniform(u) = si.natural else { unreachable!() };
        let frame = si.root.frame();
        RodSpec {
            length: si.length * l,
            section: Section::from_semi_axes(si.section.a() * l, si.section.b() * l).unwrap(),
            material: Material::new(
                si.material.youngs_modulus() * pressure,
                si.material.shear_modulus() * pressure,
                si.material.density() * m / l.powi(3),
            )
            .unwrap(),
            torsion: si.torsion,
            natural: NaturalStrain::Uniform(u / l),
            root: Root::new(si.root.position() * l, frame.x_axis, frame.y_axis, frame.z_axis)
                .unwrap(),
            load: Load { gravity: si.load.gravity * l, force: si.load.force * m },
        }
    }
}

fn near(a: f64, b: f64, allowed: f64) -> bool {
    (a - b).abs() <= allowed
}

#[test]
fn numbers_without_dimension_do_not_change() {
    let mut random = SplitMix64(21);
    for _ in 0..20 {
        let spec = hair(&mut random);
        let si = Rod::new(spec.clone()).unwrap();
        for units in [CENTIMETRE_GRAM, MILLIMETRE_GRAM] {
            let rod = Rod::new(units.spec(&spec)).unwrap();
            assert!(near(rod.heaviness() / si.heaviness(), 1.0, 1e-12));
            let moment = rod.moment_scale() / si.moment_scale() / units.energy();
            assert!(near(moment, 1.0, 1e-12));
            assert_eq!(ElementKind::Auto.chosen_for(&rod), ElementKind::Auto.chosen_for(&si));
        }
    }
}

#[test]
fn equilibria_scale() {
    let mut random = SplitMix64(22);
    for i in 0..12 {
        let spec = hair(&mut random);
        let si = Rod::new(spec.clone()).unwrap();
        let spring = Spring { stiffness: 1e-3, anchor: DVec3::new(0.02, -0.03, 0.01) };
        for units in [CENTIMETRE_GRAM, MILLIMETRE_GRAM] {
            let rod = Rod::new(units.spec(&spec)).unwrap();
            // A stiffness per length is a mass over a length and a squared time.
            let scaled = Spring {
                stiffness: spring.stiffness * units.mass / units.length,
                anchor: spring.anchor * units.length,
            };
            for (a, b) in [
                (&[][..], &[][..]),
                (&[&spring as &dyn Potential][..], &[&scaled as &dyn Potential][..]),
            ] {
                let options = elements(15, ElementKind::Auto);
                let (one, other) = (equilibrium(&si, a, &options), equilibrium(&rod, b, &options));
                let gap = (other.tip() / units.length).distance(one.tip()) / si.length();
                assert!(gap < 1e-7, "rod {i} {units:?}: {gap}");
                let allowed = 1e-8 * si.moment_scale();
                let e = units.energy();
                assert!(near(other.energy.elastic / e, one.energy.elastic, allowed));
                assert!(near(other.energy.gravity / e, one.energy.gravity, allowed));
                assert!(near(other.energy.external / e, one.energy.external, allowed));
                let eigenvalues = [&one, &other].map(|e| e.certificate.min_eigenvalue.unwrap());
                assert!(near(eigenvalues[0], eigenvalues[1], 1e-6), "rod {i}: {eigenvalues:?}");
                assert_eq!(one.certificate.stability, other.certificate.stability);
            }
        }
    }
}

#[test]
fn accuracy_is_a_length() {
    let spec = hair(&mut SplitMix64(23));
    let si = Rod::new(spec.clone()).unwrap();
    let rod = Rod::new(MILLIMETRE_GRAM.spec(&spec)).unwrap();
    let at =
        |accuracy| Options { resolution: Resolution::Accuracy(accuracy), ..Options::default() };
    let (one, other) = (equilibrium(&si, &[], &at(1e-5)), equilibrium(&rod, &[], &at(1e-5 * 1e3)));
    assert_eq!(one.elements, other.elements);
    let estimates = [one.error_estimate.unwrap(), other.error_estimate.unwrap() / 1e3];
    assert!(near(estimates[0], estimates[1], 1e-8), "{estimates:?}");
}

#[test]
fn energies_of_any_shape_scale() {
    // Away from equilibrium too, where nothing cancels.
    let mut random = SplitMix64(24);
    for _ in 0..10 {
        let spec = hair(&mut random);
        let si = Rod::new(spec.clone()).unwrap();
        let controls: Vec<DVec3> = (0..9).map(|_| random.cube() * 0.5).collect();
        for kind in [ElementKind::Helix, ElementKind::Jointed] {
            let chain = Chain::uniform(&si, kind, 9);
            let one = Problem::new(&chain, &[]);
            let shape = chain.shape(controls.clone());
            for units in [CENTIMETRE_GRAM, MILLIMETRE_GRAM] {
                let rod = Rod::new(units.spec(&spec)).unwrap();
                let scaled = Chain::uniform(&rod, kind, 9);
                let other = Problem::new(&scaled, &[]);
                let larger = scaled.shape(controls.clone());
                let (a, b) = (one.energy(&shape), other.energy(&larger));
                let allowed = 1e-12 * (a.elastic.abs() + a.gravity.abs());
                assert!(near(b.elastic / units.energy(), a.elastic, allowed));
                assert!(near(b.gravity / units.energy(), a.gravity, allowed));
                let (g, h) = (one.gradient(&shape), other.gradient(&larger));
                for (g, h) in g.iter().zip(&h) {
                    let gap = (*h / units.energy()).distance(*g);
                    assert!(gap < 1e-12 * si.moment_scale(), "{kind:?}: {gap}");
                }
            }
        }
    }
}
