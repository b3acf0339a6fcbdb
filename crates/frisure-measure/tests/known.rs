//! Drawn curves whose radius and pitch are known.

use std::f64::consts::TAU;

use frisure_measure::{
    Abstention, Crop, Fibre, Hang, Measurement, Options, Outcome, Photo, PhotoError, Scale, draw,
    measure,
};
use frisure_rod::{Material, Section, TorsionConstant};

const WIDTH: usize = 400;
const HEIGHT: usize = 1200;

/// Pixels per metre: 10 px/mm.
const SCALE: f64 = 1e4;

fn options(hang: Hang) -> Options {
    let fibre = Fibre {
        section: Section::from_diameter(72e-6, 1.5).unwrap(),
        material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        spread: 0.1,
    };
    Options { scale: Scale::new(SCALE).unwrap(), hang, fibre, length: None }
}

/// Dark lines of about three pixels on light paper, with a little noise.
fn drawn(curves: &[Box<dyn Fn(f64) -> f64>]) -> Vec<u8> {
    let mut grey = vec![0.8_f64; WIDTH * HEIGHT];
    for curve in curves {
        for i in 0..20 * (HEIGHT as i32 - 100) {
            let y = 50.0 + f64::from(i) / 20.0;
            let x = 0.5 * WIDTH as f64 + curve(y - 50.0);
            for v in (y as usize).saturating_sub(3)..(y as usize + 5).min(HEIGHT) {
                for u in (x as usize).saturating_sub(3)..(x as usize + 5).min(WIDTH) {
                    let square = (u as f64 - x).powi(2) + (v as f64 - y).powi(2);
                    let pixel = &mut grey[v * WIDTH + u];
                    *pixel = pixel.min(0.8 - 0.6 * (-0.5 * square).exp());
                }
            }
        }
    }
    let noise = |i: usize| ((i * 7919 + i / 31 * 104_729) % 11) as f64 - 5.0;
    let byte = |(i, x): (usize, &f64)| [(255.0 * x + noise(i)) as u8; 3];
    grey.iter().enumerate().flat_map(byte).collect()
}

fn looked_at(rgb: &[u8], hang: Hang) -> Outcome {
    let photo = Photo::new(WIDTH, HEIGHT, rgb, None).unwrap();
    measure(&photo, &options(hang), &()).unwrap()
}

fn measured(rgb: &[u8]) -> Measurement {
    looked_at(rgb, Hang::None).result.unwrap()
}

fn near(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found} in place of {expected}");
}

#[test]
fn a_drawn_sine_has_its_amplitude_and_wavelength() {
    for (radius, pitch) in [(40.0, 160.0), (12.0, 45.0), (60.0, 400.0), (25.0, 60.0)] {
        let curve = move |z: f64| radius * (TAU * z / pitch + 0.4).cos();
        let found = measured(&drawn(&[Box::new(curve)]));
        near(found.apparent_radius.value * SCALE, radius, 0.015);
        near(found.apparent_pitch.value * SCALE, pitch, 0.01);
        assert_eq!(found.natural, Some([found.apparent_radius, found.apparent_pitch]));
    }
}

#[test]
fn a_tilted_axis_changes_neither() {
    let (radius, pitch, tilt) = (30.0, 120.0, 0.08_f64);
    // A point of the turned curve: z along the axis from x = 0.
    let curve = move |y: f64| {
        let mut z = y;
        for _ in 0..50 {
            let off = radius * (TAU * z / pitch).cos();
            z = (y + off * tilt.sin()) / tilt.cos();
        }
        z * tilt.sin() + radius * (TAU * z / pitch).cos() * tilt.cos() - 40.0
    };
    let found = measured(&drawn(&[Box::new(curve)]));
    near(found.apparent_radius.value * SCALE, radius, 0.02);
    near(found.apparent_pitch.value * SCALE, pitch, 0.01);
    assert!((found.tilt - tilt).abs() < 0.005, "{}", found.tilt);
}

#[test]
fn phases_that_differ_do_not_make_a_lock_narrower() {
    let (radius, pitch) = (35.0, 180.0);
    let curves = (0..9).map(|i| {
        let phase = 0.4 * (f64::from(i) / 4.0 - 1.0) * 1.5;
        Box::new(move |z: f64| radius * (TAU * z / pitch + phase).cos()) as Box<dyn Fn(f64) -> f64>
    });
    let found = measured(&drawn(&curves.collect::<Vec<_>>()));
    near(found.apparent_pitch.value * SCALE, pitch, 0.01);
    // Lines that cover each other leave an error, and the error bar has it.
    let estimate = found.apparent_radius;
    near(estimate.value * SCALE, radius, 0.1);
    assert!(
        (estimate.value * SCALE - radius).abs() < 2.5 * estimate.deviation * SCALE,
        "{found:?}"
    );
    // The middle line has lost more: its amplitude is that of the mean of the phases.
    assert!(found.cues.line < estimate.value, "{}", found.cues.line);
}

#[test]
fn weight_narrows_and_lengthens_what_hangs() {
    let curve = |z: f64| 40.0 * (TAU * z / 200.0).cos();
    let found = looked_at(&drawn(&[Box::new(curve)]), Hang::Down).result.unwrap();
    let [radius, pitch] = found.natural.unwrap();
    assert!(radius.value > found.apparent_radius.value, "{found:?}");
    assert!(pitch.value < found.apparent_pitch.value, "{found:?}");
}

