//! The main job on small heads: what must hold for every head of hair.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure_hairstyle::head::{Head, HeadError, Region, ScalpSource};
use frisure_hairstyle::{
    Body, Curl, Effort, HairContact, Hairs, Hairstyle, HairstyleSpec, PRESETS, Parting, Place,
    PredictError, PredictOptions, RegionLength, RegionStyle, Start, StrandOptions, predict, preset,
    settling_report, strands as draw,
};
use frisure_progress::Progress;
use frisure_rod::{AccuracyStatus, Options, Resolution, equilibrium};
use frisure_strands::{AttributeValues, Strands, Surface};

fn head() -> &'static Head {
    static HEAD: OnceLock<Head> = OnceLock::new();
    HEAD.get_or_init(Head::mannequin)
}

/// A hairstyle small enough for a test.
fn small(name: &str) -> HairstyleSpec {
    let mut spec = preset(name).unwrap().spec();
    spec.wisps.count = 40;
    spec.wisps.hairs = Hairs::Count(1500);
    spec
}

fn strands(spec: &HairstyleSpec) -> Strands {
    draw(
        &predict(spec, head(), PredictOptions::default(), &()).unwrap(),
        head(),
        StrandOptions::default(),
        &(),
    )
    .unwrap()
    .strands
}

#[test]
fn every_preset_comes_to_rest_and_is_drawn() {
    for p in PRESETS {
        let mut spec = small(p.name);
        (spec.wisps.count, spec.wisps.hairs) = (8, Hairs::Count(300));
        let style = predict(&spec, head(), PredictOptions::default(), &()).unwrap();
        let report = settling_report(&style, head());
        assert_eq!(report.stable, 8, "{}: {report:?}", p.name);
        assert!(report.penetration < 5e-4, "{}: {report:?}", p.name);
        let strands = draw(&style, head(), StrandOptions::default(), &()).unwrap().strands;
        assert_eq!(strands.len(), 300);
        assert!(strands.points().iter().all(|p| p.is_finite()));
    }
}

#[test]
fn hairs_start_in_the_skin_and_stay_out_of_the_body() {
    for name in ["caucasian-straight", "frizzy"] {
        let strands = strands(&small(name));
        let distance = |p: glam::Vec3| head().signed_distance().value(p.as_dvec3());
        for hair in strands.iter() {
            let root = distance(hair.points[0]);
            assert!((-1.5e-3..=2e-4).contains(&root), "{name}: root at {root}");
            for &p in &hair.points[1..] {
                assert!(distance(p) > -3e-4, "{name}: {p} is {} deep", -distance(p));
            }
        }
    }
}

#[test]
fn hairs_are_as_long_as_asked() {
    let spec = small("caucasian-straight");
    let strands = strands(&spec);
    let length = |points: &[glam::Vec3]| -> f64 {
        points.windows(2).map(|p| f64::from(p[0].distance(p[1]))).sum()
    };
    let mean = strands.iter().map(|s| length(s.points)).sum::<f64>() / strands.len() as f64;
    assert!((mean / spec.length.mean - 0.95).abs() < 0.08, "{mean}");
}

#[test]
fn the_scalp_is_covered() {
    let mut spec = small("caucasian-straight");
    spec.wisps.hairs = Hairs::Count(20_000);
    let strands = strands(&spec);
    let roots: Vec<_> = strands.iter().map(|s| s.points[0].as_dvec3()).collect();
    let scalp = head().scalp();
    let full = head().surface().positions().iter().zip(scalp).filter(|v| *v.1 > 0.95);
    for (vertex, _) in full.step_by(97) {
        let nearest = roots.iter().map(|r| r.distance(*vertex)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 6e-3, "no hair within {nearest} m of {vertex}");
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let mut spec = small("caucasian-curly");
    (spec.wisps.count, spec.wisps.hairs) = (12, Hairs::Count(600));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| strands(&spec))
    };
    let (one, three) = (on(1), on(3));
    assert!(one == three);
    let other = HairstyleSpec { seed: spec.seed + 1, ..spec };
    assert!(strands(&other) != one);
}

