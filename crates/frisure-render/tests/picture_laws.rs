//! What must be true of any picture.

use frisure_look::{
    AreaLight, Background, Camera, Daylight, DistantLight, EnvironmentLight, EnvironmentMap,
    Lights, PointLight, Setup,
};
use frisure_progress::Progress;
use frisure_render::Image;
use frisure_render::preview::{PreviewError, PreviewOptions, render};
use frisure_render::{Scene, framed_bounds};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands, Surface};
use glam::{DVec3, Vec3};

const SMALL: PreviewOptions =
    PreviewOptions { width: 160, height: 120, samples: 4, width_scale: Some(1.0) };

/// A camera 1 m in front of the origin that sees ±0.1 m of height.
fn camera() -> Camera {
    Camera::look_at(-DVec3::Y, DVec3::ZERO, DVec3::Z, 2.0 * 0.1_f64.atan()).unwrap()
}

fn scene<'a>(strands: &'a Strands, surface: Option<&'a Surface>) -> Scene<'a> {
    let mut scene = Scene::portrait(strands, surface);
    scene.camera = camera();
    scene.lights = Lights::studio(&scene.camera);
    scene.look.background = Background::Transparent;
    scene
}

fn draw(scene: &Scene<'_>) -> Image {
    render(scene, &SMALL, &()).unwrap()
}

fn strand(from: Vec3, to: Vec3, radius: f32) -> Strands {
    let mut strands = Strands::new();
    strands.push(&[from, from.midpoint(to), to], &[radius; 3]);
    strands
}

/// `rows` hairs along x, one above the other, at `y`.
fn curtain(into: &mut Strands, rows: u8, y: f32, spacing: f32) {
    for i in 0..rows {
        let z = (f32::from(i) - 0.5 * f32::from(rows)) * spacing;
        let at = |x: f32| Vec3::new(x, y, z);
        into.push(&[at(-0.08), at(0.0), at(0.08)], &[1e-4; 3]);
    }
}

