//! What holds for light whatever the picture.

use frisure_look::Melanin;
use frisure_look::{
    AreaLight, Background, DistantLight, EnvironmentLight, EnvironmentMap, Lights, Look, PointLight,
};
use frisure_render::Image;
use frisure_render::Scene;
use frisure_render::trace::{TraceError, TraceOptions, render};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::{DVec3, Vec3};

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
    render(&scene, &options, &()).unwrap()
}

const SMALL: TraceOptions = TraceOptions {
    width: 24,
    height: 24,
    samples: 32,
    noise: None,
    bounces: 1000,
    clamp: None,
    seed: 1,
};

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
    let environment = Lights::even(Vec3::ONE);
    let options = TraceOptions { samples: 1024, ..SMALL };
    let image = drawn(&tuft(), look(Melanin::WHITE), Some(environment), options);
    let light = mean(&image);
    assert!((light - Vec3::ONE).abs().max_element() < 0.005, "{light}");
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
fn the_firefly_clamp_takes_light_that_was_scattered_twice_and_no_other() {
    let strands = tuft();
    let traced = |bounces, clamp| {
        let options = TraceOptions { bounces, clamp, ..SMALL };
        drawn(&strands, look(Melanin::WHITE), None, options)
    };
    // 1. Light that comes straight from a lamp over one fibre stays, and so does all light below a high clamp.
    assert!(traced(1, Some(1e-3)) == traced(1, None));
    assert!(traced(100, Some(1e6)) == traced(100, None));
    // 2. Paths are the same, so that a lower clamp leaves no pixel brighter; one of next to nothing leaves the light of one scattering.
    let all = [traced(100, None), traced(100, Some(0.5)), traced(100, Some(0.05))];
    for pair in all.windows(2) {
        let brighter = pair[0].pixels().iter().zip(pair[1].pixels());
        assert!(brighter.flat_map(|(a, b)| a.iter().zip(b)).all(|(a, b)| *b <= a + 1e-6));
    }
    let [whole, some, little] = all.each_ref().map(|image| mean(image).element_sum());
    assert!(some < 0.99 * whole && little < 0.8 * some, "{whole} {some} {little}");
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
        render(&scene, &options, &()).unwrap_err()
    };
    assert!(matches!(refused(TraceOptions { width: 0, ..SMALL }), TraceError::Size { .. }));
    assert!(matches!(refused(TraceOptions { height: 100_000, ..SMALL }), TraceError::Size { .. }));
    assert_eq!(refused(TraceOptions { samples: 0, ..SMALL }), TraceError::Samples { samples: 0 });
    let dark = TraceOptions { clamp: Some(0.0), ..SMALL };
    assert_eq!(refused(dark), TraceError::Clamp { clamp: 0.0 });
    let scene = Scene::portrait(&strands, None);
    let token = frisure_progress::CancellationToken::default();
    token.cancel();
    let stopped = render(&scene, &SMALL, &token);
    assert_eq!(stopped, Err(TraceError::Cancelled));
}

#[test]
fn flat_white_hair_cannot_be_seen_either_and_round_hair_needs_no_frame() {
    let environment = || Some(Lights::even(Vec3::ONE));
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
        let light = mean(&drawn(&with(ratio), look(Melanin::WHITE), environment(), options));
        assert!((light - Vec3::ONE).abs().max_element() < 0.01, "{ratio}: {light}");
    }
    // Narrow highlights of small lamps need many paths.
    let many = TraceOptions { samples: 512, ..SMALL };
    let plain = mean(&drawn(&tuft(), look(Melanin::BLOND), None, many));
    let round = mean(&drawn(&with(1.0), look(Melanin::BLOND), None, many));
    assert!((plain - round).abs().max_element() < 0.03 * plain.max_element(), "{plain} {round}");
}

/// The brightest pixel against the mean of those that are covered.
fn outlier(image: &Image) -> f32 {
    let light = |p: &[f32; 4]| p[0] + p[1] + p[2];
    image.pixels().iter().map(light).fold(0.0, f32::max) / mean(image).element_sum()
}

#[test]
fn small_bright_lights_leave_no_fireflies() {
    let strands = tuft();
    let options = TraceOptions { bounces: 40, samples: 96, ..SMALL };
    let lit = |lights| drawn(&strands, look(Melanin::BLOND), Some(lights), options);
    // One direction, and the same light from a small lamp, a place and a hot pixel that way.
    let (way, far) = (DVec3::new(0.4, -0.8, 0.5).normalize(), 6.0);
    let sun = DistantLight::new(way, Vec3::ONE, 0.0).unwrap();
    let point = PointLight::new(way * far, Vec3::splat((far * far) as f32)).unwrap();
    let area = AreaLight::disc(way * far, -way, 0.004, Vec3::ONE).unwrap();
    let radiance = 1.0 / area.form_factor(far) as f32;
    let area = AreaLight::disc(way * far, -way, 0.004, Vec3::splat(radiance)).unwrap();
    let (width, height) = (512_usize, 256_usize);
    let turn = 0.5 - (way.x).atan2(-way.y) / std::f64::consts::TAU;
    let [x, y] = [turn * width as f64, way.z.acos() / std::f64::consts::PI * height as f64];
    let row = y as usize as f64;
    let edge = |y: f64| (std::f64::consts::PI * y / height as f64).cos();
    let solid = std::f64::consts::TAU / width as f64 * (edge(row) - edge(row + 1.0));
    let mut pixels = vec![[0.0; 3]; width * height];
    pixels[row as usize * width + x as usize] = [(1.0 / solid) as f32; 3];
    let map = EnvironmentMap::new(width, height, pixels).unwrap();
    let map = Lights { lamps: Vec::new(), environment: EnvironmentLight::Map(map) };
    let one = |lamp| Lights { lamps: vec![lamp], ..Lights::dark() };

    let reference = lit(one(sun.into()));
    for (name, lights) in [("point", one(point.into())), ("area", one(area.into())), ("map", map)] {
        let image = lit(lights);
        let ratio = mean(&image) / mean(&reference);
        // The tuft is a hundredth as wide as the lamp is far.
        assert!((ratio - Vec3::ONE).abs().max_element() < 0.03, "{name}: {ratio}");
        let (worst, expected) = (outlier(&image), outlier(&reference));
        assert!(worst < 1.7 * expected, "{name}: {worst} {expected}");
    }
}

#[test]
fn a_bright_room_in_a_picture_is_the_room() {
    // The same even light, from a gradient and from a picture in which all are chosen alike.
    let strands = tuft();
    let options = TraceOptions { bounces: 40, samples: 128, ..SMALL };
    let lit = |lights| mean(&drawn(&strands, look(Melanin::BROWN), Some(lights), options));
    let map = EnvironmentMap::new(64, 32, vec![[0.5, 1.0, 2.0]; 64 * 32]).unwrap();
    let map = Lights { lamps: Vec::new(), environment: EnvironmentLight::Map(map) };
    let ratio = lit(map) / lit(Lights::even(Vec3::new(0.5, 1.0, 2.0)));
    assert!((ratio - Vec3::ONE).abs().max_element() < 0.015, "{ratio}");
}
