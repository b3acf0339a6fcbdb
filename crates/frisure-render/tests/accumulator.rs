//! Accumulators: checkpoints, resuming, noise, and layers beside light.

use std::sync::atomic::{AtomicUsize, Ordering};

use frisure_look::{Aperture, Background, Camera, CameraError, Floor};
use frisure_progress::{Progress, Until};
use frisure_render::Scene;
use frisure_render::trace::{
    Accumulator, AccumulatorError, Layers, TraceError, TraceOptions, Tracer,
};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands, Surface};
use glam::{DVec3, Vec3};

const SMALL: TraceOptions = TraceOptions {
    width: 40,
    height: 33,
    samples: 48,
    noise: None,
    bounces: 20,
    clamp: None,
    seed: 1,
};

/// Hairs along z side by side, 2 cm wide and 4 cm high, in the plane `y`; the right half is wisp 7.
fn curtain(y: f32) -> Strands {
    let mut strands = Strands::new();
    for i in 0..100_u8 {
        let x = 2e-4 * (f32::from(i) - 49.5);
        let points = [0.02, 0.0, -0.02].map(|z| Vec3::new(x, y, z));
        strands.push(&points, &[1.2e-4; 3]);
    }
    let wisps = (0..100_u32).map(|i| if i < 50 { 3 } else { 7 }).collect();
    let guide = Attribute {
        name: "guide".into(),
        domain: Domain::Strand,
        values: AttributeValues::U32(wisps),
    };
    strands.set_attribute(guide).unwrap();
    strands
}

