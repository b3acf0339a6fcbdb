//! A rod made to rest in a shape rests in it.

use frisure_rod::inverse::{FittedCurve, solve};
use frisure_rod::{
    Load, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Section, Stability,
    TorsionConstant, equilibrium, equilibrium_from,
};
use glam::DVec3;

fn spec(length: f64, ratio: f64, natural: NaturalStrain, tangent: DVec3) -> RodSpec {
    RodSpec {
        length,
        section: Section::from_diameter(70e-6, ratio).unwrap(),
        material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural,
        root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(0.3, 0.9, 0.1)).unwrap(),
        load: Load::down(9.81),
    }
}

fn options() -> Options {
    Options { resolution: Resolution::Accuracy(2e-5), ..Options::default() }
}

fn hanging(spec: &RodSpec, points: usize) -> Vec<DVec3> {
    let rest = equilibrium(&Rod::new(spec.clone()).unwrap(), &[], &options());
    assert_eq!(rest.certificate.stability, Stability::Stable);
    rest.centre_line(points)
}

/// Hair that hangs in its equilibrium stays there, whatever its curl.
#[test]
fn hair_at_rest_is_held_where_it_is() {
    let cases = [
        (0.25, 1.4, NaturalStrain::STRAIGHT, DVec3::new(1.0, 0.0, 0.6), 64),
        (0.20, 1.5, NaturalStrain::helix(0.02, 0.05).unwrap(), DVec3::new(1.0, 0.2, 0.4), 64),
        (0.15, 1.6, NaturalStrain::helix(0.008, 0.012).unwrap(), DVec3::new(0.3, 0.2, 1.0), 128),
        (0.10, 1.7, NaturalStrain::helix(0.004, 0.006).unwrap(), DVec3::X, 160),
    ];
    for (length, ratio, natural, tangent, points) in cases {
        let spec = spec(length, ratio, natural, tangent);
        let line = hanging(&spec, points);
        let held = solve(&line, &spec, &[], &options()).unwrap();
        assert_eq!(held.stiffness_needed, 1.0);
        assert_eq!(held.equilibrium.certificate.stability, Stability::Stable);
        assert!(held.error < 2e-4, "{length}: {} mm", 1e3 * held.error);
    }
}

/// What was found is the fibre, not only a shape: without its weight it is the helix again.
#[test]
fn the_natural_shape_is_found() {
    let spec =
        spec(0.12, 1.0, NaturalStrain::helix(0.01, 0.02).unwrap(), DVec3::new(1.0, 0.0, 0.3));
    let held = solve(&hanging(&spec, 128), &spec, &[], &options()).unwrap();
    let curvature = |s: f64| {
        let u = held.rod.natural().at(s);
        u.x.hypot(u.y)
    };
    let NaturalStrain::Uniform(u) = spec.natural else { panic!("a helix") };
    for s in [0.03, 0.05, 0.07, 0.09] {
        assert!((curvature(s) / u.x - 1.0).abs() < 0.03, "{s}: {} for {}", curvature(s), u.x);
    }
}

/// Cut to half, held hair springs up as the hair does that it was made like.
#[test]
fn held_hair_that_is_cut_springs_up() {
    let original = spec(0.2, 1.0, NaturalStrain::helix(0.015, 0.03).unwrap(), DVec3::X);
    let held = solve(&hanging(&original, 160), &original, &[], &options()).unwrap();
    let half = |spec: &RodSpec| RodSpec { length: 0.5 * spec.length, ..spec.clone() };
    let wanted = equilibrium(&Rod::new(half(&original)).unwrap(), &[], &options());
    let rod = Rod::new(half(held.rod.spec())).unwrap();
    let got = equilibrium_from(&rod, &[], &options(), &held.equilibrium);
    let apart = got.tip().distance(wanted.tip());
    assert!(apart < 1e-3, "{} mm", 1e3 * apart);
}

/// A shape of no hair, drawn by hand, is held too; what it is does not depend on where it stands.
#[test]
fn a_drawn_shape_is_held() {
    let spec = spec(0.1, 1.5, NaturalStrain::STRAIGHT, DVec3::X);
    let point = |k: i32| {
        let x = f64::from(k) / 40.0;
        DVec3::new(0.08 * x, 0.02 * (3.0 * x).sin(), 0.04 * x - 0.06 * x * x)
    };
    let line: Vec<DVec3> = (0..=40).map(point).collect();
    let held = solve(&line, &spec, &[], &options()).unwrap();
    assert_eq!(held.stiffness_needed, 1.0);
    assert!(held.error < 1e-4, "{} mm", 1e3 * held.error);
}

/// Long hair cannot stand upright: the solution reports the stiffness that it would need (Greenhill 1881).
#[test]
fn what_cannot_stand_is_told() {
    let spec = spec(0.1, 1.0, NaturalStrain::STRAIGHT, DVec3::Z);
    let line: Vec<DVec3> = (0..=20).map(|k| DVec3::Z * (0.01 * f64::from(k))).collect();
    let held = solve(&line, &spec, &[], &options()).unwrap();
    // ρ g A L³ = 7.837 E I at the threshold.
    let rod = &held.rod;
    let needed = rod.weight() * 0.2_f64.powi(3) / (7.837 * rod.stiffness().x);
    assert!(held.error > 0.1);
    assert!((held.stiffness_needed / needed - 1.0).abs() < 0.02, "{}", held.stiffness_needed);
}

#[test]
fn lines_that_are_none_are_refused() {
    let spec = spec(0.1, 1.0, NaturalStrain::STRAIGHT, DVec3::Z);
    for line in [vec![], vec![DVec3::X], vec![DVec3::X; 5], vec![DVec3::X, DVec3::NAN]] {
        assert!(solve(&line, &spec, &[], &options()).is_err());
    }
}

/// A straight rod on a table: the table bears all of its weight but what the clamp does, and it needs no curl.
#[test]
fn a_table_bears_what_lies_on_it() {
    let spec = spec(0.1, 1.0, NaturalStrain::STRAIGHT, DVec3::X);
    let line: Vec<DVec3> = (0..=40).map(|k| DVec3::X * (0.005 * f64::from(k))).collect();
    let fitted = FittedCurve::new(&line, &spec).unwrap();
    let weight = fitted.rod().weight() * fitted.rod().length();
    let on_table = vec![Some(DVec3::Z); fitted.nodes().len()];
    let free = |_: f64| DVec3::ZERO;
    let borne: f64 = fitted.least_support(&on_table, free).iter().sum();
    assert!((borne / weight - 1.0).abs() < 0.03, "{}", borne / weight);
    assert!(
        fitted.least_support(&vec![None; fitted.nodes().len()], free).iter().all(|f| *f == 0.0)
    );
    // A support from above bears nothing.
    let ceiling = vec![Some(DVec3::NEG_Z); fitted.nodes().len()];
    assert!(fitted.least_support(&ceiling, free).iter().all(|f| *f == 0.0));
}
