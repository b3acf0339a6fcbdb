//! The elliptical fibre against rays followed one by one through a dielectric cylinder.

mod support;

use std::f64::consts::{PI, TAU};

use frisure_optics::scattering::{Fibre, FibreSpec, HairBsdf};
use glam::DVec3;
use support::{Random, direction, follow, meet, white};

const BINS: usize = 72;

/// Shares of light by azimuth, of R, TT, TRT together and of the rest.
struct Shares {
    early: [f64; BINS],
    rest: f64,
}

fn bin(azimuth: f64) -> usize {
    (((azimuth / TAU).rem_euclid(1.0) * BINS as f64) as usize).min(BINS - 1)
}

/// By following `count` rays; `blur` turns what comes out and `tilt` the normals (rad).
fn traced(
    spec: &FibreSpec,
    (theta, phi): (f64, f64),
    count: u32,
    mut blur: impl FnMut(&mut Random) -> f64,
    tilt: f64,
) -> Shares {
    let ratio = f64::from(spec.axis_ratio).sqrt();
    let axes = (ratio, 1.0 / ratio);
    let eye = DVec3::new(theta.cos() * phi.cos(), theta.cos() * phi.sin(), theta.sin());
    let (mut shares, mut random) = (Shares { early: [0.0; BINS], rest: 0.0 }, Random(7));
    let mut left = 0.0;
    for i in 0..count {
        let h = 2.0 * (f64::from(i) + random.next()) / f64::from(count) - 1.0;
        let ray = (meet(axes, eye, h), -eye);
        let exit = follow(axes, f64::from(spec.index), ray, &mut random, |r| tilt * r.normal());
        let Some(exit) = exit else { continue };
        left += 1.0;
        if exit.ways > 2 {
            shares.rest += 1.0;
        } else {
            let azimuth = exit.to.y.atan2(exit.to.x) + blur(&mut random);
            shares.early[bin(azimuth)] += 1.0;
        }
    }
    shares.early.iter_mut().for_each(|e| *e /= left);
    shares.rest /= left;
    shares
}

/// By the model: f cos integrated over inclinations, mean over offsets.
fn modelled(spec: &FibreSpec, (theta, phi): (f64, f64)) -> Shares {
    let fibre = Fibre::new(*spec).unwrap();
    let mut shares = Shares { early: [0.0; BINS], rest: 0.0 };
    let (offsets, steps, fine) = (200_u16, 20_u16, 2_u16);
    for i in 0..offsets {
        let h = 2.0 * (f32::from(i) + 0.5) / f32::from(offsets) - 1.0;
        let hit = HairBsdf::new(&fibre, direction(theta as f32, phi as f32), h);
        let rest = f64::from(hit.energies()[3].x) / f64::from(offsets);
        shares.rest += rest;
        for j in 0..BINS as u16 * fine {
            let azimuth = TAU * (f64::from(j) + 0.5) / (BINS as f64 * f64::from(fine));
            let mut sum = 0.0;
            for k in 0..steps {
                // In sin θ, dω = d(sin θ) dφ.
                let z = 2.0 * (f32::from(k) + 0.5) / f32::from(steps) - 1.0;
                sum += f64::from(hit.evaluate(direction(z.asin(), azimuth as f32)).f_cos.x);
            }
            let cell = 2.0 / f64::from(steps) * TAU / (BINS as f64 * f64::from(fine));
            shares.early[bin(azimuth)] += sum * cell / f64::from(offsets);
        }
    }
    shares.early.iter_mut().for_each(|e| *e -= shares.rest / BINS as f64);
    shares
}

/// Share of the light that would have to move for one to become the other.
fn apart(a: &Shares, b: &Shares) -> f64 {
    let early: f64 = a.early.iter().zip(&b.early).map(|(a, b)| (a - b).abs()).sum();
    0.5 * (early + (a.rest - b.rest).abs())
}

