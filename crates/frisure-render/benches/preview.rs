//! A whole head of hair: 100 000 strands of 20 points on 1024² pixels.
#![allow(missing_docs, reason = "divan's macro makes public items")]

#[path = "../examples/support/wig.rs"]
mod wig;

use divan::Bencher;
use frisure_render::Scene;
use frisure_render::preview::{PreviewOptions, render};

fn main() {
    divan::main();
}

fn whole_head(bencher: Bencher<'_, '_>, style: &wig::Style) {
    let (strands, head) = (wig::strands(style, 100_000, 20), wig::ball());
    let scene = Scene::portrait(&strands, Some(&head));
    bencher.bench_local(|| render(&scene, &PreviewOptions::default(), &()));
}

#[divan::bench(sample_count = 5)]
fn straight(bencher: Bencher<'_, '_>) {
    whole_head(bencher, &wig::Style::STRAIGHT);
}

#[divan::bench(sample_count = 5)]
fn curly(bencher: Bencher<'_, '_>) {
    whole_head(bencher, &wig::Style::CURLY);
}
