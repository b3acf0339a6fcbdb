//! The nineteen reference equilibria, and second-order convergence towards them.

mod common;

use std::path::Path;

use common::{Case, accuracy, curl, elements, reference_cases, straight};
use frisure_rod::{
    AccuracyStatus, ElementKind, Equilibrium, Load, NaturalStrain, Options, Rod, RodSpec, Root,
    Section, Stability, StrainProfile, equilibrium,
};
use glam::DVec3;

/// Distance of the tip from the reference, over the length.
fn tip_error(case: &Case, found: &Equilibrium) -> f64 {
    found.tip().distance(case.tip) / case.rod.length()
}

#[test]
fn a_requested_accuracy_is_kept() {
    for case in reference_cases() {
        for request in [1e-3, 1e-4, 1e-5] {
            let found = equilibrium(&case.rod, &[], &accuracy(&case.rod, request));
            let error = tip_error(&case, &found);
            let estimate = found.error_estimate.unwrap() / case.rod.length();
            let name = &case.name;
            assert_eq!(found.certificate.stability, Stability::Stable, "{name}");
            assert!(found.certificate.gradient_norm < 1e-10, "{name}");
            assert!(error < request, "{name} at {request}: {error}");
            assert!(estimate <= request, "{name} at {request}: {estimate}");
            // The estimate is cautious, but for rounding.
            assert!(error < estimate + 1e-9, "{name} at {request}: {error} > {estimate}");
            assert!(found.certificate.iterations < 100, "{name}");
        }
    }
}

#[test]
fn the_estimate_for_given_elements_is_near_the_error() {
    for case in reference_cases() {
        for n in [30, 60] {
            let options = Options { estimate_error: true, ..elements(n, ElementKind::Auto) };
            let found = equilibrium(&case.rod, &[], &options);
            let error = tip_error(&case, &found);
            let estimate = found.error_estimate.unwrap() / case.rod.length();
            // The estimate is of the whole centre line, of which the tip is a point.
            let name = &case.name;
            assert!(estimate > 0.7 * error - 1e-9, "{name} N={n}: {error} {estimate}");
            assert!(estimate < 6.0 * error + 1e-9, "{name} N={n}: {error} {estimate}");
        }
    }
}

#[test]
fn energies_are_those_of_the_references() {
    for case in reference_cases() {
        let found = equilibrium(&case.rod, &[], &accuracy(&case.rod, 1e-5));
        let scale = case.elastic.abs() + case.gravity.abs();
        let gaps = [
            (found.energy.elastic - case.elastic, 5e-6),
            (found.energy.gravity - case.gravity, 5e-6),
            (found.energy.total() - case.elastic - case.gravity, 2e-6),
        ];
        for (gap, allowed) in gaps {
            assert!(gap.abs() < allowed * scale, "{} {}", case.name, gap / scale);
        }
    }
}

#[test]
fn helix_elements_are_those_of_the_references() {
    // The same discretisation in another program has the same errors, to its six digits, and the
    // same second variation.
    for case in reference_cases() {
        let name = &case.name;
        let scale = case.elastic.abs() + case.gravity.abs();
        for &(n, tip, energy) in &case.helix_errors {
            let options = Options { tolerance: 1e-13, ..elements(n, ElementKind::Helix) };
            let found = equilibrium(&case.rod, &[], &options);
            let error = tip_error(&case, &found);
            assert!((error - tip).abs() < 1e-5 * tip + 1e-10, "{name} N={n}: {error} {tip}");
            let above = found.energy.total() - case.elastic - case.gravity;
            let gap = (above - energy).abs();
            assert!(gap < 1e-5 * energy.abs() + 1e-10 * scale, "{name} N={n}: {gap}");
        }
        let found = equilibrium(&case.rod, &[], &elements(240, ElementKind::Helix));
        let eigenvalue = found.certificate.min_eigenvalue.unwrap();
        assert!((eigenvalue - case.min_eigenvalue).abs() < 1e-9, "{name}: {eigenvalue}");
    }
}

#[test]
fn both_elements_converge_at_second_order() {
    for case in reference_cases() {
        for kind in [ElementKind::Helix, ElementKind::Jointed] {
            let errors = [60, 120, 240]
                .map(|n| tip_error(&case, &equilibrium(&case.rod, &[], &elements(n, kind))));
            for pair in errors.windows(2) {
                let resolved = pair[1] > 1e-9;
                let ratio = pair[0] / pair[1];
                assert!(!resolved || ratio > 3.9, "{} {kind:?}: {errors:?}", case.name);
            }
        }
    }
}

