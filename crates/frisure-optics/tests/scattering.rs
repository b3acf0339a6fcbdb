//! Laws of one fibre that scatters light.

mod support;

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use frisure_look::{Melanin, absorption};
use frisure_optics::LobeShape;
use frisure_optics::scattering::{Fibre, FibreSpec, HairBsdf};
use glam::Vec3;
use support::{Random, direction, integrals, white};

/// Roughnesses along and around: smooth, ordinary, rough, matt.
const ROUGHNESSES: [(f32, f32); 4] = [(0.12, 0.2), (0.3, 0.3), (0.6, 0.8), (1.0, 1.0)];
/// Smoother than a grid of directions can follow in a test's time.
const GLOSSY: (f32, f32) = (0.02, 0.02);
const AXIS_RATIOS: [f32; 6] = [0.55, 0.85, 1.0, 1.3, 1.8, 5.0];

fn fibre(spec: FibreSpec) -> Fibre {
    Fibre::new(spec).unwrap()
}

/// Calls for hits of many fibres.
fn each_hit(roughnesses: &[(f32, f32)], mut test: impl FnMut(&Fibre, Vec3, f32)) {
    for axis_ratio in AXIS_RATIOS {
        for &(beta_m, beta_n) in roughnesses {
            for wetness in [0.0, 1.0] {
                let spec = FibreSpec { wetness, ..white(axis_ratio, beta_m, beta_n) };
                for (theta, phi, h) in [(0.1, 0.4, 0.3), (-0.9, 2.0, -0.8), (1.4, -2.5, 0.97)] {
                    test(&fibre(spec), direction(theta, phi), h);
                }
            }
        }
    }
}

#[test]
fn white_furnace_and_density_are_one_for_every_fibre() {
    let mut worst = 0.0_f64;
    each_hit(&ROUGHNESSES, |fibre, wo, h| {
        let (energy, density) = integrals(fibre, wo, h, (160, 96));
        worst = worst.max((energy - 1.0).abs()).max((density - 1.0).abs());
    });
    assert!(worst < 1e-3, "{worst}");
}

#[test]
fn white_furnace_over_the_width() {
    for axis_ratio in [0.55, 0.7, 0.85, 1.0, 1.3, 1.8] {
        for theta in [0.0, 0.7, -1.3] {
            let fibre = fibre(white(axis_ratio, 0.3, 0.3));
            let mean: f64 = (0..20_u8)
                .map(|i| (f32::from(i) + 0.5) / 10.0 - 1.0)
                .map(|h| integrals(&fibre, direction(theta, 1.0), h, (60, 60)).0)
                .sum();
            assert!((mean / 20.0 - 1.0).abs() < 1e-3, "{axis_ratio} {theta} {mean}");
        }
    }
}

#[test]
fn samples_without_absorption_weigh_one() {
    let mut random = Random(1);
    let mut worst = 0.0_f32;
    each_hit(&[&ROUGHNESSES[..], &[GLOSSY]].concat(), |fibre, wo, h| {
        let hit = HairBsdf::new(fibre, wo, h);
        for _ in 0..200 {
            let s = hit.sample(random.four());
            worst = worst.max((s.weight - Vec3::ONE).abs().max_element());
            assert!(s.wi.is_normalized() && s.pdf > 0.0 && s.pdf.is_finite());
        }
    });
    assert!(worst < 1e-5, "{worst}");
}

#[test]
fn a_sample_has_the_value_and_density_of_its_direction() {
    let mut random = Random(2);
    let pigment = absorption(Melanin::BROWN);
    each_hit(&ROUGHNESSES, |fibre, wo, h| {
        let fibre = fibre.with_absorption(pigment).unwrap();
        let hit = HairBsdf::new(&fibre, wo, h);
        for _ in 0..20 {
            let s = hit.sample(random.four());
            let again = hit.evaluate(s.wi);
            assert!((s.pdf / again.pdf - 1.0).abs() < 5e-3, "{} {}", s.pdf, again.pdf);
            assert!((s.weight - again.f_cos / again.pdf).abs().max_element() < 5e-3);
        }
    });
}

