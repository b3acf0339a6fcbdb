//! How long light takes at a fibre. `cargo bench -p frisure-optics`.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use frisure_look::{Melanin, absorption};
use frisure_optics::scattering::{Fibre, FibreSpec, HairBsdf};
use glam::Vec3;

fn main() {
    divan::main();
}

const FIBRES: [&str; 3] = ["circle", "ellipse", "wet ellipse"];

/// A brown fibre.
fn fibre(name: &str) -> Fibre {
    let axis_ratio = if name == "circle" { 1.0 } else { 1.4 };
    let wetness = if name == "wet ellipse" { 1.0 } else { 0.0 };
    let absorption = absorption(Melanin::BROWN);
    Fibre::new(FibreSpec { axis_ratio, wetness, absorption, ..Default::default() }).unwrap()
}

/// Hits that fill the sphere, the width and the unit cube: additive sequences.
fn hits() -> Vec<(Vec3, f32, [f32; 4])> {
    let part = |i: usize, step: f64| ((i as f64 * step).fract()) as f32;
    (1..=1000)
        .map(|i| {
            let z = 2.0 * part(i, 0.618_034) - 1.0;
            let (y, x) = (part(i, 0.754_878) * std::f32::consts::TAU).sin_cos();
            let across = (1.0 - z * z).sqrt();
            let u = [0.414_214, 0.732_051, 0.236_068, 0.645_751].map(|step| part(i, step));
            (Vec3::new(across * x, across * y, z), 2.0 * part(i, 0.569_840) - 1.0, u)
        })
        .collect()
}

#[divan::bench(args = FIBRES)]
fn prepare(bencher: Bencher<'_, '_>, name: &str) {
    let (fibre, hits) = (fibre(name), hits());
    bencher.counter(ItemsCount::new(hits.len())).bench_local(|| {
        for &(w, h, _) in &hits {
            black_box(HairBsdf::new(&fibre, w, h));
        }
    });
}

#[divan::bench(args = FIBRES)]
fn prepare_evaluate_sample(bencher: Bencher<'_, '_>, name: &str) {
    let (fibre, hits) = (fibre(name), hits());
    let light = Vec3::new(0.48, -0.6, 0.64);
    bencher.counter(ItemsCount::new(hits.len())).bench_local(|| {
        for &(w, h, u) in &hits {
            let hit = HairBsdf::new(&fibre, w, h);
            black_box((hit.evaluate(black_box(light)), hit.sample(u)));
        }
    });
}
