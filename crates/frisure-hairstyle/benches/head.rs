//! A whole head: guides coming to rest, and hairs drawn around them.
//!
//! `cargo bench -p frisure-hairstyle`

use divan::Bencher;
use frisure_hairstyle::head::Head;
use frisure_hairstyle::{
    Effort, HairContact, HairModel, Hairs, HairstyleSpec, PredictOptions, Start, StrandContact,
    StrandOptions, predict, preset, strands,
};
use frisure_rod::Resolution;
use glam::DVec3;

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

/// The head of the paper and larger ones, with hair in layers: guides × elements, from scratch.
#[divan::bench(args = SIZES, sample_count = 8)]
fn layers(bencher: Bencher<'_, '_>, size: (usize, usize)) {
    cold(bencher, size, HairContact::Layers);
}

/// The same with wisps that repel each other.
#[divan::bench(args = SIZES, sample_count = 4)]
fn wisps(bencher: Bencher<'_, '_>, size: (usize, usize)) {
    cold(bencher, size, HairContact::Wisps);
}

/// The same with wisps that press on each other as a density.
#[divan::bench(args = SIZES, sample_count = 4)]
fn density(bencher: Bencher<'_, '_>, size: (usize, usize)) {
    cold(bencher, size, HairContact::Density);
}

/// Guides × elements: the paper's head of hair is 100 × 15, and took it six seconds.
const SIZES: [(usize, usize); 5] = [(100, 15), (100, 30), (200, 15), (400, 15), (100, 60)];

fn cold(bencher: Bencher<'_, '_>, (guides, elements): (usize, usize), hair: HairContact) {
    let (head, mut spec) = (Head::mannequin(), spec(guides, elements));
    spec.contact.hair = hair;
    bencher.bench(|| predict(&spec, &head, PredictOptions::default(), &()));
}

/// Contact, and most sweeps.
const WARM: [(HairContact, usize); 5] = [
    (HairContact::Layers, 1),
    (HairContact::Wisps, 2),
    (HairContact::Wisps, 1000),
    (HairContact::Density, 2),
    (HairContact::Density, 1000),
];

/// After the radius of curls has grown by 2 %: to rest in layers, then among wisps in two sweeps and
/// to rest, then as a density in two steps and to rest.
#[divan::bench(args = 0..5, sample_count = 20)]
fn warm(bencher: Bencher<'_, '_>, case: usize) {
    let (hair, sweeps) = WARM[case];
    let (head, mut spec) = (Head::mannequin(), spec(100, 15));
    spec.contact.hair = hair;
    let before =
        predict(&spec, &head, PredictOptions::default(), &()).expect("a valid description");
    spec.curl.strain /= 1.02;
    let effort = Effort { sweeps, ..Effort::FULL };
    let options = PredictOptions { previous: Some(&before), start: Start::Previous, effort };
    bencher.bench(|| predict(&spec, &head, options, &()));
}

/// Twenty thousand hairs of 48 points around 200 guides, each a rod of its own on the skin and between its neighbours.
#[divan::bench(args = ["straight", "wavy", "curly", "frizzy"], sample_count = 3)]
fn simulated_hairs(bencher: Bencher<'_, '_>, name: &str) {
    simulated(bencher, name, 20_000, StrandContact::Tube);
}

/// The same of more and more curly hairs.
#[divan::bench(args = [100, 1000, 10_000, 100_000], sample_count = 3)]
fn simulated_heads(bencher: Bencher<'_, '_>, hairs: usize) {
    simulated(bencher, "curly", hairs, StrandContact::Tube);
}

/// Straight hairs that push and rub each other.
#[divan::bench(args = [1000, 10_000], sample_count = 1)]
fn hairs_in_contact(bencher: Bencher<'_, '_>, hairs: usize) {
    simulated(bencher, "straight", hairs, StrandContact::Contacts);
}

fn simulated(bencher: Bencher<'_, '_>, name: &str, hairs: usize, contact: StrandContact) {
    let (head, mut spec) = (Head::mannequin(), preset(name).expect("a preset").spec());
    spec.wisps.count = 200;
    spec.wisps.hairs = Hairs::Count(hairs);
    spec.wisps.strands = HairModel::Simulated;
    spec.wisps.contact = contact;
    spec.contact.hair = HairContact::Layers;
    spec.contact.friction = if contact == StrandContact::Contacts { 0.3 } else { 0.0 };
    let style = predict(&spec, &head, PredictOptions::default(), &()).expect("a valid description");
    bencher.bench(|| strands(&style, &head, StrandOptions::default(), &()));
}

/// The signed distance to the skin at a thousand places around a head: itself, with gradient, with Hessian.
#[divan::bench(args = [0, 1, 2])]
fn distance(bencher: Bencher<'_, '_>, derivatives: usize) {
    let head = Head::mannequin();
    let field = head.signed_distance();
    let (low, high) = field.bounds();
    let place = |k: u32| {
        let at = DVec3::new(0.618, 0.414, 0.732) * f64::from(k);
        low + (high - low) * (at - at.floor())
    };
    let places: Vec<DVec3> = (0..1000).map(place).collect();
    bencher.bench(|| -> f64 {
        let at = |p: &DVec3| match derivatives {
            0 => field.value(*p),
            1 => field.value_gradient(*p).1.x,
            _ => field.value_gradient_hessian(*p).2.x_axis.x,
        };
        places.iter().map(at).sum()
    });
}

/// A hundred thousand hairs of 48 points around 100 guides.
#[divan::bench(sample_count = 5)]
fn hairs(bencher: Bencher<'_, '_>) {
    let (head, spec) = (Head::mannequin(), spec(100, 15));
    let style = predict(&spec, &head, PredictOptions::default(), &()).expect("a valid description");
    bencher.bench(|| strands(&style, &head, StrandOptions::default(), &()));
}