/// χ² per degree of freedom of samples on a grid of equal steps in sin θ and φ.
fn chi_squared(hit: &HairBsdf<'_>, random: &mut Random) -> f64 {
    const ROWS: usize = 16;
    const COLUMNS: usize = 24;
    const SAMPLES: usize = 60_000;
    const FINE: usize = 12;
    let mut seen = vec![0.0_f64; ROWS * COLUMNS];
    for _ in 0..SAMPLES {
        let wi = hit.sample(random.four()).wi;
        let row = ((wi.z + 1.0) * 0.5 * ROWS as f32) as usize;
        let column = (wi.y.atan2(wi.x) / TAU + 0.5) * COLUMNS as f32;
        seen[row.min(ROWS - 1) * COLUMNS + (column as usize).min(COLUMNS - 1)] += 1.0;
    }
    let mut expected = vec![0.0_f64; ROWS * COLUMNS];
    for i in 0..ROWS * FINE {
        let z = 2.0 * (i as f32 + 0.5) / (ROWS * FINE) as f32 - 1.0;
        for j in 0..COLUMNS * FINE {
            let phi = TAU * (j as f32 + 0.5) / (COLUMNS * FINE) as f32 - PI;
            let cell = 4.0 * f64::from(PI) / (ROWS * COLUMNS * FINE * FINE) as f64;
            let pdf = f64::from(hit.evaluate(direction(z.asin(), phi)).pdf);
            expected[i / FINE * COLUMNS + j / FINE] += pdf * cell * SAMPLES as f64;
        }
    }
    let (mut chi, mut cells, mut few) = (0.0, 0.0, (0.0, 0.0));
    for (s, e) in seen.iter().zip(&expected) {
        if *e > 8.0 {
            chi += (s - e).powi(2) / e;
            cells += 1.0;
        } else {
            few = (few.0 + s, few.1 + e);
        }
    }
    chi += (few.0 - few.1).powi(2) / few.1.max(1.0);
    (chi - cells) / (2.0_f64 * cells).sqrt()
}

#[test]
fn samples_are_distributed_as_their_density() {
    let mut random = Random(3);
    let pigment = absorption(Melanin::BLOND);
    for (axis_ratio, beta_m, beta_n) in [(1.0, 0.3, 0.3), (1.6, 0.25, 0.4), (0.6, 0.7, 0.9)] {
        let spec = FibreSpec { absorption: pigment, ..white(axis_ratio, beta_m, beta_n) };
        for (theta, phi, h) in [(0.2, 0.5, 0.4), (-1.0, 2.2, -0.9)] {
            let fibre = fibre(spec);
            let deviations =
                chi_squared(&HairBsdf::new(&fibre, direction(theta, phi), h), &mut random);
            // In standard deviations of χ².
            assert!(deviations < 4.0, "{axis_ratio} {theta}: {deviations}");
        }
    }
}

#[test]
fn absorption_only_takes_and_more_takes_more() {
    for axis_ratio in AXIS_RATIOS {
        for (theta, phi, h) in [(0.0, 0.3, 0.1), (0.8, 1.9, -0.7), (-1.5, 4.0, 0.999)] {
            let mut before = 1.0 + 1e-5;
            for sigma in [0.0, 0.05, 0.3, 1.0, 5.0, 50.0, 1e6] {
                let spec =
                    FibreSpec { absorption: Vec3::splat(sigma), ..white(axis_ratio, 0.3, 0.3) };
                let all: Vec3 =
                    HairBsdf::new(&fibre(spec), direction(theta, phi), h).energies().iter().sum();
                assert!(all.x <= before, "{axis_ratio} {theta} {sigma}: {all} {before}");
                before = all.x;
            }
        }
    }
}