/// A wall 0.12 m wide and high across the view at `y`.
fn wall(y: f64) -> Surface {
    let corners = [(-0.06, -0.06), (0.06, -0.06), (0.06, 0.06), (-0.06, 0.06)];
    let positions = corners.map(|(x, z)| DVec3::new(x, y, z)).to_vec();
    Surface::new(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap()
}

fn coverage(image: &Image) -> f32 {
    image.pixels().iter().map(|p| p[3]).sum()
}

fn light(image: &Image) -> f32 {
    image.pixels().iter().map(|p| p[0] + p[1] + p[2]).sum()
}

#[test]
fn a_strand_covers_its_projected_area() {
    // Pixels are 0.2 m / 120 at the origin's distance.
    let pixel = 0.2 / 120.0;
    for (degrees, radius) in [(0.0_f32, 5e-5_f32), (13.0, 5e-5), (45.0, 2e-4), (81.0, 1e-3)] {
        let (s, c) = degrees.to_radians().sin_cos();
        let tip = 0.05 * Vec3::new(c, 0.0, s);
        let strands = strand(-tip, tip, radius);
        let covered = coverage(&draw(&scene(&strands, None)));
        let expected = 0.1 * 2.0 * radius / (pixel * pixel);
        assert!((covered / expected - 1.0).abs() < 0.03, "{degrees}: {covered} {expected}");
    }
}

#[test]
fn width_scale_multiplies_the_area() {
    let strands = strand(Vec3::X * -0.05, Vec3::X * 0.05, 2e-5);
    let scene = scene(&strands, None);
    let with = |s| PreviewOptions { width_scale: Some(s), ..SMALL };
    let area = |s| coverage(&render(&scene, &with(s), &()).unwrap());
    assert!((area(3.0) / area(1.0) - 3.0).abs() < 0.02);
}

#[test]
fn without_anything_the_picture_is_the_background() {
    let nothing = Strands::new();
    let mut scene = scene(&nothing, None);
    assert!(draw(&scene).pixels().iter().all(|p| *p == [0.0; 4]));
    let grey = Vec3::splat(0.25);
    scene.look.background = Background::Gradient { centre: grey, corner: grey };
    assert!(draw(&scene).pixels().iter().all(|p| *p == [0.25, 0.25, 0.25, 1.0]));
}

#[test]
fn surroundings_are_seen_where_they_are() {
    let strands = Strands::new();
    let mut scene = scene(&strands, None);
    scene.look.background = Background::Environment;
    scene.lights = Lights::overcast();
    let image = draw(&scene);
    assert!(image.pixels().iter().all(|p| p[3] == 1.0));
    let (width, height) = (image.width(), image.height());
    let tan = (0.5 * scene.camera.vertical_fov()).tan();
    for (x, y) in [(0, 0), (width - 1, 0), (width / 2, height - 1)] {
        let slope = |i: usize, of: usize| (2.0 * i as f64 + 1.0) / of as f64 - 1.0;
        let across = slope(x, width) * tan * width as f64 / height as f64 * scene.camera.right();
        let towards = scene.camera.forward() + across - slope(y, height) * tan * scene.camera.up();
        let seen = Vec3::from_slice(&image.pixel(x, y)[..3]);
        let there = scene.lights.environment.radiance(towards.normalize().as_vec3());
        assert!((seen - there).abs().max_element() < 0.02 * there.y, "{seen} {there}");
    }
}

#[test]
fn strands_that_are_no_curves_change_nothing() {
    let mut strands = strand(Vec3::X * -0.05, Vec3::X * 0.05, 1e-4);
    let clean = strands.clone();
    strands.push(&[], &[]);
    strands.push(&[Vec3::ZERO], &[1.0]);
    strands.push(&[Vec3::NAN, Vec3::X], &[1e-3; 2]);
    strands.push(&[Vec3::ZERO, Vec3::X], &[f32::NAN; 2]);
    strands.push(&[Vec3::ZERO, Vec3::INFINITY], &[1e-3; 2]);
    assert_eq!(draw(&scene(&strands, None)), draw(&scene(&clean, None)));
    let (low, high) = framed_bounds(&strands, None);
    assert!(low.is_finite() && high.is_finite());
}

#[test]
fn degenerate_strands_draw_finite_light() {
    let mut strands = Strands::new();
    strands.push(&[Vec3::ZERO; 4], &[1e-4; 4]);
    strands.push(&[Vec3::ZERO, Vec3::X * 0.01, Vec3::ZERO, Vec3::X * 0.01], &[1e-4; 4]);
    strands.push(&[Vec3::Y * -3.0, Vec3::Y * 3.0], &[1e-4; 2]); // through the eye
    strands.push(&[Vec3::ZERO, Vec3::Z * 0.05], &[-1.0; 2]);
    let image = draw(&scene(&strands, None));
    assert!(image.pixels().iter().flatten().all(|c| c.is_finite() && *c >= 0.0));
}

#[test]
fn the_head_hides_hair_behind_it_and_not_before_it() {
    let nothing = Strands::new();
    let (head, mut hair) = (wall(0.0), Strands::new());
    curtain(&mut hair, 40, 0.03, 5e-4);
    // No lamps, or hair behind would still cast its shadow.
    let dark = |strands: &'_ Strands| {
        let mut scene = scene(strands, Some(&head));
        scene.lights = Lights::even(Vec3::ONE);
        draw(&scene)
    };
    let pixel = |image: &Image| image.pixel(80, 60);
    let (bare, behind) = (dark(&nothing), dark(&hair));
    assert_eq!(pixel(&bare)[3], 1.0);
    assert!((pixel(&bare)[0] - pixel(&behind)[0]).abs() < 0.05 * pixel(&bare)[0]);
    let mut before = Strands::new();
    curtain(&mut before, 40, -0.03, 5e-4);
    assert!(pixel(&dark(&before))[0] < 0.9 * pixel(&bare)[0]);
    // Beside the wall, the same hair is seen.
    assert!(behind.pixel(25, 60)[3] < 0.01 && behind.pixel(38, 60)[3] > 0.2);
}

#[test]
fn hair_between_a_lamp_and_hair_makes_it_darker() {
    let lit = |layers: u8| {
        let mut strands = Strands::new();
        curtain(&mut strands, 60, 0.0, 1e-3);
        for layer in 0..layers {
            curtain(&mut strands, 60, 0.02 + 0.01 * f32::from(layer), 5e-4);
        }
        let mut scene = scene(&strands, None);
        let lamp = DistantLight::new(DVec3::Y, Vec3::splat(3.0), 0.0).unwrap();
        scene.lights = Lights { lamps: vec![lamp.into()], ..Lights::dark() };
        let image = draw(&scene);
        // Of the first curtain only: the camera sees it before the others.
        image.pixel(80, 60)[0] / image.pixel(80, 60)[3]
    };
    let levels = [lit(0), lit(1), lit(3), lit(6)];
    for pair in levels.windows(2) {
        assert!(pair[1] < 0.9 * pair[0], "{levels:?}");
    }
}

#[test]
fn more_pigment_is_darker() {
    let mut strands = Strands::new();
    curtain(&mut strands, 60, 0.0, 5e-4);
    let tinted = |factor: f32| {
        let mut strands = strands.clone();
        let values = AttributeValues::F32(vec![factor; 60]);
        let tint = Attribute { name: "tint".into(), domain: Domain::Strand, values };
        strands.set_attribute(tint).unwrap();
        light(&draw(&scene(&strands, None)))
    };
    assert!(tinted(2.0) < tinted(1.0) && tinted(1.0) < tinted(0.5));
}

