//! How long a hair takes. `cargo bench -p frisure-rod`.

use divan::Bencher;
use divan::counter::ItemsCount;
use frisure_rod::batch::{Batch, Precision};
use frisure_rod::{
    ElementKind, Load, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Section,
    TorsionConstant, equilibrium, equilibrium_from,
};
use glam::DVec3;
use rayon::prelude::*;

fn main() {
    divan::main();
}

/// A 15 cm curl of radius 5 mm and pitch 10 mm, leaving along `tangent`.
fn curl(tangent: DVec3) -> Rod {
    Rod::new(RodSpec {
        length: 0.15,
        section: Section::from_diameter(70e-6, 1.2).unwrap(),
        material: Material::new(3e9, 1.0e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.005, 0.010).unwrap(),
        root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(0.1, 0.9, -0.2)).unwrap(),
        load: Load::down(9.81),
    })
    .unwrap()
}

fn one() -> Rod {
    curl(DVec3::new(1.0, 0.3, 0.4))
}

/// Roots all over a head: a spiral on the sphere.
fn many(count: usize) -> Vec<Rod> {
    (0..count)
        .map(|i| {
            let z = 1.0 - 1.6 * (i as f64 + 0.5) / count as f64;
            let angle = 2.399_963 * i as f64;
            let r = (1.0 - z * z).sqrt();
            curl(DVec3::new(r * angle.cos(), r * angle.sin(), z))
        })
        .collect()
}

fn plain(resolution: Resolution) -> Options {
    Options { resolution, estimate_error: false, eigenvalue: false, ..Options::default() }
}

#[divan::bench(args = [15, 30, 60, 120, 240])]
fn one_hair(bencher: Bencher<'_, '_>, elements: usize) {
    let (rod, options) = (one(), plain(Resolution::Elements(elements)));
    bencher
        .counter(ItemsCount::new(1_usize))
        .bench_local(|| equilibrium(divan::black_box(&rod), &[], &options));
}

#[divan::bench(args = [15, 60])]
fn one_hair_of_helices(bencher: Bencher<'_, '_>, elements: usize) {
    let options = Options { element: ElementKind::Helix, ..plain(Resolution::Elements(elements)) };
    let rod = one();
    bencher
        .counter(ItemsCount::new(1_usize))
        .bench_local(|| equilibrium(divan::black_box(&rod), &[], &options));
}

#[divan::bench(args = [15, 60])]
fn a_warm_start(bencher: Bencher<'_, '_>, elements: usize) {
    let options = plain(Resolution::Elements(elements));
    let previous = equilibrium(&one(), &[], &options);
    let rod = Rod::new(RodSpec { length: 0.151, ..one().spec().clone() }).unwrap();
    bencher
        .counter(ItemsCount::new(1_usize))
        .bench_local(|| equilibrium_from(divan::black_box(&rod), &[], &options, &previous));
}

#[divan::bench]
fn one_hair_within_a_tenth_of_a_millimetre(bencher: Bencher<'_, '_>) {
    let (rod, options) = (one(), plain(Resolution::Accuracy(1e-4)));
    bencher
        .counter(ItemsCount::new(1_usize))
        .bench_local(|| equilibrium(divan::black_box(&rod), &[], &options));
}

#[divan::bench(args = [15, 60], sample_count = 10)]
fn a_thousand_hairs(bencher: Bencher<'_, '_>, elements: usize) {
    let (rods, options) = (many(1000), plain(Resolution::Elements(elements)));
    bencher.counter(ItemsCount::new(rods.len())).bench_local(|| {
        let tips = rods.par_iter().map(|rod| equilibrium(rod, &[], &options).tip());
        tips.collect::<Vec<_>>()
    });
}

#[divan::bench(sample_count = 5)]
fn a_thousand_hairs_within_a_tenth_of_a_millimetre(bencher: Bencher<'_, '_>) {
    let (rods, options) = (many(1000), plain(Resolution::Accuracy(1e-4)));
    bencher.counter(ItemsCount::new(rods.len())).bench_local(|| {
        let tips = rods.par_iter().map(|rod| equilibrium(rod, &[], &options).tip());
        tips.collect::<Vec<_>>()
    });
}

/// On one thread; beside [`one_hair`] this is what lanes gain.
#[divan::bench(args = [5, 15, 30, 60, 120, 240], sample_count = 10)]
fn a_batch(bencher: Bencher<'_, '_>, elements: usize) {
    let (rods, batch) = (many(4096), Batch { elements, ..Batch::default() });
    let count = ItemsCount::new(rods.len());
    bencher.counter(count).bench_local(|| batch.solve(divan::black_box(&rods)));
}

#[divan::bench(args = [5, 15, 30, 60, 120, 240], sample_count = 10)]
fn a_batch_in_single_precision(bencher: Bencher<'_, '_>, elements: usize) {
    let rods = many(4096);
    let batch = Batch { elements, precision: Precision::Single, ..Batch::default() };
    let count = ItemsCount::new(rods.len());
    bencher.counter(count).bench_local(|| batch.solve(divan::black_box(&rods)));
}