/// Mean energies of R, TT, TRT over offset and `turns` orientations in half a turn, at normal
/// incidence.
fn mean_energies(axis_ratio: f32, turns: u16) -> [f64; 3] {
    let fibre = fibre(white(axis_ratio, 0.3, 0.3));
    let (mut sum, offsets) = ([0.0; 3], 500_u16);
    for i in 0..turns {
        let wo = direction(0.0, PI * f32::from(i) / f32::from(turns));
        for j in 0..offsets {
            let h = 2.0 * (f32::from(j) + 0.5) / f32::from(offsets) - 1.0;
            for (sum, e) in sum.iter_mut().zip(HairBsdf::new(&fibre, wo, h).energies()) {
                *sum += f64::from(e.x);
            }
        }
    }
    sum.map(|e| e / f64::from(turns) / f64::from(offsets))
}

#[test]
fn energies_of_ellipses_are_those_of_an_exact_ray_trace() {
    // Two separate ray traces made for this project, index 1.55, no absorption. The first took twelve
    // orientations, too few for 0.60, where total reflection sets in; the second took 720.
    for (axis_ratio, turns, exact) in [
        (1.0, 12, [0.075, 0.862, 0.056]),
        (0.917, 12, [0.075, 0.838, 0.072]),
        (0.85, 12, [0.075, 0.811, 0.096]),
        (0.60, 12, [0.078, 0.686, 0.207]),
        (0.917, 720, [0.0750, 0.8390, 0.0723]),
        (0.85, 720, [0.0752, 0.8120, 0.0952]),
        (0.60, 720, [0.0779, 0.6762, 0.2161]),
    ] {
        let ours = mean_energies(axis_ratio, turns);
        for (ours, exact) in ours.iter().zip(exact) {
            assert!((ours - exact).abs() < 1e-3, "{axis_ratio}: {ours} {exact}");
        }
    }
}

#[test]
fn half_a_turn_and_a_mirror_change_nothing() {
    let fibre = fibre(FibreSpec { absorption: Vec3::splat(0.3), ..white(1.5, 0.3, 0.3) });
    let (wo, wi) = (direction(0.3, 0.7), direction(-0.1, 2.9));
    let plain = HairBsdf::new(&fibre, wo, 0.4).evaluate(wi).f_cos;
    let turn = Vec3::new(-1.0, -1.0, 1.0);
    let mirror = Vec3::new(-1.0, 1.0, 1.0);
    let turned = HairBsdf::new(&fibre, wo * turn, 0.4).evaluate(wi * turn).f_cos;
    let mirrored = HairBsdf::new(&fibre, wo * mirror, -0.4).evaluate(wi * mirror).f_cos;
    assert!((turned / plain - Vec3::ONE).abs().max_element() < 1e-3);
    assert!((mirrored / plain - Vec3::ONE).abs().max_element() < 1e-3);
}

#[test]
fn turning_the_ellipse_turns_the_glint() {
    // What the material frame is for: the same light and eye, another orientation of d1.
    let fibre = fibre(white(1.6, 0.15, 0.15));
    let mean = |turn: f32| -> f32 {
        let (wo, wi) = (direction(0.0, turn), direction(0.0, turn + 0.6));
        let hs = (0..200_u8).map(|i| (f32::from(i) + 0.5) / 100.0 - 1.0);
        hs.map(|h| HairBsdf::new(&fibre, wo, h).evaluate(wi).f_cos.x).sum()
    };
    assert!(mean(0.0) / mean(FRAC_PI_2) > 1.5 || mean(FRAC_PI_2) / mean(0.0) > 1.5);
}

#[test]
fn is_finite_for_grazing_and_degenerate_hits() {
    let mut random = Random(4);
    let quarter = FRAC_PI_2;
    let thetas = [quarter, -quarter, quarter - 1e-4, -quarter + 1e-3, 0.0, 1.2];
    for axis_ratio in [0.2, 1.0, 1.2, 5.0] {
        for (beta, sigma) in [(0.01, 0.0), (1.0, 0.0), (0.3, 1e6)] {
            let fibre = fibre(FibreSpec {
                absorption: Vec3::new(sigma, 0.0, sigma),
                wetness: 0.5,
                ..white(axis_ratio, beta, beta)
            });
            for theta in thetas {
                for h in [-1.0, 1.0, 0.0, -0.999_999_9, 2.0, f32::NAN] {
                    let hit = HairBsdf::new(&fibre, direction(theta, 0.3), h);
                    let mut wis: Vec<_> = thetas.iter().map(|t| direction(*t, 1.0)).collect();
                    for _ in 0..8 {
                        let s = hit.sample(random.four());
                        assert!(s.weight.is_finite() && s.weight.max_element() <= 1.6);
                        wis.push(s.wi);
                    }
                    wis.extend([Vec3::Z, -Vec3::Z]);
                    for wi in wis {
                        let at = hit.evaluate(wi);
                        assert!(at.f_cos.is_finite() && at.pdf.is_finite(), "{theta} {h} {at:?}");
                        assert!(at.f_cos.min_element() >= 0.0 && at.pdf >= 0.0);
                    }
                }
            }
        }
    }
}

