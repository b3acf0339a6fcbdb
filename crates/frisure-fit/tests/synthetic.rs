//! Fits of synthetic fibres whose numbers are known. `FRISURE_FIBRES=10000` fits more of them.

#![expect(clippy::print_stderr, reason = "figures, for whoever reads a test's output")]

mod common;

use common::{Truth, clamp, even, lines, noisy, seen_once, seen_twice};
use frisure_fit::{Estimate, Fibre, Fit, FitStatus, Known, Options, Pose, Quantity, fit};
use frisure_rod::{NaturalStrain, Rod, RodSpec, SplitMix64, StrainProfile};
use glam::{DQuat, DVec3};

/// 0.1 mm.
const NOISE: f64 = 1e-4;

const DOWN: DVec3 = DVec3::new(0.0, 0.0, -9.81);

fn options() -> Options {
    Options { noise: Some(NOISE), ..Options::default() }
}

/// Fibres whose section is known to be a circle.
const ROUND: Known = Known {
    axis_ratio: Some(Estimate { value: 1.0, deviation: 0.0 }),
    stiffness_over_weight: None,
    torsion_ratio: None,
    curvature: None,
    torsion: None,
};

fn fitted(fibres: &[Fibre]) -> Vec<Fit> {
    fit(fibres, &[ROUND], &options(), &()).unwrap()
}

/// How many fibres: `FRISURE_FIBRES`, or a few.
fn count(few: usize) -> usize {
    std::env::var("FRISURE_FIBRES").ok().and_then(|text| text.parse().ok()).unwrap_or(few)
}

fn truths(count: usize, seed: u64) -> Vec<Truth> {
    let mut random = SplitMix64(seed);
    (0..count).map(|_| Truth::random(&mut random)).collect()
}

/// The error of the natural strain relative to it, and that of the stiffness over weight.
fn errors(truth: &Truth, fit: &Fit) -> [f64; 2] {
    let (k, t) = (truth.curvature(), truth.torsion());
    let strain = (k - fit.curvature.value).hypot(t - fit.torsion.value) / k.hypot(t);
    [strain, (fit.stiffness_over_weight[0].value / truth.stiffness - 1.0).abs()]
}

fn quantile(mut values: Vec<f64>, q: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[(q * (values.len() - 1) as f64) as usize]
}

/// The numbers of the issue: 2 % of the natural strain, 5 % of the stiffness where the lines tell it to a deviation of half of that.
fn is_accurate(name: &str, truths: &[Truth], fits: &[Fit]) {
    let unfitted = fits.iter().filter(|fit| fit.status != FitStatus::Fitted).count();
    let pairs = || truths.iter().zip(fits).filter(|(_, fit)| fit.status == FitStatus::Fitted);
    let strain: Vec<f64> = pairs().map(|(truth, fit)| errors(truth, fit)[0]).collect();
    let told = |fit: &Fit| fit.stiffness_over_weight[0].relative_deviation() < 0.025;
    let stiffness: Vec<f64> =
        pairs().filter(|(_, fit)| told(fit)).map(|(truth, fit)| errors(truth, fit)[1]).collect();
    eprintln!(
        "{name}: {unfitted} of {} not fitted; strain: median {:.4}, 95 % {:.4}, within 2 % {:.4}; stiffness told in {}: median \
         {:.4}, 95 % {:.4}, within 5 % {:.4}",
        fits.len(),
        quantile(strain.clone(), 0.5),
        quantile(strain.clone(), 0.95),
        strain.iter().filter(|x| **x < 0.02).count() as f64 / strain.len() as f64,
        stiffness.len(),
        quantile(stiffness.clone(), 0.5),
        quantile(stiffness.clone(), 0.95),
        stiffness.iter().filter(|x| **x < 0.05).count() as f64 / stiffness.len() as f64,
    );
    assert!(unfitted * 200 <= fits.len(), "at most one in 200");
    // 95 of 100 are within two deviations, which are at most these.
    assert!(quantile(strain, 0.95) < 0.02 && quantile(stiffness, 0.95) < 0.05);
}

#[test]
fn strain_and_stiffness_are_found() {
    let truths = truths(count(300), 1);
    let mut random = SplitMix64(2);
    is_accurate("once", &truths, &fitted(&seen_once(&truths, NOISE, true, &mut random)));
    is_accurate("no arc lengths", &truths, &fitted(&seen_once(&truths, NOISE, false, &mut random)));
    is_accurate("twice", &truths, &fitted(&seen_twice(&truths, NOISE, &mut random)));
}