#[test]
fn all_three_bodies_work() {
    for body in [Body::None, Body::Spheres, Body::SignedDistance] {
        let mut spec = small("caucasian-wavy");
        (spec.wisps.count, spec.contact.body) = (20, body);
        let report = settling_report(
            &predict(&spec, head(), PredictOptions::default(), &()).unwrap(),
            head(),
        );
        // Where two spheres meet the body has a crease, on which a guide may not come to rest.
        let least = if body == Body::Spheres { 19 } else { 20 };
        assert!(report.stable >= least, "{body:?}: {report:?}");
        match body {
            Body::None => assert!(report.penetration > 0.01, "{report:?}"),
            // The spheres follow the scalp to 3 mm, ears and shoulders to a few centimetres.
            Body::Spheres => assert!(report.penetration < 0.03, "{report:?}"),
            Body::SignedDistance => assert!(report.penetration < 5e-4, "{report:?}"),
        }
    }
}

#[test]
fn no_hair_crosses_a_parting() {
    let mut spec = small("caucasian-straight");
    // Straight back in the middle: the sides of x = 0 are those of the parting.
    spec.implantation.partings = vec![Parting::Through(vec![[0.0, -0.005], [0.0, 0.13]])];
    spec.wisps.count = 80;
    spec.wisps.hairs = Hairs::Count(6000);
    let strands = strands(&spec);
    let (mut beside, mut crossing, mut leaving) = (0, 0, 0);
    for hair in strands.iter() {
        // Where it is out of the skin: below the skin a hair that lies flat comes from beyond the line.
        let root = hair.points[1];
        if root.y > 0.03 || root.z < 0.06 || root.x.abs() > 0.02 {
            continue;
        }
        beside += 1;
        crossing += usize::from(hair.points[1..].iter().any(|p| p.x * root.x.signum() < -2e-3));
        // A centimetre on it is farther from the line than its root.
        leaving += usize::from((hair.points[2].x - root.x) * root.x.signum() > 0.0);
    }
    assert!(beside > 200 && crossing == 0, "{crossing} of {beside}");
    assert!(leaving > beside * 99 / 100, "{leaving} of {beside}");
    // No bald stripe: roots are as many next to the line as farther off.
    let within = |from: f32, to: f32| {
        let top = strands.iter().map(|h| h.points[0]).filter(|p| p.y.abs() < 0.03 && p.z > 0.09);
        top.filter(|p| (from..to).contains(&p.x.abs())).count()
    };
    assert!(within(0.0, 0.004) * 3 > within(0.004, 0.008) * 2);
}

#[test]
fn baby_hairs_are_short_thin_and_at_the_edge() {
    let mut spec = small("caucasian-straight");
    spec.implantation.baby_hairs = 1.0;
    // Every other hair is as thick as the mean.
    spec.fibre.variation = 0.0;
    let all = strands(&spec);
    let thick = spec.fibre.section.mean_radius() as f32;
    let thin: Vec<_> = all.iter().filter(|s| s.radii[0] < 0.6 * thick).collect();
    let length =
        |points: &[glam::Vec3]| -> f32 { points.windows(2).map(|p| p[0].distance(p[1])).sum() };
    assert!((100..all.len() / 2).contains(&thin.len()), "{}", thin.len());
    for hair in &thin {
        // 6 mm at the hairline to 5 cm at 1.5 cm from it.
        assert!((0.005..0.06).contains(&length(hair.points)), "{}", length(hair.points));
        assert!(hair.points[0].z < 0.095, "not at the vertex");
    }
    spec.implantation.baby_hairs = 0.0;
    assert!(strands(&spec).iter().all(|s| s.radii[0] > 0.9 * thick));
}

#[test]
fn regions_have_hair_of_their_own_length() {
    let mut spec = small("caucasian-straight");
    spec.wisps.count = 80;
    (spec.implantation.baby_hairs, spec.wisps.growing) = (0.0, 0.0);
    spec.regions = vec![RegionStyle {
        places: vec![Place::Region(Region::Back), Place::Region(Region::Nape)],
        length: Some(RegionLength::Mean(0.03)),
        ..RegionStyle::default()
    }];
    let style = predict(&spec, head(), PredictOptions::default(), &()).unwrap();
    for (guide, rest) in style.guides().iter().zip(style.equilibria()) {
        let shares = head().landmarks().shares(guide.root.position);
        let back = shares[Region::Back as usize] + shares[Region::Nape as usize];
        let short = rest.rod.length() < 0.05;
        assert_eq!(short, back > 0.5, "{:?}", guide.region);
    }
    // Drawn hairs keep to it, too: none in between. Their first point is below the skin and up to 1.5 mm from the root.
    for hair in draw(&style, head(), StrandOptions::default(), &()).unwrap().strands.iter() {
        let shares = head().landmarks().shares(hair.points[0].as_dvec3());
        let back = shares[Region::Back as usize] + shares[Region::Nape as usize];
        let length: f32 = hair.points.windows(2).map(|p| p[0].distance(p[1])).sum();
        assert!((length < 0.06) == (back > 0.5) || (back - 0.5).abs() < 0.1, "{length} {back}");
    }
}