#[test]
fn the_right_element_is_chosen() {
    // Auto is never worse than twice the better of the two, and mostly it is the better.
    let mut best = 0;
    for case in reference_cases() {
        let error = |kind| tip_error(&case, &equilibrium(&case.rod, &[], &elements(60, kind)));
        let (helix, jointed) = (error(ElementKind::Helix), error(ElementKind::Jointed));
        let auto = error(ElementKind::Auto);
        assert!(auto < 2.0 * helix.min(jointed) + 1e-9, "{} {helix} {jointed}", case.name);
        best += usize::from(auto <= helix.min(jointed));
    }
    assert!(best >= 17, "{best} of 19");
}

#[test]
#[expect(clippy::print_stderr, reason = "a check that did not run says so")]
fn whole_centre_lines_where_the_data_folder_is_present() {
    // Optional data beside the repository; the tips above are the check that always runs.
    let file = "../shared/data/rod_reference_cases.json";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    let Ok(text) = std::fs::read_to_string(path) else {
        eprintln!("skipped: {file} is not present");
        return;
    };
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    for (case, full) in reference_cases().iter().zip(data["cases"].as_array().unwrap()) {
        assert_eq!(full["name"].as_str(), Some(case.name.as_str()));
        let line = full["result"]["centerline"].as_array().unwrap();
        let found = equilibrium(&case.rod, &[], &accuracy(&case.rod, 1e-5));
        for (point, exact) in found.centre_line(line.len()).iter().zip(line) {
            let exact = DVec3::from_array([0, 1, 2].map(|i| exact[i].as_f64().unwrap()));
            let error = point.distance(exact) / case.rod.length();
            assert!(error < 1e-5, "{}: {error}", case.name);
        }
    }
}

#[test]
fn every_point_of_the_line_is_within_the_accuracy_and_the_estimate() {
    // Against the same search, a hundred times finer; at points between the nodes too.
    for case in reference_cases() {
        let l = case.rod.length();
        let exact = equilibrium(&case.rod, &[], &accuracy(&case.rod, 1e-9)).sample(498);
        for request in [1e-3, 1e-4, 1e-5, 1e-6] {
            let found = equilibrium(&case.rod, &[], &accuracy(&case.rod, request));
            let line = found.sample(498);
            let error =
                line.iter().zip(&exact).map(|(a, b)| a.0.distance(b.0) / l).fold(0.0, f64::max);
            let estimate = found.error_estimate.unwrap() / l;
            let name = &case.name;
            assert!(error < request, "{name} at {request}: {error}");
            // But for rounding, and for the error of the finer one.
            assert!(error < estimate + 2e-9, "{name} at {request}: {error} {estimate}");
        }
    }
}

/// Angle below the horizontal of a straight rod that is clamped horizontally and its position over the length, at `n`
/// equal steps: `φ'' = −Γ (1 − s) cos φ` with φ(0) = 0 and φ'(1) = 0, by shooting with Runge and Kutta's method.
fn heavy_elastica(gamma: f64, n: usize) -> Vec<DVec3> {
    let h = 1.0 / n as f64;
    // φ, φ', x and −z.
    let slope = |s: f64, y: [f64; 4]| {
        let (sin, cos) = y[0].sin_cos();
        [y[1], -gamma * (1.0 - s) * cos, cos, sin]
    };
    let plus = |y: [f64; 4], k: [f64; 4], h: f64| [0, 1, 2, 3].map(|i| y[i] + h * k[i]);
    let shoot = |curvature: f64| {
        let mut line = vec![[0.0, curvature, 0.0, 0.0]];
        for i in 0..n {
            let (s, y) = (i as f64 * h, line[i]);
            let a = slope(s, y);
            let b = slope(s + 0.5 * h, plus(y, a, 0.5 * h));
            let c = slope(s + 0.5 * h, plus(y, b, 0.5 * h));
            let d = slope(s + h, plus(y, c, h));
            let k = [0, 1, 2, 3].map(|j| (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]) / 6.0);
            line.push(plus(y, k, h));
        }
        line
    };
    // The more the root bends the more the tip does, up to a quarter turn at the root's layer.
    let (mut low, mut high) = (0.0, 2.0 * gamma.sqrt().max(gamma.min(1.0)));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if shoot(middle)[n][1] > 0.0 { high = middle } else { low = middle }
    }
    shoot(0.5 * (low + high)).iter().map(|y| DVec3::new(y[2], 0.0, -y[3])).collect()
}

#[test]
fn the_line_between_nodes_is_that_of_the_elastica() {
    for gamma in [1.0, 10.0, 40.0] {
        let rod = straight(gamma, DVec3::X);
        let exact = heavy_elastica(gamma, 2000);
        for kind in [ElementKind::Helix, ElementKind::Jointed] {
            for request in [1e-4, 1e-5, 1e-6] {
                let options = Options { element: kind, ..accuracy(&rod, request) };
                let found = equilibrium(&rod, &[], &options);
                let line = found.centre_line(exact.len());
                let gap = line.iter().zip(&exact).map(|(a, b)| (*a / rod.length()).distance(*b));
                let (error, estimate) =
                    (gap.fold(0.0, f64::max), found.error_estimate.unwrap() / rod.length());
                assert!(error < request, "{kind:?} {gamma} {request}: {error}");
                assert!(error < estimate + 1e-9, "{kind:?} {gamma}: {error} {estimate}");
            }
        }
    }
}