/// How many of the truths are within so many deviations of each number: radius, pitch, ln EI/ρSg, ln GJ/EI.
fn covered(truths: &[Truth], fits: &[Fit], deviations: f64) -> [f64; 4] {
    let mut inside = [0; 4];
    for (truth, fit) in truths.iter().zip(fits) {
        let (stiffness, ratio) = (fit.stiffness_over_weight[0], fit.torsion_ratio);
        let pairs = [
            (fit.curl_radius.value - truth.radius, fit.curl_radius.deviation),
            (fit.curl_pitch.value - truth.pitch, fit.curl_pitch.deviation),
            ((stiffness.value / truth.stiffness).ln(), stiffness.relative_deviation()),
            ((fit.torsion_ratio.value / truth.ratio).ln(), ratio.relative_deviation()),
        ];
        for (inside, (error, deviation)) in inside.iter_mut().zip(pairs) {
            *inside += usize::from(error.abs() < deviations * deviation);
        }
    }
    inside.map(|n| n as f64 / fits.len() as f64)
}

/// GJ/EI is drawn from what a fit takes for known, so that its intervals are those of a posterior.
#[test]
fn intervals_contain_the_truth_as_often_as_they_say() {
    let truths = truths(count(1000), 3);
    let mut random = SplitMix64(4);
    for placed in [true, false] {
        let fits = fitted(&seen_once(&truths, NOISE, placed, &mut random));
        for (deviations, share) in [(1.0, 0.683), (1.96, 0.95)] {
            let covered = covered(&truths, &fits, deviations);
            eprintln!("{deviations} deviations: {covered:.3?}");
            // Three deviations of the count, and two hundredths for intervals that are those of a linear model.
            let slack = 3.0 * (share * (1.0_f64 - share) / fits.len() as f64).sqrt() + 0.02;
            assert!(covered.iter().all(|x| (x - share).abs() < slack), "{covered:?} of {share}");
        }
    }
}

/// Sections are drawn from what a fit takes for known.
#[test]
fn intervals_contain_the_truth_whatever_the_section() {
    let mut random = SplitMix64(21);
    let truths: Vec<Truth> = (0..count(600)).map(|_| Truth::elliptical(&mut random)).collect();
    let fibres = seen_once(&truths, NOISE, true, &mut random);
    let unknown = fit(&fibres, &[Known::default()], &options(), &()).unwrap();
    assert!(unknown.iter().all(|fit| fit.status == FitStatus::Fitted));
    let known: Vec<Known> = truths
        .iter()
        .map(|truth| Known {
            // A measured ratio is at least 1.
            axis_ratio: Some(Estimate { value: truth.axis_ratio.max(1.0), deviation: 0.0 }),
            ..Known::default()
        })
        .collect();
    let known = fit(&fibres, &known, &options(), &()).unwrap();
    let ordinary = |fits: &[Fit]| {
        let pairs = truths.iter().zip(fits).filter(|(truth, _)| truth.axis_ratio >= 1.0);
        let (truths, fits): (Vec<Truth>, Vec<Fit>) =
            pairs.map(|(truth, fit)| (*truth, fit.clone())).unzip();
        covered(&truths, &fits, 1.96)
    };
    let all = [covered(&truths, &unknown, 1.96), ordinary(&known)];
    eprintln!("sections not known, known: {all:.3?}");
    assert!(all.as_flattened().iter().all(|x| *x > 0.9), "{all:?}");
    // A section that is taken for a circle makes the stiffness wrong by many deviations.
    let round = fit(&fibres, &[ROUND], &options(), &()).unwrap();
    assert!(covered(&truths, &round, 1.96)[2] < 0.6);
}

