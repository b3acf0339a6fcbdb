//! The reference compared with closed forms and with numbers of other programs.

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec2, DVec3};
use serde_json::Value;

use super::{Hanging, Natural, greenhill, prandtl_michell};

/// A straight rod with a section of a given axis ratio, its stiff axis along d2.
fn straight(weight: f64, ratio: f64, tangent: DVec3, d1: DVec3) -> Hanging {
    let twist = 2.0 * 0.35 * ratio * ratio / (1.0 + ratio * ratio) * 2.0;
    Hanging {
        weight,
        stiffness: DVec3::new(1.0, ratio * ratio, twist),
        natural: Natural::uniform(DVec3::ZERO),
        root: DMat3::from_cols(d1, tangent.cross(d1), tangent),
        length: 1.0,
    }
}

#[test]
fn without_weight_a_helix_is_one() {
    let (radius, p) = (0.03_f64, 0.01);
    let square = radius * radius + p * p;
    let natural = DVec3::new(radius / square, 0.0, p / square);
    let rod =
        Hanging { natural: Natural::uniform(natural), ..straight(0.0, 1.2, DVec3::X, DVec3::Y) };
    let solution = rod.solve().unwrap();
    // After whole turns the displacement is along the axis.
    let axis = rod.root * natural.normalize();
    let turns = natural.length() / (2.0 * PI);
    let whole =
        Hanging { natural: Natural::uniform(natural / turns * turns.round()), ..rod.clone() };
    let tip = whole.solve().unwrap().tip();
    assert!((tip - axis * tip.dot(axis)).length() < 1e-9, "{tip}");
    assert!(solution.is_stable());
}

#[test]
fn a_light_cantilever_is_the_linear_beam() {
    let tip = straight(1e-3, 1.0, DVec3::X, DVec3::Y).solve().unwrap().tip();
    assert!((tip.z / (-1e-3 / 8.0) - 1.0).abs() < 1e-6, "{tip}");
}

#[test]
fn a_solution_is_found_again_from_its_frames() {
    let natural = DVec3::new(20.0, 0.0, 9.0);
    let rod =
        Hanging { natural: Natural::uniform(natural), ..straight(30.0, 1.3, DVec3::X, DVec3::Y) };
    let solution = rod.solve().unwrap();
    let points = solution.line();
    let last = points.len() - 1;
    // Between two points a frame turns as on a helix.
    let frame = |x: f64| {
        let i = ((x * last as f64) as usize).min(last - 1);
        let [a, b] = [points[i].1, points[i + 1].1];
        let turn = DQuat::from_mat3(&(a.transpose() * b)).to_scaled_axis();
        a * DMat3::from_quat(DQuat::from_scaled_axis(turn * (x * last as f64 - i as f64)))
    };
    let again = rod.solve_near(frame).unwrap();
    assert!(again.tip().distance(solution.tip()) < 1e-10);
    assert_eq!(again.index(), 0);
}

#[test]
fn an_upright_rod_gives_way_at_greenhills_load() {
    // The same in two planes; the zeros of J of order −1/3 are at 1, 7.1 and 18.9 times the load.
    for (factor, index) in [(0.999, 0), (1.001, 2), (5.0, 2), (20.0, 6)] {
        let rod = straight(greenhill() * factor, 1.0, DVec3::Z, DVec3::X);
        let mut solution = straight(0.1, 1.0, DVec3::Z, DVec3::X).solve().unwrap();
        // Upright is a solution at any weight.
        solution.rod = rod;
        assert_eq!(solution.index(), index, "{factor}");
    }
}