/// Wide along the fibre, so that the sum over inclinations is easy: it does not matter here.
fn spec(axis_ratio: f32, beta_n: f32) -> FibreSpec {
    FibreSpec { tilt: 0.0, ..white(axis_ratio, 0.8, beta_n) }
}

/// Logistic scale of β_N = 0.3 and its trimmed distribution.
fn logistic(random: &mut Random) -> f64 {
    let s = (PI / 8.0).sqrt() * (0.265 * 0.3 + 1.194 * 0.09);
    let u = random.next().max(1e-12);
    (-s * (1.0 / u - 1.0).ln()).clamp(-PI, PI)
}

#[test]
fn azimuths_of_a_smooth_ellipse_blurred_are_the_model() {
    for (axis_ratio, theta, phi) in
        [(1.0, 0.0, 0.3), (1.4, 0.0, 0.3), (0.6, 0.0, 1.2), (1.4, 0.6, 2.0), (0.7, -1.0, 0.1)]
    {
        let spec = spec(axis_ratio, 0.3);
        let ours = modelled(&spec, (theta, phi));
        let exact = traced(&spec, (theta, phi), 120_000, logistic, 0.0);
        let apart = apart(&ours, &exact);
        // The noise of the rays alone is about 0.008.
        assert!(apart < 0.012, "{axis_ratio} {theta}: {apart}");
        assert!((ours.rest - exact.rest).abs() < 2e-3, "{axis_ratio} {theta}");
    }
}

#[test]
fn azimuths_of_a_slightly_rough_ellipse_are_near_the_model() {
    // Normals turned by `tilt` (rad, standard deviation) at every meeting blur R, TT and TRT
    // differently; the model has one β_N for all.
    for (beta, tilt, most) in [(0.1, 0.03, 0.025), (0.2, 0.07, 0.05), (0.3, 0.1, 0.08)] {
        for (axis_ratio, phi) in [(1.0, 0.3), (1.4, 0.3), (0.7, 1.2)] {
            let spec = spec(axis_ratio, beta);
            let ours = modelled(&spec, (0.0, phi));
            let exact = traced(&spec, (0.0, phi), 60_000, |_| 0.0, tilt);
            let apart = apart(&ours, &exact);
            assert!(apart < most, "{beta} {tilt} {axis_ratio}: {apart}");
        }
    }
}

#[test]
fn a_ray_at_a_known_place_leaves_where_the_model_says() {
    let mut random = Random(9);
    for (axis_ratio, phi, h) in
        [(1.0, 0.5_f64, 0.4), (1.4, 0.5, 0.4), (0.7, 2.0, -0.3), (1.2, -1.0, 0.7)]
    {
        let fibre = Fibre::new(spec(axis_ratio, 0.1)).unwrap();
        let ratio = f64::from(axis_ratio).sqrt();
        let eye = DVec3::new(phi.cos(), phi.sin(), 0.0);
        let at = meet((ratio, 1.0 / ratio), eye, h);
        let wo = eye.as_vec3();
        assert!((f64::from(fibre.offset(wo, at.truncate().as_vec2())) - h).abs() < 1e-5);
        let hit = HairBsdf::new(&fibre, wo, h as f32);
        let mut seen = [false; 3];
        for _ in 0..2000 {
            let axes = (ratio, 1.0 / ratio);
            let exit = follow(axes, 1.55, (at, -eye), &mut random, |_| 0.0).unwrap();
            if exit.ways > 2 || std::mem::replace(&mut seen[exit.ways], true) {
                continue;
            }
            let azimuth = exit.to.y.atan2(exit.to.x) as f32;
            let [left, top, right] =
                [-0.05, 0.0, 0.05].map(|turn| hit.evaluate(direction(0.0, azimuth + turn)).f_cos.x);
            assert!(top > left && top > right, "{axis_ratio} {}: {left} {top} {right}", exit.ways);
        }
        assert_eq!(seen, [true; 3]);
    }
}
