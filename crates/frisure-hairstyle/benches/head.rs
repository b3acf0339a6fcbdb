//! A whole head: guides coming to rest, and hairs drawn around them.
//!
//! `cargo bench -p frisure-hairstyle`

use divan::Bencher;
use frisure_hairstyle::head::Head;
use frisure_hairstyle::{Hairs, HairstyleSpec, predict, preset};
use frisure_rod::Resolution;

fn main() {
    divan::main();
}

fn spec(guides: usize, elements: usize) -> HairstyleSpec {
    let mut spec = preset("caucasian-curly").expect("a preset").spec();
    spec.wisps.count = guides;
    spec.wisps.hairs = Hairs::Count(100_000);
    spec.equilibrium.resolution = Resolution::Elements(elements);
    spec
}

/// The mannequin itself: skin, scalp, distances, spheres.
#[divan::bench(sample_count = 5)]
fn mannequin() -> Head {
    Head::mannequin()
}

/// Guides × elements, with contact, from scratch: the paper's head of hair is 100 × 15, and took
/// it six seconds.
#[divan::bench(args = [(100, 15), (100, 30), (200, 15), (400, 15)], sample_count = 8)]
fn guides(bencher: Bencher<'_, '_>, (guides, elements): (usize, usize)) {
    let (head, spec) = (Head::mannequin(), spec(guides, elements));
    bencher.bench(|| predict(&spec, &head, &()));
}

/// A hundred thousand hairs of 48 points around 100 guides.
#[divan::bench(sample_count = 5)]
fn hairs(bencher: Bencher<'_, '_>) {
    let (head, spec) = (Head::mannequin(), spec(100, 15));
    let style = predict(&spec, &head, &()).expect("a valid description");
    bencher.bench(|| style.strands(&head, &()));
}
