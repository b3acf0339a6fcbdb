//! Rays against a whole head: 100 000 strands of 16 points over a ball, one thread.
//!
//! Rates are rays per second (`Mitem/s` are millions of rays per second): primary rays of 512²
//! pixels, bounces in random directions from what those meet, and shadow rays from there to a lamp.
#![allow(missing_docs, reason = "divan's macro makes public items")]

#[path = "../examples/support/wig.rs"]
mod wig;

use std::f32::consts::TAU;
use std::sync::LazyLock;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use frisure_render::Camera;
use frisure_render::accel::{CurveOptions, Hit, Ray, Scene};
use frisure_strands::{Strands, Surface};
use glam::{DVec3, Vec3};

const SIDE: u32 = 512;

struct World {
    strands: Strands,
    head: Surface,
    scene: Scene,
    primary: Vec<Ray>,
    bounce: Vec<Ray>,
    shadow: Vec<Ray>,
}

static WORLD: LazyLock<World> = LazyLock::new(World::new);

impl World {
    fn new() -> Self {
        let (strands, head) = (wig::strands(&wig::Style::CURLY, 100_000, 16), wig::ball());
        let scene = cut(&strands, &head, CurveOptions::default());
        let primary = primary(&scene);
        let hits: Vec<Hit> =
            primary.iter().filter_map(|r| scene.closest_hit(r, f32::INFINITY)).collect();
        let lamp = Vec3::new(-0.5, -0.6, 0.7).normalize();
        let bounce = hits
            .iter()
            .enumerate()
            .map(|(i, hit)| {
                let towards = direction(i);
                Ray::new(hit.start(towards), towards)
            })
            .collect();
        let shadow = hits.iter().map(|hit| Ray::new(hit.start(lamp), lamp)).collect();
        Self { strands, head, scene, primary, bounce, shadow }
    }
}

fn cut(strands: &Strands, head: &Surface, options: CurveOptions) -> Scene {
    Scene::new(strands, Some(head), &options).expect("a wig can be traced")
}

/// The picture that a portrait camera takes.
fn primary(scene: &Scene) -> Vec<Ray> {
    let (low, high) = scene.bounds().expect("a wig has bounds");
    let camera = Camera::framing((low.as_dvec3(), high.as_dvec3()), 0.5, 0.08, 1.0);
    let tan = (0.5 * camera.vertical_fov()).tan();
    let across = |i: u32| (f64::from(2 * i + 1) / f64::from(SIDE) - 1.0) * tan;
    let towards = |x: u32, y: u32| -> DVec3 {
        camera.forward() + across(x) * camera.right() - across(y) * camera.up()
    };
    let eye = camera.eye().as_vec3();
    (0..SIDE * SIDE).map(|i| Ray::new(eye, towards(i % SIDE, i / SIDE).as_vec3())).collect()
}

/// Directions spread evenly over the sphere (the additive recurrence of the plastic number).
fn direction(i: usize) -> Vec3 {
    let [u, v] = [0.754_877_666_f64, 0.569_840_291].map(|a| (a * i as f64).fract() as f32);
    let z = 2.0 * u - 1.0;
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * (TAU * v).cos(), r * (TAU * v).sin(), z)
}

fn main() {
    let world = &*WORLD;
    let strands = world.strands.len();
    #[allow(clippy::print_stdout, reason = "part of what is measured")]
    {
        println!(
            "{} pieces and {} bytes per strand; {} of {} primary rays hit",
            world.scene.pieces() / strands,
            world.scene.bytes() / strands,
            world.bounce.len(),
            world.primary.len(),
        );
    }
    divan::main();
}

fn closest(bencher: Bencher<'_, '_>, scene: &Scene, rays: &[Ray]) {
    bencher.counter(ItemsCount::new(rays.len())).bench_local(|| {
        rays.iter().filter(|r| black_box(scene.closest_hit(r, f32::INFINITY)).is_some()).count()
    });
}

fn occluded(bencher: Bencher<'_, '_>, scene: &Scene, rays: &[Ray]) {
    bencher
        .counter(ItemsCount::new(rays.len()))
        .bench_local(|| rays.iter().filter(|r| scene.occluded(r, f32::INFINITY)).count());
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn build(bencher: Bencher<'_, '_>) {
    let world = &*WORLD;
    bencher
        .counter(ItemsCount::new(world.strands.len()))
        .bench_local(|| cut(&world.strands, &world.head, CurveOptions::default()));
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn primary_rays(bencher: Bencher<'_, '_>) {
    closest(bencher, &WORLD.scene, &WORLD.primary);
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn bounce_rays(bencher: Bencher<'_, '_>) {
    closest(bencher, &WORLD.scene, &WORLD.bounce);
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn shadow_rays(bencher: Bencher<'_, '_>) {
    occluded(bencher, &WORLD.scene, &WORLD.shadow);
}

/// Without AVX2.
mod portable {
    use super::{Bencher, LazyLock, Scene, WORLD, closest, occluded};

    static SCENE: LazyLock<Scene> = LazyLock::new(|| WORLD.scene.clone().portable());

    #[divan::bench(sample_count = 5, sample_size = 1)]
    fn primary_rays(bencher: Bencher<'_, '_>) {
        closest(bencher, &SCENE, &WORLD.primary);
    }

    #[divan::bench(sample_count = 5, sample_size = 1)]
    fn bounce_rays(bencher: Bencher<'_, '_>) {
        closest(bencher, &SCENE, &WORLD.bounce);
    }

    #[divan::bench(sample_count = 5, sample_size = 1)]
    fn shadow_rays(bencher: Bencher<'_, '_>) {
        occluded(bencher, &SCENE, &WORLD.shadow);
    }
}

/// Longest pieces of other lengths (mm).
mod cut_to {
    use super::{Bencher, CurveOptions, Scene, WORLD, closest, cut, occluded};

    const MILLIMETRES: [u8; 3] = [3, 5, 8];

    fn scene(millimetres: u8) -> Scene {
        let longest_piece = 1e-3 * f32::from(millimetres);
        // The tolerance must not cut what the length does not.
        let options = CurveOptions { longest_piece, tolerance: 1.0 };
        cut(&WORLD.strands, &WORLD.head, options)
    }

    #[divan::bench(args = MILLIMETRES, sample_count = 5, sample_size = 1)]
    fn primary_rays(bencher: Bencher<'_, '_>, millimetres: u8) {
        closest(bencher, &scene(millimetres), &WORLD.primary);
    }

    #[divan::bench(args = MILLIMETRES, sample_count = 5, sample_size = 1)]
    fn bounce_rays(bencher: Bencher<'_, '_>, millimetres: u8) {
        closest(bencher, &scene(millimetres), &WORLD.bounce);
    }

    #[divan::bench(args = MILLIMETRES, sample_count = 5, sample_size = 1)]
    fn shadow_rays(bencher: Bencher<'_, '_>, millimetres: u8) {
        occluded(bencher, &scene(millimetres), &WORLD.shadow);
    }
}