#[test]
fn wet_hair_is_darker_under_the_room() {
    let mut dry = Strands::new();
    curtain(&mut dry, 60, 0.0, 5e-4);
    let mut wet = dry.clone();
    let values = AttributeValues::F32(vec![1.0; 180]);
    let wetness = Attribute { name: "wetness".into(), domain: Domain::Point, values };
    wet.set_attribute(wetness).unwrap();
    let lit = |strands: &'_ Strands| {
        let mut scene = scene(strands, None);
        scene.lights.lamps.clear();
        light(&draw(&scene))
    };
    assert!(lit(&wet) < 0.95 * lit(&dry));
}

#[test]
fn the_picture_is_the_same_on_any_number_of_threads() {
    let (mut strands, head) = (Strands::new(), wall(0.01));
    for layer in 0..12_u8 {
        curtain(&mut strands, 200, 0.004 * f32::from(layer) - 0.02, 4e-4);
    }
    let scene = scene(&strands, Some(&head));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| draw(&scene)).to_srgb8()
    };
    let one = on(1);
    assert!(one == on(2) && one == on(5));
}

/// The fractions that were reported; cancels when one exceeds a limit.
#[derive(Default)]
struct Seen {
    limit: f64,
    fractions: std::sync::Mutex<Vec<f64>>,
}

impl Progress for Seen {
    fn report(&self, _stage: &str, fraction: f64) {
        self.fractions.lock().unwrap().push(fraction);
    }

    fn is_cancelled(&self) -> bool {
        self.fractions.lock().unwrap().iter().any(|done| *done > self.limit)
    }
}

#[test]
fn the_caller_can_stop_and_sizes_are_checked() {
    let strands = strand(Vec3::X * -0.05, Vec3::X * 0.05, 1e-4);
    let scene = scene(&strands, None);
    let stop_at = |limit: f64| render(&scene, &SMALL, &Seen { limit, ..Seen::default() });
    for limit in [-1.0, 0.2, 0.7] {
        assert_eq!(stop_at(limit), Err(PreviewError::Cancelled));
    }
    assert!(stop_at(2.0).is_ok());
    for (width, height) in [(0, 10), (10, 0), (1 << 20, 10)] {
        let options = PreviewOptions { width, height, ..SMALL };
        let picture = render(&scene, &options, &());
        assert_eq!(picture, Err(PreviewError::Size { width, height }));
    }
}

#[test]
fn progress_goes_from_nothing_to_all() {
    let strands = strand(Vec3::X * -0.05, Vec3::X * 0.05, 1e-4);
    let seen = Seen { limit: f64::INFINITY, ..Seen::default() };
    let scene = scene(&strands, None);
    render(&scene, &SMALL, &seen).unwrap();
    let seen = seen.fractions.into_inner().unwrap();
    assert_eq!((seen.first(), seen.last()), (Some(&0.0), Some(&1.0)));
    assert!(seen.iter().all(|d| (0.0..=1.0).contains(d)));
}

#[test]
fn every_kind_of_light_is_seen_in_the_preview() {
    let mut strands = Strands::new();
    curtain(&mut strands, 60, 0.0, 5e-4);
    let lit = |lights| light(&draw(&Scene { lights, ..scene(&strands, None) }));
    let distant = DistantLight::new(-DVec3::Y, Vec3::ONE, 0.1).unwrap();
    let expected = lit(Lights { lamps: vec![distant.into()], ..Lights::dark() });
    // As far as its light is of one metre.
    let point = PointLight::new(-DVec3::Y, Vec3::ONE).unwrap();
    let area = AreaLight::disc(-DVec3::Y, DVec3::Y, 0.1, Vec3::ONE).unwrap();
    let radiance = Vec3::splat(1.0 / area.form_factor(1.0) as f32);
    let area = AreaLight::disc(-DVec3::Y, DVec3::Y, 0.1, radiance).unwrap();
    for lamp in [point.into(), area.into()] {
        let found = lit(Lights { lamps: vec![lamp], ..Lights::dark() });
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
    }
    let map = EnvironmentMap::new(8, 4, vec![[1.0; 3]; 32]).unwrap();
    let map = lit(Lights { lamps: Vec::new(), environment: EnvironmentLight::Map(map) });
    let even = lit(Lights::even(Vec3::ONE));
    assert!((map / even - 1.0).abs() < 0.02, "{map} {even}");
    for setup in [Setup::Soft, Setup::Overcast, Setup::Daylight(Daylight::default())] {
        let found = lit(Lights::setup(&setup, &camera()).unwrap());
        assert!(found > 0.2 * even, "{setup:?}: {found} {even}");
    }
}
