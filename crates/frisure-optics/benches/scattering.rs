//! How long light takes at a fibre. `cargo bench -p frisure-optics`.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use frisure_optics::scattering::{Fibre, FibreSpec, Scattering};
use frisure_optics::{Melanin, absorption};
use glam::Vec3;

fn main() {
    divan::main();
}

/// Axis ratios, and wetness: a circle, an ellipse, a wet ellipse.
const FIBRES: [(f32, f32); 3] = [(1.0, 0.0), (1.4, 0.0), (1.4, 1.0)];

fn fibre((axis_ratio, wetness): (f32, f32)) -> Fibre {
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

#[divan::bench(args = [0, 1, 2])]
fn prepare(bencher: Bencher<'_, '_>, which: usize) {
    let (fibre, hits) = (fibre(FIBRES[which]), hits());
    bencher.counter(ItemsCount::new(hits.len())).bench_local(|| {
        for &(w, h, _) in &hits {
            black_box(Scattering::new(&fibre, w, h));
        }
    });
}

#[divan::bench(args = [0, 1, 2])]
fn prepare_evaluate_sample(bencher: Bencher<'_, '_>, which: usize) {
    let (fibre, hits) = (fibre(FIBRES[which]), hits());
    let light = Vec3::new(0.48, -0.6, 0.64);
    bencher.counter(ItemsCount::new(hits.len())).bench_local(|| {
        for &(w, h, u) in &hits {
            let hit = Scattering::new(&fibre, w, h);
            black_box((hit.evaluate(black_box(light)), hit.sample(u)));
        }
    });
}