/// A ball around the origin.
fn ball(radius: f64) -> Surface {
    let at = |i: u32, j: u32| {
        let (theta, phi) = (f64::from(i) / 16.0 * std::f64::consts::PI, f64::from(j) / 32.0);
        let (s, c) = (phi * std::f64::consts::TAU).sin_cos();
        radius * DVec3::new(theta.sin() * c, theta.sin() * s, theta.cos())
    };
    let positions = (0..=16).flat_map(|i| (0..32).map(move |j| at(i, j))).collect();
    let corner = |i: u32, j: u32| i * 32 + j % 32;
    let faces = (0..16).flat_map(|i| (0..32).map(move |j| (i, j))).flat_map(|(i, j)| {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Surface::new(positions, faces.collect()).unwrap()
}

fn scene<'a>(strands: &'a Strands, surface: Option<&'a Surface>) -> Scene<'a> {
    let mut scene = Scene::portrait(strands, surface);
    scene.camera = Camera::look_at(-DVec3::Y, DVec3::ZERO, DVec3::Z, 0.06).unwrap();
    scene
}

fn accumulate(tracer: &Tracer) -> Accumulator {
    let mut accumulator = tracer.accumulator();
    assert!(tracer.accumulate(&mut accumulator, &()).is_ok());
    accumulator
}

#[test]
fn a_picture_stopped_anywhere_resumes_to_the_same_bytes() {
    let strands = curtain(0.0);
    let tracer = Tracer::new(&scene(&strands, None), &SMALL).unwrap();
    let whole = accumulate(&tracer);
    let mut accumulator = tracer.accumulator();
    let mut stops = 0;
    loop {
        let tiles = AtomicUsize::new(0);
        let stop = || tiles.fetch_add(1, Ordering::Relaxed) >= 7;
        let end = tracer.accumulate(&mut accumulator, &Until { progress: &(), stop: &stop });
        accumulator = Accumulator::from_bytes(&accumulator.to_bytes()).unwrap();
        assert!(tracer.can_resume(&accumulator));
        assert!(accumulator.image().pixels().iter().flatten().all(|x| x.is_finite()));
        if end.is_ok() {
            break;
        }
        stops += 1;
    }
    assert!(stops > 4, "{stops}");
    assert!(accumulator == whole);
}

/// The fractions that were reported.
#[derive(Default)]
struct Seen(std::sync::Mutex<Vec<f64>>);

impl Progress for Seen {
    fn report(&self, _stage: &str, fraction: f64) {
        self.0.lock().unwrap().push(fraction);
    }

    fn is_cancelled(&self) -> bool {
        false
    }
}

#[test]
fn progress_ends_at_the_whole_and_never_goes_back() {
    let strands = curtain(0.0);
    let tracer = Tracer::new(&scene(&strands, None), &SMALL).unwrap();
    let seen = Seen::default();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut accumulator = tracer.accumulator();
    assert!(pool.install(|| tracer.accumulate(&mut accumulator, &seen)).is_ok());
    let seen = seen.0.into_inner().unwrap();
    assert!(seen.windows(2).all(|pair| pair[0] <= pair[1]));
    assert_eq!((seen.first(), seen.last()), (Some(&0.0), Some(&1.0)));
}

#[test]
fn bytes_that_were_cut_off_or_changed_are_no_checkpoint() {
    let strands = curtain(0.0);
    let options = TraceOptions { width: 5, height: 3, samples: 1, ..SMALL };
    let tracer = Tracer::new(&scene(&strands, None), &options).unwrap();
    let bytes = accumulate(&tracer).to_bytes();
    assert!(Accumulator::from_bytes(&bytes).is_ok());
    for length in 0..bytes.len() {
        assert!(Accumulator::from_bytes(&bytes[..length]).is_err(), "{length}");
    }
    for place in (0..bytes.len()).step_by(7) {
        let mut changed = bytes.clone();
        changed[place] ^= 0x10;
        assert!(Accumulator::from_bytes(&changed).is_err(), "{place}");
    }
    assert_eq!(Accumulator::from_bytes(b"a picture"), Err(AccumulatorError::Magic));
    // The header of the largest picture, with a good checksum, takes no memory for its pixels.
    let mut header = bytes[..16].to_vec();
    header.extend([8192_u32; 2].into_iter().flat_map(u32::to_le_bytes));
    let sum = frisure_digest::checksum(&header);
    header.extend(sum);
    assert_eq!(Accumulator::from_bytes(&header), Err(AccumulatorError::Damaged));
}

#[test]
fn another_picture_is_not_resumed() {
    let (strands, other) = (curtain(0.0), curtain(1e-4));
    let tracer =
        |strands: &'_ Strands, options| Tracer::new(&scene(strands, None), &options).unwrap();
    let accumulator = tracer(&strands, SMALL).accumulator();
    assert!(
        tracer(&strands, TraceOptions { samples: 4, noise: Some(0.1), ..SMALL })
            .can_resume(&accumulator)
    );
    assert!(!tracer(&other, SMALL).can_resume(&accumulator));
    assert!(!tracer(&strands, TraceOptions { seed: 2, ..SMALL }).can_resume(&accumulator));
    assert!(!tracer(&strands, TraceOptions { clamp: Some(1.0), ..SMALL }).can_resume(&accumulator));
    assert!(
        !tracer(&strands, TraceOptions { width: 33, height: 40, ..SMALL }).can_resume(&accumulator)
    );
    let mut scene = scene(&strands, None);
    scene.look.hair.melanin.eumelanin += 0.1;
    assert!(!Tracer::new(&scene, &SMALL).unwrap().can_resume(&accumulator));
}

#[test]
fn noise_falls_with_the_root_of_the_paths_and_is_what_two_pictures_differ_by() {
    let strands = curtain(0.0);
    let with = |samples, seed| {
        let options = TraceOptions { samples, seed, ..SMALL };
        accumulate(&Tracer::new(&scene(&strands, None), &options).unwrap())
    };
    let (few, many) = (with(16, 1).noise(), with(256, 1).noise());
    assert!(many < 0.4 * few && many > 0.1 * few, "{few} {many}");
    // Two pictures differ by √2 standard errors, on the display's scale: the root.
    let (a, b) = (with(64, 1), with(64, 2));
    let root = |e: &Accumulator| -> Vec<f32> {
        e.image().pixels().iter().flat_map(|p| [p[0], p[1], p[2]]).map(f32::sqrt).collect()
    };
    let (x, y) = (root(&a), root(&b));
    let square: f32 = x.iter().zip(&y).map(|(x, y)| (x - y).powi(2)).sum();
    let found = (0.5 * square / x.len() as f32).sqrt();
    let said = a.noise();
    assert!(found < 1.15 * said && found > 0.4 * said, "found {found}, said {said}");
}

#[test]
fn tiles_that_are_good_enough_get_no_more_paths() {
    let strands = curtain(0.0);
    let options = TraceOptions { samples: 400, noise: Some(0.02), ..SMALL };
    let accumulator = accumulate(&Tracer::new(&scene(&strands, None), &options).unwrap());
    assert!(accumulator.noise() <= 0.02, "{}", accumulator.noise());
    assert!(accumulator.mean_samples() < 390.0, "{}", accumulator.mean_samples());
    // Nothing but wall in the corner: there is no noise to wait for.
    let samples = accumulator.layers().samples;
    assert_eq!(samples[0], 32);
}

#[test]
fn layers_tell_what_is_seen() {
    let strands = curtain(0.0);
    let mut scene = scene(&strands, None);
    scene.look.background = Background::Transparent;
    let accumulator = accumulate(&Tracer::new(&scene, &SMALL).unwrap());
    let Layers { albedo, normal, tangent, depth, hair, wisp, samples } = accumulator.layers();
    let at = |x: usize, y: usize| y * SMALL.width + x;
    // The picture is 6 cm high and 7.3 cm wide: the curtain covers its middle.
    for (x, name) in [(17, 4), (22, 8)] {
        let i = at(x, 16);
        assert_eq!(wisp[i], name);
        assert!((hair[i] - 1.0).abs() < 1e-6);
        assert!((depth[i] - 1.0).abs() < 1e-3, "{}", depth[i]);
        assert!(Vec3::from(tangent[i]).distance(-Vec3::Z) < 1e-2);
        assert!(Vec3::from(normal[i]).normalize().dot(-Vec3::Y) > 0.95);
        assert!(albedo[i][0] > albedo[i][2] && albedo[i][2] > 0.0);
    }
    let corner = at(0, 0);
    assert_eq!((wisp[corner], hair[corner], depth[corner]), (0, 0.0, Layers::NOWHERE));
    assert_eq!((albedo[corner], tangent[corner], normal[corner]), ([0.0; 3], [0.0; 3], [0.0; 3]));
    assert!(samples.iter().all(|n| *n == 48));
    let image = accumulator.image();
    assert_eq!((image.pixel(0, 0)[3], image.pixel(17, 16)[3]), (0.0, 1.0));
}

#[test]
fn a_lens_blurs_what_is_not_in_its_focus() {
    let strands = curtain(0.0);
    // Coverage of what lies 4 mm to 8 mm beside the curtain.
    let beside = |aperture: Option<Aperture>| {
        let mut scene = scene(&strands, None);
        scene.look.background = Background::Transparent;
        if let Some(aperture) = aperture {
            scene.camera = scene.camera.with_aperture(aperture).unwrap();
        }
        let image = accumulate(&Tracer::new(&scene, &SMALL).unwrap()).image();
        (8..12).map(|x| image.pixel(x, 16)[3]).sum::<f32>()
    };
    assert!(beside(None) < 1e-3);
    let lens = |focus| Some(Aperture { radius: 0.02, focus });
    assert!(beside(lens(Some(1.0))) < 1e-3);
    assert!(beside(lens(None)) < 1e-3, "the nearest thing in the middle is sharp");
    assert!(beside(lens(Some(0.5))) > 0.1);
    let camera = Camera::default();
    for (radius, focus) in [(-0.1, None), (f64::NAN, None), (2.0, None), (0.01, Some(0.0))] {
        let refused = camera.with_aperture(Aperture { radius, focus });
        assert!(matches!(refused, Err(CameraError::Aperture { .. })));
    }
}

#[test]
fn a_floor_under_the_hair_catches_its_shadow() {
    let strands = curtain(0.0);
    let mut scene = scene(&strands, None);
    scene.camera =
        Camera::look_at(DVec3::new(0.0, -0.5, 0.3), DVec3::new(0.0, 0.0, -0.01), DVec3::Z, 0.3)
            .unwrap();
    let colour = Vec3::splat(0.5);
    let middle = DVec3::new(0.0, 0.0, -0.021);
    let light = |reach: f64, hair: bool| {
        let nothing = {
            let mut far = Strands::new();
            far.push(&[Vec3::new(0.0, 90.0, 0.0), Vec3::new(0.0, 91.0, 0.0)], &[1e-4; 2]);
            far
        };
        let mut scene = Scene { strands: if hair { &strands } else { &nothing }, ..scene.clone() };
        scene.look.floor = Some(Floor { centre: middle, radius: reach, colour });
        let options = TraceOptions { samples: 64, ..SMALL };
        accumulate(&Tracer::new(&scene, &options).unwrap()).image()
    };
    let sum = |image: &frisure_render::Image| image.pixels().iter().map(|p| p[1]).sum::<f32>();
    let (empty, shaded) = (light(5.0, false), light(5.0, true));
    assert!(sum(&shaded) < 0.99 * sum(&empty));
    // A floor outside the picture leaves the wall.
    let lost = light(1e-6, false);
    let wall = scene.look.background;
    let Background::Gradient { corner, .. } = wall else { unreachable!() };
    assert!((lost.pixel(0, 0)[1] / corner.y - 1.0).abs() < 0.1);
}

#[test]
fn impossible_scenes_are_refused_before_the_work() {
    let (nothing, strands, head) = (Strands::new(), curtain(-0.2), ball(0.1));
    let refused = |scene: &Scene<'_>, options| match Tracer::new(scene, &options) {
        Ok(_) => panic!("it was not refused"),
        Err(error) => error,
    };
    assert_eq!(refused(&scene(&nothing, None), SMALL), TraceError::NoHair);
    let scene = scene(&strands, Some(&head));
    assert!(Tracer::new(&scene, &SMALL).is_ok());
    let mut inside = scene.clone();
    inside.camera = Camera::look_at(DVec3::Y * 0.05, DVec3::ZERO, DVec3::Z, 0.5).unwrap();
    assert!(matches!(refused(&inside, SMALL), TraceError::Inside { .. }));
    let wide = TraceOptions { width: 16_384, height: 16_384, ..SMALL };
    assert!(matches!(refused(&scene, wide), TraceError::Pixels { .. }));
    for noise in [0.0, -1.0, f32::NAN] {
        let options = TraceOptions { noise: Some(noise), ..SMALL };
        assert!(matches!(refused(&scene, options), TraceError::Noise { .. }));
    }
    let mut thin = Strands::new();
    thin.push(&[Vec3::ZERO, Vec3::X], &[0.0; 2]);
    let scene = Scene { strands: &thin, surface: None, ..scene.clone() };
    assert!(matches!(refused(&scene, SMALL), TraceError::Accel(_)));
}