/// A weightless planar rod whose natural curvature jumps at the part `s` of its length, and its exact line: two arcs of
/// circles.
fn with_a_jump(s: f64) -> (Rod, impl Fn(f64) -> DVec3) {
    let (length, before, after) = (0.1, 60.0, 15.0);
    let knots =
        vec![(s * length, DVec3::X * before), (s * length * (1.0 + 1e-9), DVec3::X * after)];
    let natural = NaturalStrain::Varying(StrainProfile::new(knots).unwrap());
    let root = Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap();
    let rod = Rod::new(RodSpec { length, natural, load: Load::NONE, root, ..curl() }).unwrap();
    // κ1 turns about d1 = +y, from +x downwards.
    let arc = |curvature: f64, angle: f64, s: f64| {
        let to = angle + curvature * s;
        (DVec3::new(to.sin() - angle.sin(), 0.0, to.cos() - angle.cos()) / curvature, to)
    };
    let line = move |x: f64| {
        let (corner, angle) = arc(before, 0.0, s.min(x) * length);
        corner + arc(after, angle, (x - s).max(0.0) * length).0
    };
    (rod, line)
}

#[test]
fn a_jump_of_the_natural_strain_is_within_the_accuracy_and_mostly_the_estimate() {
    let (mut above, mut all) = (0, 0);
    for i in 0..40 {
        let (rod, exact) = with_a_jump(0.1 + 0.02 * f64::from(i) + 1e-3);
        for element in [ElementKind::Helix, ElementKind::Jointed] {
            for request in [1e-3, 1e-4, 1e-5] {
                let options = Options { element, ..accuracy(&rod, request) };
                let found = equilibrium(&rod, &[], &options);
                let line = found.centre_line(1001);
                let gap = |(i, p): (usize, &DVec3)| p.distance(exact(i as f64 / 1000.0));
                let error = line.iter().enumerate().map(gap).fold(0.0, f64::max);
                assert!(error < request * rod.length(), "{element:?} {i} {request}: {error}");
                above += usize::from(error > found.error_estimate.unwrap());
                all += 1;
            }
        }
    }
    assert!(above * 20 <= all, "{above} of {all}");
}