/// Width times mean of f over the offset: what reciprocity would have symmetric.
fn far_field(fibre: &Fibre, wo: Vec3, wi: Vec3) -> f64 {
    let hs = (0..100_u8).map(|i| (f32::from(i) + 0.5) / 50.0 - 1.0);
    let sum: f32 = hs.map(|h| HairBsdf::new(fibre, wo, h).evaluate(wi).f_cos.x).sum();
    f64::from(sum / 100.0 * fibre.half_width(wo) / wi.truncate().length())
}

/// Root mean square of the relative difference when light and eye are exchanged, weighed by f².
fn asymmetry(axis_ratio: f32, tilt: f32) -> f64 {
    let fibre = fibre(FibreSpec { tilt, ..white(axis_ratio, 0.3, 0.3) });
    let mut random = Random(5);
    let (mut difference, mut square) = (0.0, 0.0);
    for _ in 0..400 {
        let mut draw = || {
            let u = random.four();
            direction((u[0] - 0.5) * 1.5, u[1] * TAU)
        };
        let (w, v) = (draw(), draw());
        let (there, back) = (far_field(&fibre, w, v), far_field(&fibre, v, w));
        difference += (there - back).powi(2);
        square += there * back;
    }
    (difference / square).sqrt()
}

#[test]
fn how_far_it_is_from_reciprocal() {
    let (round, elliptic) = (asymmetry(1.0, 0.0), asymmetry(1.5, 0.0));
    let (tilted, both) = (asymmetry(1.0, 0.035), asymmetry(1.5, 0.035));
    // A bound on a known fault, with the documentation's numbers: 8, 13, 9 and 13 %.
    assert!(round < 0.09 && elliptic < 0.14 && tilted < 0.1 && both < 0.145);
}

#[test]
fn highlights_lie_where_scales_that_open_to_the_tip_turn_them() {
    // Light from across the fibre: R leaves to the root and the coloured TRT to the tip, as in table 1 of Marschner et al. 2003; the
    // lobes of the preview do the same.
    let tilt = 0.06;
    let round = |absorption| FibreSpec { tilt, absorption, ..white(1.0, 0.1, 0.3) };
    let brightest = |fibre: &Fibre, channel: usize| {
        let inclinations = (-200..=200).map(|i| f64::from(i) as f32 * 2e-3);
        let radiance = |theta: f32| {
            let hs = (0..40).map(|i| (i as f32 + 0.5) / 20.0 - 1.0);
            let of = |h| HairBsdf::new(fibre, direction(theta, 0.2), h).evaluate(Vec3::X);
            hs.map(|h| of(h).f_cos[channel]).sum::<f32>()
        };
        inclinations.max_by(|a, b| radiance(*a).total_cmp(&radiance(*b))).unwrap()
    };
    // Black hair has R alone.
    let r = brightest(&fibre(round(Vec3::splat(50.0))), 0);
    assert!((r + 2.0 * tilt).abs() < 0.01, "{r}");
    let white = brightest(&fibre(FibreSpec { axis_ratio: 1.0, ..round(Vec3::ZERO) }), 0);
    assert!(white > r, "TRT adds light on the side of the tip: {white}");
    let [preview_r, preview_tt, preview_trt] = LobeShape { tilt, ..Default::default() }.shifts();
    assert!((preview_r - r).abs() < 0.01 && preview_tt > 0.0 && preview_trt > 0.0);
}