/// Water lowers the shear modulus twice as much as Young's modulus.
#[test]
fn wet_and_dry_have_their_own_moduli() {
    let mut random = SplitMix64(22);
    let truths: Vec<Truth> = (0..count(100)).map(|_| Truth::elliptical(&mut random)).collect();
    let wet = |truth: &Truth| Truth {
        stiffness: 0.43 * truth.stiffness,
        ratio: truth.ratio * 0.22 / 0.43,
        ..*truth
    };
    let fibres: Vec<Fibre> = truths
        .iter()
        .map(|truth| {
            let (tangent, d1) = clamp(&mut random);
            let rods = [truth.rod(tangent, d1, 1.0), wet(truth).rod(tangent, d1, 1.0)];
            let pose = |(state, line): (usize, Vec<DVec3>)| {
                let points = noisy(&line, NOISE, &mut random);
                let arc = even(truth.length, points.len());
                Pose::new(points, Some(arc), DVec3::NEG_Z * 9.81, state).unwrap()
            };
            let poses = lines(&rods).into_iter().enumerate().map(pose).collect();
            Fibre::new(poses, None).unwrap()
        })
        .collect();
    let fits = fit(&fibres, &[Known::default()], &options(), &()).unwrap();
    assert!(fits.iter().all(|fit| fit.status == FitStatus::Fitted));
    assert!(covered(&truths, &fits, 1.96).iter().all(|x| *x > 0.85));
    let inside = |of: fn(&Fit) -> Estimate, truth: fn(&Truth) -> f64| {
        let pairs = truths.iter().zip(&fits);
        let good = pairs.filter(|(one, fit)| {
            let found = of(fit);
            let error = (found.value / truth(&wet(one))).ln();
            error.abs() < 1.96 * found.relative_deviation()
        });
        good.count() as f64 / truths.len() as f64
    };
    assert!(inside(|fit| fit.stiffness_over_weight[1], |truth| truth.stiffness) > 0.85);
    assert!(inside(|fit| fit.torsion_ratio_by_state[1], |truth| truth.ratio) > 0.85);
}

#[test]
fn the_noise_is_found_where_it_is_not_given() {
    let truths = truths(100, 5);
    let mut random = SplitMix64(6);
    let fibres = seen_once(&truths, NOISE, true, &mut random);
    let fits = fit(&fibres, &[ROUND], &Options::default(), &()).unwrap();
    let noise = quantile(fits.iter().map(|fit| fit.noise).collect(), 0.5);
    assert!((noise / NOISE - 1.0).abs() < 0.03, "{noise}");
    let inside = covered(&truths, &fits, 1.96);
    assert!(inside.iter().all(|x| *x > 0.85), "{inside:?}");
}

const CURL: Truth = Truth {
    length: 0.12,
    radius: 0.006,
    pitch: 0.015,
    stiffness: 1e-4,
    ratio: 0.5,
    axis_ratio: 1.0,
};

/// A fibre in one pose: the tangent of its clamp, and gravity as a part of the usual one.
fn pose(truth: &Truth, tangent: DVec3, gravity: f64, random: &mut SplitMix64) -> Pose {
    let line = lines(&[truth.rod(tangent, DVec3::new(0.2, 0.9, 0.1), gravity)]).remove(0);
    let points = noisy(&line, NOISE, random);
    Pose::new(points, Some(even(truth.length, 41)), DOWN * gravity, 0).unwrap()
}

#[test]
fn what_one_pose_cannot_tell_is_named_and_a_second_one_tells_it() {
    let mut random = SplitMix64(7);
    // Without weight stiffness has no effect.
    let flat = pose(&CURL, DVec3::X, 0.0, &mut random);
    let one = fitted(&[Fibre::new(vec![flat.clone()], None).unwrap()]).remove(0);
    assert_eq!(one.status, FitStatus::Fitted);
    assert!(errors(&CURL, &one)[0] < 0.02);
    assert!(one.stiffness_over_weight[0].relative_deviation() > 1.0, "only what is known before");
    let names: Vec<Quantity> = one.blind.iter().map(|blind| blind.parts[0].0).collect();
    assert_eq!(names, [Quantity::StiffnessOverWeight, Quantity::TorsionRatio]);
    let said = one.statements().join("\n");
    assert!(said.contains("stiffness over weight cannot be told from this pose"), "{said}");
    assert!(said.contains("second pose"), "{said}");
    // Straight hair that hangs straight down: nothing bends it. A curl of few turns trades strain for stiffness.
    let short = Truth { length: 0.03, ..CURL };
    let hanging = pose(&short, DVec3::new(0.3, 0.0, -1.0), 1.0, &mut random);
    let hanging = fitted(&[Fibre::new(vec![hanging], None).unwrap()]).remove(0);
    assert!(hanging.statements().join("\n").contains("this pose"), "{:?}", hanging.statements());
    // With gravity and without: everything is told.
    let bent = pose(&CURL, DVec3::X, 1.0, &mut random);
    let both = fitted(&[Fibre::new(vec![flat, bent], None).unwrap()]).remove(0);
    assert_eq!(both.status, FitStatus::Fitted);
    assert!(both.blind.is_empty(), "{:?}", both.statements());
    let [strain, stiffness] = errors(&CURL, &both);
    assert!(strain < 0.01 && stiffness < 0.05, "{strain} {stiffness}");
}

