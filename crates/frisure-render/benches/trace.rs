//! Whole traced pictures, 64 × 64: how their time grows with hair, samples and lightness.
#![allow(missing_docs, reason = "divan's macro makes public items")]

#[path = "../examples/support/wig.rs"]
mod wig;

use divan::Bencher;
use frisure_look::Melanin;
use frisure_render::Scene;
use frisure_render::trace::{TraceOptions, render};

fn main() {
    divan::main();
}

fn picture(bencher: Bencher<'_, '_>, strands: usize, samples: usize, melanin: Melanin) {
    let (hair, ball) = (wig::strands(&wig::Style::CURLY, strands, 16), wig::ball());
    let mut scene = Scene::portrait(&hair, Some(&ball));
    scene.look.hair.melanin = melanin;
    let options = TraceOptions { width: 64, height: 64, samples, ..TraceOptions::default() };
    bencher.bench_local(|| render(&scene, &options, &()));
}

#[divan::bench(args = [1_000, 10_000, 100_000], sample_count = 3, sample_size = 1)]
fn strands(bencher: Bencher<'_, '_>, strands: usize) {
    picture(bencher, strands, 4, Melanin::BROWN);
}

#[divan::bench(args = [1, 4, 16, 64], sample_count = 3, sample_size = 1)]
fn samples(bencher: Bencher<'_, '_>, samples: usize) {
    picture(bencher, 10_000, samples, Melanin::BROWN);
}

#[divan::bench(args = ["white", "blond", "brown", "black"], sample_count = 3, sample_size = 1)]
fn hair(bencher: Bencher<'_, '_>, name: &str) {
    let melanin = match name {
        "white" => Melanin::WHITE,
        "blond" => Melanin::BLOND,
        "brown" => Melanin::BROWN,
        _ => Melanin::BLACK,
    };
    picture(bencher, 10_000, 16, melanin);
}
