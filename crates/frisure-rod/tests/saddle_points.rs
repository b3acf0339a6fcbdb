//! Starts that a mirror maps to themselves end, without care, at a saddle: straight hair exactly
//! upright, planar curls in the plane of their root. A minimum must come out.

mod common;

use std::f64::consts::PI;

use common::{curl, elements, straight};
use frisure_rod::{
    Branch, ElementKind, NaturalStrain, Options, Rod, RodSpec, Root, Section, SplitMix64,
    Stability, equilibrium,
};
use glam::DVec3;

/// The default search for one rod, and the energy that it must not exceed: the lowest from a root
/// turned by a hundredth of a degree out of the symmetry.
fn check(name: &str, rod: &Rod, options: &Options) {
    let found = equilibrium(rod, &[], options);
    let (energy, certificate) = (found.energy.total(), found.certificate);
    let scale = rod.weight() * rod.length().powi(2);
    assert_eq!(certificate.stability, Stability::Stable, "{name}: {certificate:?}");
    assert!(certificate.gradient_norm < 1e-9, "{name}: {certificate:?}");
    assert!(certificate.min_eigenvalue.unwrap() > -1e-7, "{name}: {certificate:?}");
    // A branch that turns fast is followed in small steps, some dozens of a few iterations each, with two divisions.
    assert!(certificate.iterations < 600, "{name}: {} iterations", certificate.iterations);
    let root = rod.spec().root;
    let turn = glam::DMat3::from_rotation_y(2e-4) * glam::DMat3::from_rotation_x(1e-4);
    let frame = turn * root.frame();
    let turned = Root::new(root.position(), frame.x_axis, frame.y_axis, frame.z_axis).unwrap();
    let perturbed = Rod::new(RodSpec { root: turned, ..rod.spec().clone() }).unwrap();
    let other = equilibrium(&perturbed, &[], options).energy.total();
    assert!(energy < other + 1e-3 * scale, "{name}: above a turned root's by {}", energy - other);
}

#[test]
fn straight_and_exactly_upright() {
    for kind in [ElementKind::Helix, ElementKind::Jointed] {
        for gamma in [8.0, 8.5, 10.0, 15.0, 20.0, 40.0, 70.0, 100.0, 200.0, 500.0, 1000.0, 2000.0] {
            for n in [3, 15, 60] {
                let rod = straight(gamma, DVec3::Z);
                check(&format!("{kind:?} {gamma} N={n}"), &rod, &elements(n, kind));
            }
        }
    }
}

/// A planar curl: no twist, its root in the plane x–z, `angle` from the horizontal.
fn planar(length: f64, curvature: f64, angle: f64, ratio: f64) -> Rod {
    let tangent = DVec3::new(angle.cos(), 0.0, angle.sin());
    Rod::new(RodSpec {
        length,
        section: Section::from_diameter(70e-6, ratio).unwrap(),
        natural: NaturalStrain::Uniform(DVec3::X * curvature),
        root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::Y).unwrap(),
        ..curl()
    })
    .unwrap()
}

#[test]
fn planar_curls_in_the_plane_of_their_root() {
    for angle in [0.0, 0.5 * PI, -0.5 * PI, 0.3, 1.2, -0.7, PI] {
        for curvature in [40.0, -40.0, 120.0, -120.0, 300.0] {
            for length in [0.05, 0.15, 0.25] {
                for ratio in [1.0, 1.5] {
                    let rod = planar(length, curvature, angle, ratio);
                    let name = format!("angle {angle} curvature {curvature} {length} m, {ratio}");
                    check(&name, &rod, &elements(30, ElementKind::Auto));
                }
            }
        }
    }
}

#[test]
fn the_lowest_branch_is_no_higher() {
    let mut random = SplitMix64(5);
    for _ in 0..12 {
        let (angle, curvature) = (random.between(-PI, PI), random.between(-200.0, 200.0));
        let rod = planar(0.15, curvature, angle, 1.2);
        let options = elements(20, ElementKind::Auto);
        let own = equilibrium(&rod, &[], &options);
        let branch = Branch::Lowest { starts: 8, seed: 3 };
        let lowest = equilibrium(&rod, &[], &Options { branch, ..options });
        assert_eq!(lowest.certificate.stability, Stability::Stable);
        assert!(lowest.energy.total() <= own.energy.total() + 1e-9 * own.energy.total().abs());
    }
}