/// A planar crimp of 512 waves in 10 cm without weight: its line is a quadrature. Elements that hold whole waves see a straight hair.
#[test]
fn waves_shorter_than_elements_are_resolved_or_told() {
    let (length, waves, most) = (0.1, 512, 1148.0);
    let half = length / (2 * waves) as f64;
    let strain = |k: usize| if k.is_multiple_of(2) { most } else { -most };
    let knots = (0..=2 * waves).map(|k| (half * k as f64, DVec3::X * strain(k))).collect();
    let natural = NaturalStrain::Varying(StrainProfile::new(knots).unwrap());
    let rod = Rod::new(RodSpec { length, natural, load: Load::NONE, ..curl() }).unwrap();
    // The angle is a parabola within each half wave, from 0 over ±most half/4 to 0; Simpson's rule.
    let steps = 1000;
    let angle = |t: f64| most * half * t * (1.0 - t);
    let projected: f64 = (0..=steps)
        .map(|i| {
            let weight = if i == 0 || i == steps { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            weight * angle(f64::from(i) / f64::from(steps)).cos() / (3.0 * f64::from(steps))
        })
        .sum();
    // Half waves turn to both sides in turn, so that what is across cancels in pairs.
    let exact = length * projected;
    for fraction in [1e-2, 1e-4, 1e-5, 1e-6] {
        let rest = equilibrium(&rod, &[], &accuracy(&rod, fraction));
        let error = (rest.tip().length() - exact).abs();
        let estimate = rest.error_estimate.unwrap();
        assert_eq!(rest.certificate.accuracy, AccuracyStatus::Met, "{fraction}");
        assert!(
            error <= estimate && estimate <= fraction * length,
            "{fraction}: {error} {estimate}"
        );
    }
}

/// A twist to and fro in short waves turns the section of a fibre that is not round by its mean, as a turned root does.
#[test]
fn waves_of_twist_are_a_turn_of_the_section() {
    let (length, waves, most, phase) = (0.1, 768, 120.0, 0.4_f64);
    let knots = (0..=8 * waves).map(|k| {
        let s = length * f64::from(k) / f64::from(8 * waves);
        (s, DVec3::Z * (most * (std::f64::consts::TAU * f64::from(k) / 8.0 + phase).sin()))
    });
    let natural = NaturalStrain::Varying(StrainProfile::new(knots.collect()).unwrap());
    // Linear between knots: over a wave the mean of the turn is that of a sine, times (sin(x/2)/(x/2))² at x = 2π/8.
    let half = std::f64::consts::PI / 8.0;
    let turn = most * length / (std::f64::consts::TAU * f64::from(waves))
        * phase.cos()
        * (half.sin() / half).powi(2);
    let fibre = |natural, turn: f64| {
        let (d1, d2) = (DVec3::new(0.0, 0.8, 0.6), DVec3::new(0.0, -0.6, 0.8));
        let d1 = d1 * turn.cos() + d2 * turn.sin();
        let root = Root::from_tangent(DVec3::ZERO, DVec3::X, d1).unwrap();
        let section = Section::from_diameter(80e-6, 1.5).unwrap();
        Rod::new(RodSpec { length, section, natural, root, ..curl() }).unwrap()
    };
    let turned = fibre(NaturalStrain::STRAIGHT, turn);
    let exact = equilibrium(&turned, &[], &accuracy(&turned, 1e-8)).tip();
    let still = equilibrium(&fibre(NaturalStrain::STRAIGHT, 0.0), &[], &accuracy(&turned, 1e-8));
    // The mean turn displaces the tip far more than what a wave does besides.
    assert!(still.tip().distance(exact) > 5e-4 * length);
    let waved = fibre(natural, 0.0);
    for fraction in [1e-4, 1e-5] {
        let rest = equilibrium(&waved, &[], &accuracy(&waved, fraction));
        assert_eq!(rest.certificate.accuracy, AccuracyStatus::Met, "{fraction}");
        let error = rest.tip().distance(exact);
        assert!(error <= fraction * length, "{fraction}: {error}");
    }
}

#[test]
fn elements_too_few_for_the_curl_say_nothing_of_it() {
    // 12 turns.
    let rod = Rod::new(RodSpec { length: 0.4, ..curl() }).unwrap();
    for (n, told) in [(1, false), (3, false), (15, false), (120, true)] {
        let options = Options { estimate_error: true, ..elements(n, ElementKind::Auto) };
        let rest = equilibrium(&rod, &[], &options);
        let stable = rest.certificate.stability == Stability::Stable;
        assert_eq!((stable, rest.error_estimate.is_some()), (told, told), "{n}");
    }
}

#[test]
fn an_accuracy_is_met_if_the_most_elements_do() {
    // A strain that jumps, of which doublings of the first division end at 5 760 elements, and twice as many are too many.
    let jumps = [
        (0.0, [30.217_669_755, 0.0, -7.471_507_089]),
        (0.092_994_175, [30.217_669_755, 0.0, -7.471_507_089]),
        (0.092_994_484, [3.123_499_129, 0.0, -0.411_167_578]),
        (0.094_795_786, [3.123_499_129, 0.0, -0.411_167_578]),
        (0.094_796_094, [16.239_994_558, 0.0, 6.475_663_594]),
        (0.125_764_449, [16.239_994_558, 0.0, 6.475_663_594]),
        (0.125_764_757, [82.791_446_634, -120.330_775_323, -33.758_400_132]),
        (0.155_955_431, [82.791_446_634, -120.330_775_323, -33.758_400_132]),
        (0.155_955_739, [1.827_768_454, -9.221_014_193, 2.525_283_197]),
        (0.308_019_133, [5.023_431_415, -14.487_033_936, -2.231_040_076]),
    ];
    let knots = jumps.map(|(s, strain)| (s, DVec3::from_array(strain))).to_vec();
    let tangent = DVec3::new(0.396_775_598, 0.732_322_451, 0.553_419_328);
    let across = DVec3::new(-0.885_344_654, 0.464_501_026, 0.020_090_778);
    let rod = Rod::new(RodSpec {
        length: 0.308_019_133,
        section: Section::from_semi_axes(4.487_583e-5, 3.499_072e-5).unwrap(),
        material: frisure_rod::Material::new(1.028_993_682e9, 3.960_663_873e8, 1300.0).unwrap(),
        torsion: frisure_rod::TorsionConstant::SaintVenant,
        natural: NaturalStrain::Varying(StrainProfile::new(knots).unwrap()),
        root: Root::from_tangent(DVec3::ZERO, tangent, across).unwrap(),
        load: Load::down(9.81),
    })
    .unwrap();
    let request = 1e-6;
    let found = equilibrium(&rod, &[], &accuracy(&rod, request));
    assert_eq!(found.certificate.accuracy, AccuracyStatus::Met, "{:?}", found.error_estimate);
    assert!(found.elements <= 10_000);
    let exact = equilibrium(&rod, &[], &elements(10_000, ElementKind::Auto));
    let gap = found.tip().distance(exact.tip()) / rod.length();
    assert!(gap < request, "{gap}");
}
