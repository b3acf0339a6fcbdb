//! Hair against hair: what must hold when wisps make way for each other.

use std::sync::OnceLock;

use frisure_hairstyle::head::{Head, ScalpSource};
use frisure_hairstyle::{
    Body, HairContact, Hairstyle, HairstyleSpec, HeadMethod, PredictOptions, Start, predict,
    preset, settling_report,
};
use frisure_strands::Surface;
use glam::{DQuat, DVec3};

fn head() -> &'static Head {
    static HEAD: OnceLock<Head> = OnceLock::new();
    HEAD.get_or_init(Head::mannequin)
}

fn spec(hair: HairContact) -> HairstyleSpec {
    let mut spec = preset("caucasian-curly").unwrap().spec();
    spec.wisps.count = 60;
    spec.contact.hair = hair;
    spec.equilibrium.resolution = frisure_rod::Resolution::Elements(20);
    spec
}

fn style(hair: HairContact) -> Hairstyle {
    predict(&spec(hair), head(), PredictOptions::default(), &()).unwrap()
}

/// Points every 2 mm along a guide, with their arc length.
fn points(style: &Hairstyle, guide: usize) -> Vec<(f64, DVec3)> {
    let rest = &style.equilibria()[guide];
    let count = (rest.rod.length() / 2e-3) as usize + 1;
    let step = rest.rod.length() / (count - 1) as f64;
    rest.centre_line(count).into_iter().enumerate().map(|(k, p)| (k as f64 * step, p)).collect()
}

/// Length of hair (m) whose middle lies in another wisp, nearer to that wisp's middle than `share`
/// of the sum of their radii.
fn overlap(style: &Hairstyle, share: f64) -> f64 {
    let count = style.guides().len();
    let lines: Vec<_> = (0..count).map(|i| points(style, i)).collect();
    let radius = |i: usize, s: f64| style.guides()[i].thickness.at(s);
    let inside = |i: usize, s: f64, p: DVec3| {
        (0..count).filter(|&j| j != i).any(|j| {
            let near =
                |&(t, q): &(f64, DVec3)| p.distance(q) < share * (radius(i, s) + radius(j, t));
            lines[j].iter().any(near)
        })
    };
    let one = |i: usize| lines[i].iter().filter(|&&(s, p)| inside(i, s, p)).count();
    (0..count).map(one).sum::<usize>() as f64 * 2e-3
}

#[test]
fn wisps_that_repel_each_other_do_not_share_a_place() {
    let (none, wisps) = (style(HairContact::None), style(HairContact::Wisps));
    let report = settling_report(&wisps, head());
    assert_eq!(report.stable, 60, "{report:?}");
    assert!(report.gradient_norm <= spec(HairContact::Wisps).equilibrium.tolerance);
    assert!(report.sweeps > 0);
    let (before, after) = (overlap(&none, 0.6), overlap(&wisps, 0.6));
    assert!(after < 0.1 * before, "{after} m of {before} m");
}

#[test]
fn hair_takes_room() {
    // Mean distance of guides from the skin: the volume of the paper's figure 4.
    let stand = |style: &Hairstyle| {
        let distances = (0..60).flat_map(|i| points(style, i)).map(|(_, p)| p);
        let all: Vec<f64> = distances.map(|p| head().signed_distance().value(p)).collect();
        all.iter().sum::<f64>() / all.len() as f64
    };
    let none = stand(&style(HairContact::None));
    for hair in [HairContact::Layers, HairContact::Wisps] {
        let some = stand(&style(hair));
        assert!(some > none + 2e-3, "{hair:?}: {some} {none}");
    }
}

#[test]
fn a_lower_tolerance_finds_a_lower_energy() {
    let energy = |tolerance| {
        let mut spec = spec(HairContact::Wisps);
        spec.equilibrium.tolerance = tolerance;
        let report = settling_report(
            &predict(&spec, head(), PredictOptions::default(), &()).unwrap(),
            head(),
        );
        assert!(report.gradient_norm <= tolerance, "{report:?}");
        report.energy.total()
    };
    // On the same way down: what is left at the tolerance of a picture is a fraction of a percent.
    let (coarse, fine) = (energy(0.03), energy(1e-4));
    assert!(fine <= coarse && fine > coarse * 1.02, "{fine} {coarse}");
}

