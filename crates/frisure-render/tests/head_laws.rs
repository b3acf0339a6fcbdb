//! What holds for light on a head: skin, eyes, brows and lashes.

use frisure_look::{Background, Camera, Lights, Look, Melanin, SkinLook};
use frisure_render::preview::{self, PreviewOptions};
use frisure_render::trace::{TraceOptions, Tracer, render};
use frisure_render::{Image, Scene};
use frisure_strands::{AccessoryMaterial, AccessoryMesh, Eye, Features, Strands, Surface, Tint};
use glam::{DVec3, Vec3};

/// A ball of 8 cm with an eye of 1.2 cm in its front.
fn ball() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (rings, around) = (48_u32, 96_u32);
    let point = |i: u32, j: u32| {
        let polar = std::f64::consts::PI * f64::from(i) / f64::from(rings);
        let turn = std::f64::consts::TAU * f64::from(j) / f64::from(around);
        0.08 * DVec3::new(polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos())
    };
    let positions = (0..=rings).flat_map(|i| (0..around).map(move |j| point(i, j))).collect();
    let at = |i: u32, j: u32| i * around + j % around;
    let quads = (0..rings).flat_map(|i| (0..around).map(move |j| (i, j)));
    let faces = quads.flat_map(|(i, j)| {
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    });
    (positions, faces.collect())
}

fn skin() -> Surface {
    let (positions, faces) = ball();
    Surface::new(positions, faces).unwrap()
}

/// A hair that no picture of the ball shows.
fn hidden_hair() -> Strands {
    let mut strands = Strands::new();
    strands.push(&[Vec3::ZERO, Vec3::Z * 0.01], &[1e-5; 2]);
    strands
}

fn scene<'a>(strands: &'a Strands, surface: &'a Surface, skin: SkinLook) -> Scene<'a> {
    let camera = Camera::look_at(DVec3::new(0.0, -1.0, 0.0), DVec3::ZERO, DVec3::Z, 0.2).unwrap();
    let look = Look { skin, background: Background::Transparent, ..Look::default() };
    Scene {
        camera,
        look,
        lights: Lights::even(Vec3::ONE),
        ..Scene::portrait(strands, Some(surface))
    }
}

fn traced(scene: &Scene<'_>, width: usize, samples: usize) -> Image {
    let options = TraceOptions {
        width,
        height: width,
        samples,
        noise: None,
        bounces: 200,
        clamp: None,
        seed: 1,
    };
    render(scene, &options, &()).unwrap()
}

/// Mean light of what is covered.
fn mean(image: &Image) -> Vec3 {
    let sum = image.pixels().iter().fold([0.0_f64; 4], |mut sum, pixel| {
        sum.iter_mut().zip(pixel).for_each(|(sum, value)| *sum += f64::from(*value));
        sum
    });
    Vec3::new((sum[0] / sum[3]) as f32, (sum[1] / sum[3]) as f32, (sum[2] / sum[3]) as f32)
}

#[test]
fn white_skin_in_a_white_room_cannot_be_seen() {
    // White furnace: what goes beneath the skin and is not absorbed comes out again.
    let (surface, hair) = (skin(), hidden_hair());
    let light = |gloss, scatter| {
        let look = SkinLook { colour: Vec3::ONE, gloss, scatter, ..SkinLook::default() };
        mean(&traced(&scene(&hair, &surface, look), 24, 256))
    };
    for scatter in [1e-3, 3.7e-3] {
        let light = light(0.0, scatter);
        assert!((light - Vec3::ONE).abs().max_element() < 0.012, "{scatter}: {light}");
    }
    // A rough coat loses what its facets mirror into each other, a few hundredths, and gains nothing.
    let coated = light(0.12, 3.7e-3);
    assert!(coated.max_element() < 1.01 && coated.min_element() > 0.92, "{coated}");
}

#[test]
fn skin_that_scatters_is_as_light_as_skin_that_does_not() {
    let (surface, hair) = (skin(), hidden_hair());
    let light = |scatter| {
        let look = SkinLook { gloss: 0.0, scatter, ..SkinLook::default() };
        mean(&traced(&scene(&hair, &surface, look), 24, 512))
    };
    let ratio = light(3.7e-3) / light(0.0);
    assert!((ratio - Vec3::ONE).abs().max_element() < 0.01, "{ratio}");
}

fn preview(scene: &Scene<'_>) -> Image {
    let options = PreviewOptions { width: 96, height: 96, ..PreviewOptions::default() };
    preview::render(scene, &options, &()).unwrap()
}

/// The skin with two hundred hairs in front, of which some are lashes.
fn hairy(surface: &Surface, lashes: usize) -> Surface {
    let mut hairs = Strands::new();
    for i in 0..200_u16 {
        let x = -0.03 + 3e-4 * f32::from(i);
        hairs.push(&[Vec3::new(x, -0.081, 0.0), Vec3::new(x, -0.081, 0.02)], &[1e-4; 2]);
    }
    let features = Features { hairs, lashes, ..Features::default() };
    surface.clone().with_features(features).unwrap()
}

