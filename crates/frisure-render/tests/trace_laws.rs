//! What holds for light whatever the picture.

use std::ops::ControlFlow;

use frisure_optics::Melanin;
use frisure_render::preview::Scene;
use frisure_render::trace::{TraceError, TraceOptions, render};
use frisure_render::{Background, Image, Lights, Look};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::Vec3;

/// A tuft of curls on a ball's upper half, some centimetres wide.
fn tuft() -> Strands {
    let mut strands = Strands::new();
    for i in 0..600_u16 {
        let (u, v) = (f32::from(i) * 0.618_034 % 1.0, f32::from(i) / 600.0);
        let (phi, z) = (std::f32::consts::TAU * u, 0.2 + 0.8 * v);
        let out = Vec3::new((1.0 - z * z).sqrt() * phi.cos(), (1.0 - z * z).sqrt() * phi.sin(), z);
        let across = out.any_orthonormal_vector();
        let point = |k: u16| {
            let s = f32::from(k) * 0.002;
            let turn = 900.0 * s + f32::from(i);
            let other = out.cross(across);
            out * (0.02 + s) + (across * turn.cos() + other * turn.sin()) * (0.2 * s)
        };
        let points: Vec<Vec3> = (0..16).map(point).collect();
        strands.push(&points, &[2e-4; 16]);
    }
    strands
}

fn look(melanin: Melanin) -> Look {
    let mut look = Look { background: Background::Transparent, ..Look::default() };
    look.hair.melanin = melanin;
    look.hair.variation = 0.0;
    look
}

fn drawn(strands: &Strands, look: Look, lights: Option<Lights>, options: TraceOptions) -> Image {
    let mut scene = Scene { look, ..Scene::portrait(strands, None) };
    scene.lights = lights.unwrap_or(scene.lights);
    render(&scene, &options, &|_| ControlFlow::Continue(())).unwrap()
}

const SMALL: TraceOptions =
    TraceOptions { width: 24, height: 24, samples: 32, noise: None, bounces: 1000, seed: 1 };

/// Mean light of what is covered.
fn mean(image: &Image) -> Vec3 {
    let sum = image.pixels().iter().fold([0.0_f64; 4], |mut sum, pixel| {
        for (sum, value) in sum.iter_mut().zip(pixel) {
            *sum += f64::from(*value);
        }
        sum
    });
    Vec3::new((sum[0] / sum[3]) as f32, (sum[1] / sum[3]) as f32, (sum[2] / sum[3]) as f32)
}

#[test]
fn white_hair_in_a_white_room_cannot_be_seen() {
    // White furnace: without absorption all light comes back, and is 1 everywhere.
    let room = Lights { lamps: Vec::new(), sky: Vec3::ONE, ground: Vec3::ONE };
    let image = drawn(&tuft(), look(Melanin::WHITE), Some(room), SMALL);
    let light = mean(&image);
    assert!((light - Vec3::ONE).abs().max_element() < 0.01, "{light}");
}

#[test]
fn pigment_only_takes_light_and_bounces_only_give_it() {
    let strands = tuft();
    let light = |melanin, bounces| {
        let options = TraceOptions { bounces, ..SMALL };
        mean(&drawn(&strands, look(melanin), None, options)).element_sum()
    };
    let shades = [Melanin::WHITE, Melanin::BLOND, Melanin::BROWN, Melanin::BLACK];
    let shades = shades.map(|melanin| light(melanin, 200));
    assert!(shades.windows(2).all(|pair| pair[1] < pair[0]), "{shades:?}");
    assert!(light(Melanin::WHITE, 3) < 0.95 * shades[0]);
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let strands = tuft();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawn(&strands, look(Melanin::BLOND), None, SMALL))
    };
    assert!(on(1) == on(3));
}

#[test]
fn impossible_pictures_are_refused_before_the_work() {
    let strands = tuft();
    let refused = |options: TraceOptions| {
        let scene = Scene::portrait(&strands, None);
        render(&scene, &options, &|_| ControlFlow::Continue(())).unwrap_err()
    };
    assert!(matches!(refused(TraceOptions { width: 0, ..SMALL }), TraceError::Size { .. }));
    assert!(matches!(refused(TraceOptions { height: 100_000, ..SMALL }), TraceError::Size { .. }));
    assert_eq!(refused(TraceOptions { samples: 0, ..SMALL }), TraceError::Samples { samples: 0 });
    let scene = Scene::portrait(&strands, None);
    let stopped = render(&scene, &SMALL, &|_| ControlFlow::Break(()));
    assert_eq!(stopped, Err(TraceError::Cancelled));
}

#[test]
fn flat_white_hair_cannot_be_seen_either_and_round_hair_needs_no_frame() {
    let room = || Some(Lights { lamps: Vec::new(), sky: Vec3::ONE, ground: Vec3::ONE });
    let with = |ratio: f32| {
        let mut strands = tuft();
        let directors = strands.points().iter().map(|p| p.any_orthonormal_vector().to_array());
        let d1 = AttributeValues::F32x3(directors.collect());
        let d1 = Attribute { name: "d1".into(), domain: Domain::Point, values: d1 };
        let values = AttributeValues::F32(vec![ratio; strands.len()]);
        let ratio = Attribute { name: "axis_ratio".into(), domain: Domain::Strand, values };
        strands.set_attribute(d1).unwrap();
        strands.set_attribute(ratio).unwrap();
        strands
    };
    for ratio in [0.6, 1.7] {
        let options = TraceOptions { samples: 128, ..SMALL };
        let light = mean(&drawn(&with(ratio), look(Melanin::WHITE), room(), options));
        assert!((light - Vec3::ONE).abs().max_element() < 0.01, "{ratio}: {light}");
    }
    let plain = mean(&drawn(&tuft(), look(Melanin::BLOND), None, SMALL));
    let round = mean(&drawn(&with(1.0), look(Melanin::BLOND), None, SMALL));
    assert!((plain - round).abs().max_element() < 0.03 * plain.max_element(), "{plain} {round}");
}