#[test]
fn what_is_known_before_counts() {
    let mut random = SplitMix64(8);
    let flat = Fibre::new(vec![pose(&CURL, DVec3::X, 0.0, &mut random)], None).unwrap();
    let known = |estimate| Known { stiffness_over_weight: Some(estimate), ..Known::default() };
    let guess = Estimate { value: 2e-4, deviation: 2e-5 };
    let found =
        fit(std::slice::from_ref(&flat), &[known(guess)], &options(), &()).unwrap().remove(0);
    let stiffness = found.stiffness_over_weight[0];
    assert!((stiffness.value / 2e-4 - 1.0).abs() < 1e-3, "{stiffness:?}");
    assert!((stiffness.deviation / 2e-5 - 1.0).abs() < 0.02, "{stiffness:?}");
    let exact = known(Estimate::exact(3e-4));
    let found = fit(&[flat], &[exact], &options(), &()).unwrap().remove(0);
    assert!((found.stiffness_over_weight[0].value / 3e-4 - 1.0).abs() < 1e-6);
    assert!(found.stiffness_over_weight[0].relative_deviation() < 1e-6);
}

/// Seen with gravity along any axis: the same fibre, turned.
#[test]
fn the_axes_of_a_pose_do_not_matter() {
    let mut random = SplitMix64(9);
    let upright = pose(&CURL, DVec3::X, 1.0, &mut random);
    let turn = DQuat::from_scaled_axis(DVec3::new(0.4, -1.0, 2.0));
    let points = upright.points().iter().map(|p| turn * *p + DVec3::ONE).collect();
    let arc = upright.arc().map(<[f64]>::to_vec);
    let turned = Pose::new(points, arc, turn * DOWN, 0).unwrap();
    let fibres = [upright, turned].map(|pose| Fibre::new(vec![pose], None).unwrap());
    let [a, b] = fitted(&fibres).try_into().unwrap();
    for (a, b) in [
        (a.curl_radius, b.curl_radius),
        (a.curl_pitch, b.curl_pitch),
        (a.stiffness_over_weight[0], b.stiffness_over_weight[0]),
    ] {
        assert!((a.value - b.value).abs() < 0.05 * a.deviation, "{a:?} {b:?}");
        assert!((a.deviation / b.deviation - 1.0).abs() < 0.01);
    }
    let there = b.lines[0][40];
    assert!(there.distance(turn * a.lines[0][40] + DVec3::ONE) < 0.1 * NOISE);
}

/// Wet hair is softer and heavier, with the same natural strain: its stiffness is told apart from that of dry hair.
#[test]
fn dry_and_wet_have_stiffnesses_of_their_own() {
    let mut random = SplitMix64(10);
    let wet = Truth { stiffness: 3e-5, ..CURL };
    let dry = pose(&CURL, DVec3::X, 1.0, &mut random);
    let soaked = pose(&wet, DVec3::X, 1.0, &mut random);
    let arc = soaked.arc().map(<[f64]>::to_vec);
    let soaked = Pose::new(soaked.points().to_vec(), arc, DOWN, 1).unwrap();
    let found = fitted(&[Fibre::new(vec![dry, soaked], None).unwrap()]).remove(0);
    assert_eq!(found.status, FitStatus::Fitted);
    for (stiffness, truth) in found.stiffness_over_weight.iter().zip([1e-4, 3e-5]) {
        assert!((stiffness.value - truth).abs() < 3.0 * stiffness.deviation, "{stiffness:?}");
        assert!(stiffness.relative_deviation() < 0.1, "{stiffness:?}");
    }
}

/// A fibre whose curl loosens towards its tip.
fn loosening(random: &mut SplitMix64) -> Fibre {
    let (tangent, d1) = clamp(random);
    let rod = CURL.rod(tangent, d1, 1.0);
    let strain = rod.natural().at(0.0);
    let knots = vec![(0.0, strain * 1.3), (CURL.length, strain * 0.7)];
    let natural = NaturalStrain::Varying(StrainProfile::new(knots).unwrap());
    let rod = Rod::new(RodSpec { natural, ..rod.spec().clone() }).unwrap();
    let points = noisy(&lines(&[rod]).remove(0), NOISE, random);
    let pose = Pose::new(points, Some(even(CURL.length, 41)), DOWN, 0).unwrap();
    Fibre::new(vec![pose], None).unwrap()
}