/// A head whose scalp is where `grows` says.
fn bald_but(grows: impl Fn(glam::DVec3) -> bool) -> Result<Head, HeadError> {
    let surface = head().surface().clone();
    let weights = surface.positions().iter().map(|&p| f64::from(grows(p))).collect();
    Head::from_surface(surface, ScalpSource::Weights(weights))
}

#[test]
fn unusual_scalps_have_hair_where_they_say_and_nowhere_else() {
    let mut spec = small("caucasian-wavy");
    (spec.wisps.count, spec.wisps.hairs) = (10, Hairs::Count(300));
    // Two islands far from each other, and the underside of the chin.
    let islands = |p: glam::DVec3| p.z > 0.1 || (p.y > 0.06 && p.z.abs() < 0.02);
    let below = |p: glam::DVec3| p.z < -0.095 && p.z > -0.125 && p.y < -0.03;
    let places: [&dyn Fn(glam::DVec3) -> bool; 2] = [&islands, &below];
    for place in places {
        let head = bald_but(place).unwrap();
        let style = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
        assert_eq!(style.guides().len(), 10);
        assert!(style.guides().iter().all(|g| g.root.position.is_finite()));
        let strands = draw(&style, &head, StrandOptions::default(), &()).unwrap().strands;
        let near = |root: glam::DVec3| {
            let skin = head.surface().positions().iter().zip(head.scalp());
            skin.into_iter().any(|(p, &w)| w > 0.0 && p.distance(root) < 8e-3)
        };
        assert!(strands.iter().all(|h| near(h.points[0].as_dvec3())));
    }
    assert_eq!(bald_but(|_| false), Err(HeadError::NoScalp));
}

#[test]
fn more_wisps_than_a_scalp_has_room_for_are_refused() {
    let spot = bald_but(|p| p.z > 0.108 && p.x.abs() < 4e-3 && p.y.abs() < 4e-3).unwrap();
    let mut spec = small("caucasian-straight");
    spec.wisps.count = 20_000;
    let refused = predict(&spec, &spot, PredictOptions::default(), &());
    assert!(matches!(refused, Err(PredictError::Crowded(_))), "{refused:?}");
}

#[test]
fn each_hair_names_its_guide() {
    let strands = strands(&small("caucasian-straight"));
    let AttributeValues::U32(guides) = &strands.attribute("guide").unwrap().values else {
        panic!("guide is an index");
    };
    assert!(guides.iter().all(|&g| g < 40));
}

struct StopAfter(AtomicUsize);

impl Progress for StopAfter {
    fn report(&self, _stage: &str, _fraction: f64) {}

    fn is_cancelled(&self) -> bool {
        self.0.fetch_sub(1, Ordering::Relaxed) == 1
    }
}

#[test]
fn the_work_can_be_given_up() {
    let spec = small("caucasian-straight");
    let progress = StopAfter(AtomicUsize::new(5));
    assert!(matches!(
        predict(&spec, head(), PredictOptions::default(), &progress),
        Err(PredictError::Cancelled(_))
    ));
    let style = predict(&spec, head(), PredictOptions::default(), &()).unwrap();
    assert!(
        draw(&style, head(), StrandOptions::default(), &StopAfter(AtomicUsize::new(50))).is_err()
    );
}

#[test]
fn a_head_far_from_the_origin_is_refused() {
    let near = head().surface();
    let far = near.positions().iter().map(|p| *p + glam::DVec3::X * 1e6).collect();
    let surface = Surface::new(far, near.triangles().to_vec()).unwrap();
    let refused = Head::from_surface(surface, ScalpSource::Guess);
    assert!(matches!(refused, Err(HeadError::Distance { .. })));
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let mut spec = small("caucasian-straight");
    spec.wisps.count = 0;
    let Err(PredictError::Spec(error)) = predict(&spec, head(), PredictOptions::default(), &())
    else {
        panic!("zero wisps")
    };
    assert_eq!(error.field, "wisps.count");
    let mut spec = small("caucasian-straight");
    spec.length.mean = f64::NAN;
    assert!(predict(&spec, head(), PredictOptions::default(), &()).is_err());
}