#[test]
fn a_thin_strip_gives_way_sideways_at_the_load_of_prandtl_and_michell() {
    // d1, the soft axis, is vertical: the weight bends the rod about d2.
    for (factor, stable) in [(0.99, true), (1.01, false)] {
        let rod = straight(0.0, 1000.0, DVec3::X, DVec3::Z);
        let critical = prandtl_michell() * rod.stiffness.z.sqrt();
        let solution = rod.with_weight(critical * factor).solve_symmetric().unwrap();
        assert_eq!(solution.is_stable(), stable, "{factor}");
        assert!(solution.line().iter().all(|p| p.0.y.abs() < 1e-9));
    }
}

#[test]
fn a_strain_that_jumps_is_two_arcs_without_weight_and_one_rod_with_it() {
    let [k0, k1, at] = [9.0, -14.0, 0.37];
    let jump = [(0.0, DVec3::X * k0), (at, DVec3::X * k0), (at + 1e-12, DVec3::X * k1)];
    let rod = Hanging { natural: Natural::varying(jump), ..straight(0.0, 1.2, DVec3::X, DVec3::Y) };
    // In the plane of t and t × d1 the angle is the integral of the curvature: arcs of circles.
    let (first, second) = (k0 * at, k1 * (1.0 - at));
    let arc = |from: f64, turn: f64, k: f64| {
        DVec2::new((from + turn).sin() - from.sin(), from.cos() - (from + turn).cos()) / k
    };
    let exact = arc(0.0, first, k0) + arc(first, second, k1);
    let tip = rod.solve().unwrap().tip();
    let across = rod.root * DVec3::NEG_Y;
    let found = DVec2::new(tip.dot(rod.root * DVec3::Z), tip.dot(across));
    assert!(found.distance(exact) < 1e-11, "{found} {exact}");
    // A knot within a straight line changes nothing, with weight neither.
    let kinked = Natural::varying([(0.0, DVec3::X), (1.0, DVec3::X * 5.0)]);
    let kink = Natural::varying([0.0, 0.2345, 1.0].map(|s| (s, kinked.at(s))));
    let tips = [kinked, kink]
        .map(|natural| Hanging { natural, ..straight(20.0, 1.2, DVec3::X, DVec3::Y) })
        .map(|rod| rod.solve().unwrap().tip());
    assert!(tips[0].distance(tips[1]) < 1e-11, "{tips:?}");
}

fn vector(v: &Value) -> DVec3 {
    let at = |k: usize| v[k].as_f64().unwrap();
    DVec3::new(at(0), at(1), at(2))
}

#[test]
fn tips_are_those_of_the_reference_cases() {
    let text = include_str!("../../../../crates/frisure-rod/tests/data/reference_cases.json");
    let data: Value = serde_json::from_str(text).unwrap();
    let mut worst = 0.0_f64;
    for case in data["cases"].as_array().unwrap() {
        let f = |v: &Value| v.as_f64().unwrap();
        let (axes, moduli, root) = (&case["semi_axes"], &case["moduli"], &case["root"]);
        let (a, b, e, g) = (f(&axes[0]), f(&axes[1]), f(&moduli[0]), f(&moduli[1]));
        let l = f(&case["length"]);
        let j = match case["torsion"].as_str().unwrap() {
            "polar" => 0.25 * PI * a * b * (a * a + b * b),
            _ => PI * (a * b).powi(3) / (a * a + b * b),
        };
        let bend = 0.25 * PI * a * b.powi(3) * e;
        let rod = Hanging {
            weight: f(&case["density"]) * PI * a * b * f(&case["gravity"]) * l.powi(3) / bend,
            stiffness: DVec3::new(1.0, (a / b).powi(2), g * j / bend),
            natural: Natural::uniform(vector(&case["natural"]) * l),
            root: DMat3::from_cols(vector(&root[0]), vector(&root[1]), vector(&root[2])),
            length: l,
        };
        let name = case["name"].as_str().unwrap();
        let solution = rod.solve().expect(name);
        let error = solution.tip().distance(vector(&case["tip"])) / l;
        worst = worst.max(error);
        assert!(solution.is_stable(), "{name}");
    }
    assert!(worst < 1e-10, "{worst}");
}