#[test]
fn a_curl_that_varies_is_a_misfit_of_one_that_does_not_and_is_fitted_with_knots() {
    let mut random = SplitMix64(11);
    let fibres: Vec<Fibre> = (0..20).map(|_| loosening(&mut random)).collect();
    let uniform = fitted(&fibres);
    assert!(uniform.iter().all(|fit| fit.status != FitStatus::Fitted));
    assert!(uniform[0].statements()[0].contains("say nothing"), "{:?}", uniform[0].statements());
    let knots = Options { knots: 2, ..options() };
    let varying = fit(&fibres, &[Known::default()], &knots, &()).unwrap();
    let good: Vec<&Fit> = varying.iter().filter(|fit| fit.status == FitStatus::Fitted).collect();
    assert!(good.len() >= 18, "{} of 20", good.len());
    for fit in good {
        for (knot, factor) in [(0, 1.3), (1, 0.7)] {
            let [curvature, _] = fit.profile[knot];
            let truth = factor * CURL.curvature();
            let gap = (curvature.value - truth).abs();
            assert!(gap < 4.0 * curvature.deviation && curvature.deviation < 0.1 * truth);
        }
    }
}

#[test]
fn a_line_that_no_fibre_has_is_told() {
    let mut random = SplitMix64(12);
    let points: Vec<DVec3> = (0..40).map(|_| random.cube() * 0.05).collect();
    let pose = Pose::new(points, None, DOWN, 0).unwrap();
    let found = fitted(&[Fibre::new(vec![pose], None).unwrap()]).remove(0);
    assert_ne!(found.status, FitStatus::Fitted);
    assert!(found.statements()[0].contains("say nothing"), "{:?}", found.statements());
}

#[test]
fn straight_hair_is_called_straight() {
    let mut random = SplitMix64(13);
    let rod = CURL.rod(DVec3::X, DVec3::Y, 1.0);
    let rod = Rod::new(RodSpec { natural: NaturalStrain::STRAIGHT, ..rod.spec().clone() }).unwrap();
    let line = noisy(&lines(&[rod]).remove(0), NOISE, &mut random);
    let pose = Pose::new(line, Some(even(CURL.length, 41)), DOWN, 0).unwrap();
    let found = fitted(&[Fibre::new(vec![pose], None).unwrap()]).remove(0);
    assert_eq!(found.status, FitStatus::Fitted);
    assert!(found.curvature.value < 3.0 * found.curvature.deviation, "{:?}", found.curvature);
    let stiffness = found.stiffness_over_weight[0];
    assert!((stiffness.value - 1e-4).abs() < 3.0 * stiffness.deviation, "{stiffness:?}");
}

#[test]
fn a_fit_does_not_depend_on_those_beside_it() {
    let truths = truths(40, 14);
    let fibres = seen_once(&truths, NOISE, true, &mut SplitMix64(15));
    let together = fitted(&fibres);
    for i in [0, 7, 39] {
        let alone = fitted(&fibres[i..=i]).remove(0);
        assert_eq!(alone.covariance, together[i].covariance);
        assert_eq!(alone.lines, together[i].lines);
    }
}

#[test]
fn a_straight_fibre_is_not_curled_by_its_noise() {
    // The fit finds the helix that explains most of the noise: its curvature has a deviation much smaller than itself.
    let mut random = SplitMix64(41);
    let mut seen = |radius: f64, pitch: f64| {
        let truth =
            Truth { length: 0.12, radius, pitch, stiffness: 9.4e-5, ratio: 0.46, axis_ratio: 1.0 };
        fitted(&seen_once(&vec![truth; count(60)], NOISE, true, &mut random))
    };
    let told = |fits: &[Fit]| {
        let says = |fit: &&Fit| fit.statements().iter().any(|said| said.contains("straight"));
        fits.iter().filter(says).count()
    };
    // A radius of a nanometre.
    let straight = seen(1e-9, 0.05);
    let curled = straight.iter().filter(|f| f.curvature.value > 2.0 * f.curvature.deviation);
    assert!(curled.count() > straight.len() / 4, "the noise is fitted");
    // A slight bend is beyond twice its deviation in a few of a hundred.
    assert!(
        10 * told(&straight) >= 9 * straight.len(),
        "{} of {}",
        told(&straight),
        straight.len()
    );
    // A radius of ten times the noise is a curl.
    assert_eq!(told(&seen(1e-3, 8e-3)), 0);
}
