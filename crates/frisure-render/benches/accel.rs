//! Rays against a whole head: 100 000 strands of 16 points over a ball, one thread.
//!
//! Rates are rays per second (`Mitem/s` are millions of rays per second): primary rays of 512²
//! pixels, bounces in random directions from what those meet, and shadow rays from there to a lamp.
#![allow(missing_docs, reason = "divan's macro makes public items")]

#[path = "../examples/support/rays.rs"]
mod rays;
#[path = "../examples/support/wig.rs"]
mod wig;

use std::sync::LazyLock;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use frisure_render::accel::{CurveOptions, Ray, SceneBvh};
use frisure_strands::{Strands, Surface};
use rays::Rays;

struct World {
    strands: Strands,
    head: Surface,
    scene: SceneBvh,
    rays: Rays,
}

static WORLD: LazyLock<World> = LazyLock::new(World::new);

impl World {
    fn new() -> Self {
        let (strands, head) = (wig::strands(&wig::Style::CURLY, 100_000, 16), wig::ball());
        let scene = cut(&strands, &head, CurveOptions::default());
        let rays = Rays::new(&scene);
        Self { strands, head, scene, rays }
    }
}

fn cut(strands: &Strands, head: &Surface, options: CurveOptions) -> SceneBvh {
    SceneBvh::new(strands, Some(head), &options).expect("a wig can be traced")
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
            world.rays.bounce.len(),
            world.rays.primary.len(),
        );
    }
    divan::main();
}

fn closest(bencher: Bencher<'_, '_>, scene: &SceneBvh, rays: &[Ray]) {
    bencher.counter(ItemsCount::new(rays.len())).bench_local(|| {
        rays.iter().filter(|r| black_box(scene.closest_hit(r, f32::INFINITY)).is_some()).count()
    });
}

fn occluded(bencher: Bencher<'_, '_>, scene: &SceneBvh, rays: &[Ray]) {
    bencher
        .counter(ItemsCount::new(rays.len()))
        .bench_local(|| rays.iter().filter(|r| scene.occluded(r, f32::INFINITY)).count());
}

/// Growth with the number of strands.
#[divan::bench(args = [1_000, 10_000, 100_000], sample_count = 3, sample_size = 1)]
fn build(bencher: Bencher<'_, '_>, strands: usize) {
    let strands = wig::strands(&wig::Style::CURLY, strands, 16);
    bencher
        .counter(ItemsCount::new(strands.len()))
        .bench_local(|| cut(&strands, &WORLD.head, CurveOptions::default()));
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn primary_rays(bencher: Bencher<'_, '_>) {
    closest(bencher, &WORLD.scene, &WORLD.rays.primary);
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn bounce_rays(bencher: Bencher<'_, '_>) {
    closest(bencher, &WORLD.scene, &WORLD.rays.bounce);
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn shadow_rays(bencher: Bencher<'_, '_>) {
    occluded(bencher, &WORLD.scene, &WORLD.rays.shadow);
}

/// With the instructions that every machine has.
mod portable {
    use super::{Bencher, LazyLock, SceneBvh, WORLD, closest, occluded};

    static SCENE: LazyLock<SceneBvh> = LazyLock::new(|| WORLD.scene.clone().portable());

    #[divan::bench(sample_count = 5, sample_size = 1)]
    fn primary_rays(bencher: Bencher<'_, '_>) {
        closest(bencher, &SCENE, &WORLD.rays.primary);
    }

    #[divan::bench(sample_count = 5, sample_size = 1)]
    fn bounce_rays(bencher: Bencher<'_, '_>) {
        closest(bencher, &SCENE, &WORLD.rays.bounce);
    }

    #[divan::bench(sample_count = 5, sample_size = 1)]
    fn shadow_rays(bencher: Bencher<'_, '_>) {
        occluded(bencher, &SCENE, &WORLD.rays.shadow);
    }
}

/// Longest pieces of other lengths (mm).
mod cut_to {
    use super::{Bencher, CurveOptions, SceneBvh, WORLD, closest, cut, occluded};

    const MILLIMETRES: [u8; 3] = [3, 5, 8];

    fn scene(millimetres: u8) -> SceneBvh {
        let longest_piece = 1e-3 * f32::from(millimetres);
        // The tolerance must not cut what the length does not.
        let options = CurveOptions { longest_piece, tolerance: 1.0 };
        cut(&WORLD.strands, &WORLD.head, options)
    }

    #[divan::bench(args = MILLIMETRES, sample_count = 5, sample_size = 1)]
    fn primary_rays(bencher: Bencher<'_, '_>, millimetres: u8) {
        closest(bencher, &scene(millimetres), &WORLD.rays.primary);
    }

    #[divan::bench(args = MILLIMETRES, sample_count = 5, sample_size = 1)]
    fn bounce_rays(bencher: Bencher<'_, '_>, millimetres: u8) {
        closest(bencher, &scene(millimetres), &WORLD.rays.bounce);
    }

    #[divan::bench(args = MILLIMETRES, sample_count = 5, sample_size = 1)]
    fn shadow_rays(bencher: Bencher<'_, '_>, millimetres: u8) {
        occluded(bencher, &scene(millimetres), &WORLD.rays.shadow);
    }
}