#[test]
fn lashes_are_darker_than_brows_and_stay_dark_on_a_white_head() {
    let (surface, hair) = (skin(), hidden_hair());
    let light = |lashes: usize, white_share: f32| {
        let surface = hairy(&surface, lashes);
        let mut scene = scene(&hair, &surface, SkinLook::default());
        (scene.look.hair.melanin, scene.look.hair.white_share) = (Melanin::BLOND, white_share);
        mean(&traced(&scene, 48, 64)).y
    };
    assert!(light(200, 0.0) < 0.99 * light(0, 0.0));
    assert!(light(200, 1.0) < 0.99 * light(0, 1.0));
    assert!((light(200, 1.0) / light(200, 0.0) - 1.0).abs() < 1e-3);
}

#[test]
fn the_layer_of_hair_has_no_brows() {
    let (surface, hair) = (skin(), hidden_hair());
    let surface = hairy(&surface, 100);
    let scene = scene(&hair, &surface, SkinLook::default());
    let options = TraceOptions { width: 48, height: 48, samples: 4, ..TraceOptions::default() };
    let tracer = Tracer::new(&scene, &options).unwrap();
    let mut accumulator = tracer.accumulator();
    tracer.accumulate(&mut accumulator, &()).unwrap();
    let layers = accumulator.layers();
    assert!(layers.hair.iter().all(|&hair| hair == 0.0) && layers.wisp.iter().all(|&w| w == 0));
}

#[test]
fn brows_are_in_both_pictures_and_in_no_hair() {
    let (surface, hair) = (skin(), hidden_hair());
    let with = hairy(&surface, 0);
    let look = SkinLook { colour: Vec3::splat(0.8), ..SkinLook::default() };
    let dark = |surface: &Surface, draw: &dyn Fn(&Scene<'_>) -> Image| {
        let mut scene = scene(&hair, surface, look);
        scene.look.hair.melanin = Melanin::BLACK;
        assert_eq!(scene.strands.len(), 1);
        mean(&draw(&scene)).y
    };
    for draw in [&preview as &dyn Fn(&Scene<'_>) -> Image, &|scene| traced(scene, 48, 32)] {
        assert!(dark(&with, draw) < 0.97 * dark(&surface, draw));
    }
}

#[test]
fn brows_are_as_wide_however_wide_other_hairs_are_drawn() {
    let (surface, hair) = (skin(), hidden_hair());
    let surface = hairy(&surface, 100);
    let scene = scene(&hair, &surface, SkinLook::default());
    let light = |width_scale: Option<f32>| {
        let options =
            PreviewOptions { width: 96, height: 96, width_scale, ..PreviewOptions::default() };
        mean(&preview::render(&scene, &options, &()).unwrap()).y
    };
    let own = light(Some(1.0));
    // A single hair stands for a whole head, and is drawn six times as wide.
    for width in [None, Some(6.0)] {
        assert!((light(width) / own - 1.0).abs() < 1e-3, "{width:?}: {} {own}", light(width));
    }
}

#[test]
fn an_eye_has_an_iris_in_both_pictures() {
    let (mut positions, mut faces) = ball();
    let first = positions.len() as u32;
    let centre = DVec3::new(0.0, -0.074, 0.0);
    let (eye, triangles) = ball();
    positions.extend(eye.iter().map(|p| centre + *p * (0.012 / 0.08)));
    faces.extend(triangles.iter().map(|t| t.map(|v| v + first)));
    let eye = Eye { centre, radius: 0.012, gaze: -DVec3::Y };
    let tints = vec![Tint::default(); positions.len()];
    let features = Features { tints, eyes: vec![eye], ..Features::default() };
    let surface = Surface::new(positions, faces).unwrap().with_features(features).unwrap();
    let hair = hidden_hair();
    let look = SkinLook { iris: Vec3::new(0.02, 0.05, 0.4), ..SkinLook::default() };
    let scene = scene(&hair, &surface, look);
    for image in [preview(&scene), traced(&scene, 96, 16)] {
        // 3 mm beside the middle of the pupil.
        let at = 48 * 96 + 49;
        let pixel = image.pixels()[at];
        assert!(pixel[2] > 1.5 * pixel[0], "{pixel:?}");
    }
}

#[test]
fn both_renderers_show_accessories_in_their_colours_and_not_as_skin() {
    let (strands, ball) = (hidden_hair(), skin());
    let colour = [0.05, 0.4, 0.1];
    let material = AccessoryMaterial { name: "felt", colour, gloss: 0.0, roughness: 1.0 };
    // A ball around that of the head hides it.
    let around = ball.positions().iter().map(|p| 1.2 * *p).collect();
    let around = Surface::new(around, ball.triangles().to_vec()).unwrap();
    let accessories = [AccessoryMesh { name: "cover_0".into(), material, surface: around }];
    let white = SkinLook { colour: Vec3::splat(0.8), gloss: 0.0, ..SkinLook::default() };
    let bare = scene(&strands, &ball, white);
    let covered = Scene { accessories: &accessories, ..bare.clone() };
    let middle = |image: &Image| Vec3::from_slice(&image.pixels()[16 * 32 + 16][..3]);
    let preview = |scene: &Scene<'_>| {
        let options = PreviewOptions { width: 32, height: 32, ..PreviewOptions::default() };
        middle(&preview::render(scene, &options, &()).unwrap())
    };
    for (name, shown) in
        [("traced", middle(&traced(&covered, 32, 64))), ("preview", preview(&covered))]
    {
        // In even light a matt surface has its colour.
        let apart = (shown - Vec3::from(colour)).abs().max_element();
        assert!(apart < 0.03, "{name}: {shown}");
    }
    assert!(preview(&bare).x > 0.5, "without the cover skin is seen");
}