#[test]
fn guides_vary_in_diameter_and_axis_ratio_as_measured() {
    let mut spec = small("african-coily");
    spec.wisps.count = 600;
    spec.length.mean = 0.005;
    let sections = |spec: &HairstyleSpec| -> Vec<(f64, f64)> {
        let style = predict(spec, head(), PredictOptions::default(), &()).unwrap();
        let section = |g: &frisure_hairstyle::Guide| g.rod.spec().section;
        style.guides().iter().map(section).map(|s| (s.mean_radius(), s.axis_ratio())).collect()
    };
    let moments = |values: Vec<f64>| {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        (mean, (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt())
    };
    let drawn = sections(&spec);
    // The mean hairs of wisps differ by a part of what hairs do.
    let part = spec.fibre.coherence;
    let (radius, spread) = moments(drawn.iter().map(|s| s.0).collect());
    assert!((radius / spec.fibre.section.mean_radius() - 1.0).abs() < 0.02, "{radius}");
    assert!((spread / radius / spec.fibre.variation / part - 1.0).abs() < 0.15, "{spread}");
    let (ratio, spread) = moments(drawn.iter().map(|s| s.1).collect());
    assert!((ratio - spec.fibre.section.axis_ratio()).abs() < 0.03, "{ratio}");
    assert!((spread / 0.16 / part - 1.0).abs() < 0.15, "{spread}");
    spec.fibre.coherence = 1.0;
    let (radius, spread) = moments(sections(&spec).iter().map(|s| s.0).collect());
    assert!((spread / radius / spec.fibre.variation - 1.0).abs() < 0.15, "{spread}");
    spec.fibre.variation = 0.0;
    spec.fibre.axis_ratio_variation = 0.0;
    let same = spec.fibre.section;
    for (radius, ratio) in sections(&spec) {
        assert!((radius / same.mean_radius() - 1.0).abs() < 1e-12);
        assert!((ratio / same.axis_ratio() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn varying_the_section_changes_neither_roots_nor_curls() {
    let mut spec = small("caucasian-curly");
    (spec.wisps.count, spec.implantation.baby_hairs) = (10, 0.0);
    let mut even = spec.clone();
    even.fibre.variation = 0.0;
    let plan =
        |spec: &HairstyleSpec| predict(spec, head(), PredictOptions::default(), &()).unwrap();
    let (varied, even) = (plan(&spec), plan(&even));
    for (a, b) in varied.guides().iter().zip(even.guides()) {
        assert_eq!(a.rod.root(), b.rod.root());
        assert_eq!(a.rod.natural(), b.rod.natural());
        assert_eq!(a.rod.length(), b.rod.length());
    }
    // Drawn hairs differ in diameter as guides do.
    let strands = draw(&varied, head(), StrandOptions::default(), &()).unwrap().strands;
    let mean = spec.fibre.section.mean_radius();
    let ratios: Vec<f64> = strands.iter().map(|hair| f64::from(hair.radii[0]) / mean).collect();
    let average = ratios.iter().sum::<f64>() / ratios.len() as f64;
    let square = ratios.iter().map(|ratio| (ratio - average).powi(2)).sum::<f64>();
    let deviation = (square / ratios.len() as f64).sqrt();
    assert!((average - 1.0).abs() < 0.02, "{average}");
    assert!((deviation / spec.fibre.variation - 1.0).abs() < 0.1, "{deviation}");
}

#[test]
fn more_hairs_than_can_be_drawn_are_refused() {
    for (hairs, points, field) in [
        (Hairs::Density(2e7), 8, "wisps.density"),
        (Hairs::Density(9e6), 1000, "wisps.points"),
        (Hairs::PerWisp(50_000), 8, "wisps.hairs_per_wisp"),
        (Hairs::Count(1_000_001), 8, "wisps.hairs"),
        (Hairs::Count(300_000), 1000, "wisps.points"),
    ] {
        let mut spec = small("caucasian-straight");
        (spec.wisps.hairs, spec.wisps.points) = (hairs, points);
        let Err(PredictError::Spec(error)) = predict(&spec, head(), PredictOptions::default(), &())
        else {
            panic!("{hairs:?}")
        };
        assert_eq!(error.field, field);
    }
}

/// A description of a few guides of fixed elements, with either contact between hairs.
fn few(hair: HairContact) -> HairstyleSpec {
    let mut spec = small("caucasian-curly");
    spec.equilibrium.resolution = Resolution::Elements(15);
    spec.contact.hair = hair;
    spec
}

/// From where the guides of a hairstyle rest.
fn warm_from(previous: &Hairstyle, effort: Effort) -> PredictOptions<'_> {
    PredictOptions { previous: Some(previous), start: Start::Previous, effort }
}

#[test]
fn a_warm_start_from_itself_changes_nothing() {
    for hair in [HairContact::Layers, HairContact::Wisps] {
        let spec = few(hair);
        let style = predict(&spec, head(), PredictOptions::default(), &()).unwrap();
        let again = predict(&spec, head(), warm_from(&style, Effort::FULL), &()).unwrap();
        let report = settling_report(&again, head());
        assert!(report.stable == 40 && report.iterations <= 40, "{report:?}");
        for (a, b) in style.equilibria().iter().zip(again.equilibria()) {
            for (p, q) in a.shape.positions.iter().zip(&b.shape.positions) {
                assert!(p.distance(*q) < 1e-6, "{hair:?}: {p} {q}");
            }
        }
    }
}

#[test]
fn a_warm_start_finds_as_low_an_energy_in_as_many_calls_as_it_takes() {
    let spec = few(HairContact::Layers);
    let style = predict(&spec, head(), PredictOptions::default(), &()).unwrap();
    let mut changed = spec;
    changed.curl.strain *= 1.02;
    let cold = settling_report(
        &predict(&changed, head(), PredictOptions::default(), &()).unwrap(),
        head(),
    );
    let scale = cold.energy.elastic + cold.energy.gravity.abs();
    let little = Effort { iterations: 2, sweeps: 1 };
    let mut warm = predict(&changed, head(), warm_from(&style, little), &()).unwrap();
    assert!(settling_report(&warm, head()).not_converged > 0);
    for _ in 0..200 {
        warm = predict(&changed, head(), warm_from(&warm, little), &()).unwrap();
        if settling_report(&warm, head()).not_converged == 0 {
            break;
        }
    }
    let report = settling_report(&warm, head());
    assert_eq!(report.stable, 40, "{report:?}");
    let above = (report.energy.total() - cold.energy.total()) / scale;
    assert!(above < 0.01, "{above}: {report:?} {cold:?}");
}

/// What a guide with contact shows is not extrapolated: the accuracy is that of its division.
#[test]
fn guides_are_as_near_to_the_exact_equilibrium_as_is_requested() {
    for (accuracy, length, radius, pitch) in [
        (5e-4, 0.545, 0.0388, 0.00662),
        // These have more elements than extrapolation takes, with which some were farther.
        (5e-5, 0.591, 0.0518, 0.0168),
        (5e-6, 0.302, 0.0104, 0.0579),
        // So tight that nothing is extrapolated.
        (5e-4, 0.45, 0.0019, 0.0046),
    ] {
        let mut spec = small("caucasian-curly");
        (spec.wisps.count, spec.contact.body) = (1, Body::None);
        // Wisps without thickness, which nothing holds: by their weight alone, and not extrapolated.
        (spec.contact.hair, spec.contact.volume) = (HairContact::Wisps, 0.0);
        spec.implantation.hold = 0.0;
        spec.length.mean = length;
        spec.curl.strain = Curl::helix(radius, pitch).unwrap().strain;
        spec.equilibrium.resolution = Resolution::Accuracy(accuracy);
        for seed in 0..3 {
            spec.seed = seed;
            let style = predict(&spec, head(), PredictOptions::default(), &()).unwrap();
            let rest = &style.equilibria()[0];
            assert_eq!(rest.certificate.accuracy, AccuracyStatus::Met, "{length} {seed}");
            let options =
                Options { resolution: Resolution::Accuracy(1e-2 * accuracy), ..Options::default() };
            let exact = equilibrium(&rest.rod, &[], &options);
            assert_eq!(exact.certificate.accuracy, AccuracyStatus::Met);
            let (a, b) = (rest.centre_line(500), exact.centre_line(500));
            let gap = a.iter().zip(&b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(gap <= accuracy, "{length} {seed}: {gap} m with {} elements", rest.elements);
        }
    }
}