#[test]
fn what_cannot_be_told_has_a_reason() {
    let of = |curve: Box<dyn Fn(f64) -> f64>| looked_at(&drawn(&[curve]), Hang::Down).result.err();
    let straight = of(Box::new(|z| 0.01 * z));
    assert!(matches!(straight, Some(Abstention::Straight { .. })), "{straight:?}");
    let arc = of(Box::new(|z| 100.0 * (TAU * z / 1600.0).sin() - 50.0));
    assert!(matches!(arc, Some(Abstention::FewWaves { .. })), "{arc:?}");
    let small = of(Box::new(|z| 2.0 * (TAU * z / 60.0).sin()));
    assert!(
        matches!(small, Some(Abstention::Coarse { .. } | Abstention::Straight { .. })),
        "{small:?}"
    );
    let plain = looked_at(&vec![200; 3 * WIDTH * HEIGHT], Hang::Down).result.err();
    assert_eq!(plain, Some(Abstention::NoHair));
    let noise = |i: usize| ((i * i * 31 + i * 7919) % 251) as u8;
    let noise: Vec<u8> = (0..3 * WIDTH * HEIGHT).map(noise).collect();
    assert!(looked_at(&noise, Hang::Down).result.is_err());
    let two: Vec<Box<dyn Fn(f64) -> f64>> = [-120.0, 120.0]
        .map(|x| Box::new(move |z: f64| x + 20.0 * (z / 20.0).sin()) as Box<dyn Fn(f64) -> f64>)
        .into();
    let several = looked_at(&drawn(&two), Hang::Down).result.err();
    assert!(matches!(several, Some(Abstention::Several { .. })), "{several:?}");
}

#[test]
fn a_length_that_cannot_be_is_told() {
    let curve = |z: f64| 40.0 * (TAU * z / 200.0).cos();
    let rgb = drawn(&[Box::new(curve)]);
    let photo = Photo::new(WIDTH, HEIGHT, &rgb, None).unwrap();
    let found = |options: Options| measure(&photo, &options, &()).unwrap().result;
    // 11 cm of picture; 17 cm of hair, if it winds as a helix.
    for (length, refused) in [(0.05, true), (0.2, false)] {
        let result = found(Options { length: Some(length), ..options(Hang::Down) });
        assert_eq!(matches!(result, Err(Abstention::Short { .. })), refused, "{result:?}");
    }
    // Millimetres for each pixel in place of pixels for each millimetre.
    let scale = Scale::parse("10 mm/px").unwrap();
    let result = found(Options { scale, ..options(Hang::None) });
    assert!(matches!(result, Err(Abstention::Scale { .. })), "{result:?}");
}

#[test]
fn photos_are_checked_and_cropped() {
    let rgb = vec![0; 3 * 64 * 48];
    let crop = |x, y, width, height| Photo::new(64, 48, &rgb, Some(Crop { x, y, width, height }));
    assert_eq!(crop(10, 4, 40, 40).map(|p| p.width()), Ok(40));
    assert!(matches!(crop(40, 0, 40, 40), Err(PhotoError::Crop { .. })));
    assert!(matches!(crop(usize::MAX, 0, 40, 40), Err(PhotoError::Crop { .. })));
    assert!(matches!(crop(0, 0, 31, 40), Err(PhotoError::Small { .. })));
    for (width, height) in [(0, 0), (1, 1), (64, 47), (usize::MAX, usize::MAX)] {
        assert!(Photo::new(width, height, &rgb, None).is_err());
    }
    // A photo of 24 megapixels is reduced.
    let large = Photo::new(6000, 4000, &vec![128; 3 * 6000 * 4000], None).unwrap();
    assert_eq!((large.reduction(), large.width(), large.height()), (3, 2000, 1333));
}

#[test]
fn a_larger_photo_of_the_same_lock_has_the_same_curl() {
    let curve = |z: f64| 40.0 * (TAU * z / 160.0).cos();
    let small = drawn(&[Box::new(curve)]);
    let n = 3;
    let mut rgb = Vec::with_capacity(small.len() * n * n);
    for y in 0..HEIGHT * n {
        for x in 0..WIDTH * n {
            let at = 3 * ((y / n) * WIDTH + x / n);
            rgb.extend_from_slice(&small[at..at + 3]);
        }
    }
    let photo = Photo::new(WIDTH * n, HEIGHT * n, &rgb, None).unwrap();
    let scale = Scale::new(SCALE * n as f64).unwrap();
    let options = Options { scale, ..options(Hang::None) };
    let outcome = measure(&photo, &options, &()).unwrap();
    let found = outcome.result.unwrap();
    near(found.apparent_radius.value * SCALE, 40.0, 0.02);
    near(found.apparent_pitch.value * SCALE, 160.0, 0.01);
    // The lines lie on the photo as it was given.
    draw(WIDTH * n, &mut rgb, &outcome.drawing);
    let bright = rgb.chunks_exact(3).filter(|p| p[0] == 255 && p[2] == 160).count();
    assert!(bright > 1000, "{bright}");
}
