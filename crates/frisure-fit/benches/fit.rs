//! Fits of 10 000 synthetic fibres seen once, 41 points with 0.1 mm of noise, on all threads: `cargo bench -p frisure-fit`.

#[path = "../tests/common/mod.rs"]
mod common;

use common::{Truth, seen_once};
use frisure_fit::{Estimate, Known, Options, fit};
use frisure_rod::SplitMix64;

fn main() {
    divan::main();
}

/// Fibres with their arc lengths and without, of a section that is known and that is not.
#[divan::bench(args = [(true, true), (true, false), (false, true), (false, false)], sample_count = 3)]
fn ten_thousand(bencher: divan::Bencher<'_, '_>, (placed, round): (bool, bool)) {
    let mut random = SplitMix64(1);
    let truths: Vec<Truth> = (0..10_000).map(|_| Truth::random(&mut random)).collect();
    let fibres = seen_once(&truths, 1e-4, placed, &mut random);
    let options = Options { noise: Some(1e-4), ..Options::default() };
    let axis_ratio = round.then_some(Estimate::exact(1.0));
    let known = [Known { axis_ratio, ..Known::default() }];
    bencher.bench_local(|| fit(&fibres, &known, &options, &()));
}