#[test]
fn a_head_on_its_side_still_has_its_volume() {
    // The flow of hair follows the head, not gravity; wisps know nothing of it.
    let turn = DQuat::from_rotation_y(0.6);
    let skin = head().surface();
    let turned = skin.positions().iter().map(|p| turn * *p).collect();
    let surface = Surface::new(turned, skin.triangles().to_vec()).unwrap();
    let scalp = ScalpSource::Weights(head().scalp().to_vec());
    let tilted = Head::from_surface(surface, scalp).unwrap();
    let mut spec = spec(HairContact::Wisps);
    spec.wisps.count = 40;
    // A long first element would reach into the skin of this head, stiff as its natural curl.
    spec.equilibrium.resolution = frisure_rod::Resolution::Elements(60);
    let style = predict(&spec, &tilted, PredictOptions::default(), &()).unwrap();
    let report = settling_report(&style, &tilted);
    assert_eq!(report.stable, 40, "{report:?}");
    assert!(report.penetration < 5e-4, "{report:?}");
    assert!(overlap(&style, 0.5) < 0.2, "{}", overlap(&style, 0.5));
}

#[test]
fn wisps_keep_apart_without_a_body_and_on_spheres() {
    for body in [Body::None, Body::Spheres] {
        let mut spec = spec(HairContact::Wisps);
        spec.wisps.count = 30;
        spec.contact.body = body;
        let report = settling_report(
            &predict(&spec, head(), PredictOptions::default(), &()).unwrap(),
            head(),
        );
        // A crease between spheres can hold a guide that does not come to rest.
        assert!(report.stable >= 29, "{body:?}: {report:?}");
    }
}

/// A head that comes to rest by continuation, of few guides of few elements.
fn together() -> HairstyleSpec {
    let mut spec = spec(HairContact::Wisps);
    spec.wisps.count = 30;
    spec.equilibrium.resolution = frisure_rod::Resolution::Elements(16);
    spec.equilibrium.method = HeadMethod::Continuation;
    // Guides that differ as hairs do, the harder case.
    spec.fibre.coherence = 1.0;
    spec
}

/// Largest distance (m) between the same points of two hairstyles, guide by guide, in order.
fn moves(a: &Hairstyle, b: &Hairstyle) -> Vec<f64> {
    let line = |style: &Hairstyle, i: usize| style.equilibria()[i].centre_line(40);
    let of_guide = |i: usize| {
        let (a, b) = (line(a, i), line(b, i));
        a.iter().zip(&b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
    };
    let mut moves: Vec<f64> = (0..a.guides().len()).map(of_guide).collect();
    moves.sort_by(f64::total_cmp);
    moves
}

#[test]
fn a_head_together_is_at_a_certified_minimum() {
    let style = predict(&together(), head(), PredictOptions::default(), &()).unwrap();
    let report = settling_report(&style, head());
    let joint = report.joint.expect("settled together");
    assert!(joint.stable && joint.gradient_norm <= 1e-8, "{joint:?}");
    let lowest = joint.lowest_eigenvalue.expect("each guide is at a minimum");
    // Contact makes a head softer in some direction than its guides are one by one.
    assert!(lowest > joint.eigenvalue_error && lowest < 1.0, "{joint:?}");
    assert_eq!((report.stable, report.not_converged), (30, 0));
    // A minimum of the same energy as that of sweeps, and in a valley of about the same height.
    let mut sweeps = together();
    sweeps.equilibrium.method = HeadMethod::Sweeps;
    sweeps.equilibrium.tolerance = 1e-4;
    let sweeps = predict(&sweeps, head(), PredictOptions::default(), &()).unwrap();
    let other = settling_report(&sweeps, head());
    assert_eq!(other.joint, None);
    let (found, expected) = (report.energy.total(), other.energy.total());
    assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
    // From there on it stays where it is.
    let options = PredictOptions {
        previous: Some(&style),
        start: Start::Previous,
        ..PredictOptions::default()
    };
    let again = predict(&together(), head(), options, &()).unwrap();
    assert!(moves(&style, &again)[29] < 1e-6, "{:?}", moves(&style, &again));
}

#[test]
fn a_head_together_hardly_moves_for_a_millionth_of_its_length() {
    let style = |factor: f64| {
        let mut spec = together();
        spec.length.mean *= factor;
        predict(&spec, head(), PredictOptions::default(), &()).unwrap()
    };
    let moves = moves(&style(1.0), &style(1.0 + 1e-6));
    assert!(moves[15] < 5e-5 && moves[28] < 5e-4, "{moves:?}");
}

#[test]
fn a_head_together_is_the_same_whatever_the_number_of_threads() {
    let positions = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let style =
            pool.install(|| predict(&together(), head(), PredictOptions::default(), &()).unwrap());
        let shapes = style.equilibria().iter();
        shapes.flat_map(|rest| rest.shape.positions.clone()).collect::<Vec<DVec3>>()
    };
    assert_eq!(positions(1), positions(3));
}
