//! Hairs a second, as the tables of docs/performance.md: `cargo bench -p frisure-rod --bench batch`.
//!
//! Each figure is the best of some runs; those that are compared take turns, so that what else the machine does hits
//! them alike. Hairs are 15 cm long, of 70 µm, with roots all over a sphere, from their natural shapes.

#![expect(clippy::print_stdout, reason = "the tables are what it is for")]

use std::hint::black_box;
use std::time::Instant;

use frisure_rod::batch::{Batch, BatchLoss, BatchSolution, Precision};
use frisure_rod::{
    ElementKind, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, equilibrium,
};
use glam::{DQuat, DVec3};
use rayon::prelude::*;

mod hairs;

use hairs::{CURLS, heads};

/// Hairs of a batch, and how many of them the scalar solver gets.
const HAIRS: usize = 8192;
const ALONE: usize = 128;

/// Runs of each.
const RUNS: usize = 5;

/// Hairs that one thread looks after at a time.
const CHUNK: usize = 512;

fn main() {
    // `cargo test --benches` wants to know that it runs, not how fast.
    let quick = !std::env::args().any(|a| a == "--bench");
    let hairs = if quick { 64 } else { HAIRS };
    against_elements(hairs);
    against_threads(hairs);
    warm(hairs);
    derivatives(hairs);
}

/// Shortest time (s) of each, taking turns.
fn best<const N: usize>(mut tried: [&mut dyn FnMut(); N]) -> [f64; N] {
    let mut best = [f64::INFINITY; N];
    for _ in 0..RUNS {
        for (run, best) in tried.iter_mut().zip(&mut best) {
            let start = Instant::now();
            run();
            *best = best.min(start.elapsed().as_secs_f64());
        }
    }
    best
}

fn iterations(found: &BatchSolution) -> f64 {
    let sum: usize = found.rods.iter().map(|hair| hair.iterations).sum();
    sum as f64 / found.rods.len() as f64
}

/// Thousands a second.
fn rate(hairs: usize, seconds: f64) -> f64 {
    hairs as f64 / seconds / 1e3
}

fn against_elements(hairs: usize) {
    println!("Thousand hairs a second on one thread\n");
    println!(
        "| curl | elements | one by one | double | single | double over one by one | iterations |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for (name, turns) in CURLS {
        let rods = heads(turns, hairs);
        for elements in [5, 15, 30, 60, 120, 240] {
            let rods = &rods[..rods.len() * 15 / elements.max(15)];
            let double = Batch { elements, ..Batch::default() };
            let single = Batch { precision: Precision::Single, ..double };
            let few = &rods[..ALONE.min(rods.len())];
            let options = Options {
                resolution: Resolution::Elements(elements),
                element: ElementKind::Jointed,
                estimate_error: false,
                eigenvalue: false,
                ..Options::default()
            };
            let seconds = best([
                &mut || few.iter().for_each(|rod| drop(black_box(equilibrium(rod, &[], &options)))),
                &mut || drop(black_box(double.solve(rods))),
                &mut || drop(black_box(single.solve(rods))),
            ]);
            let alone = rate(few.len(), seconds[0]);
            let [double_rate, single_rate] = [seconds[1], seconds[2]].map(|s| rate(rods.len(), s));
            println!(
                "| {name} | {elements} | {alone:.2} | {double_rate:.1} | {single_rate:.1} | {:.0} | {:.1} |",
                double_rate / alone,
                iterations(&double.solve(rods)),
            );
        }
    }
}

/// In chunks of fixed size, which do not depend on how many threads there are.
fn in_chunks(rods: &[Rod], batch: Batch) {
    rods.par_chunks(CHUNK).for_each(|rods| drop(black_box(batch.solve(rods))));
}

fn against_threads(hairs: usize) {
    println!("\nThousand hairs a second, four turns, 15 elements\n");
    println!("| threads | double | single |");
    println!("| --- | --- | --- |");
    let rods = heads(4.0, 4 * hairs);
    let double = Batch::default();
    let single = Batch { precision: Precision::Single, ..double };
    let most = std::thread::available_parallelism().map_or(1, usize::from);
    let mut threads = 1;
    while threads <= most {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let seconds = best([&mut || pool.install(|| in_chunks(&rods, double)), &mut || {
            pool.install(|| in_chunks(&rods, single));
        }]);
        let [double, single] = seconds.map(|s| rate(rods.len(), s));
        println!("| {threads} | {double:.1} | {single:.1} |");
        threads *= 2;
    }
}

/// From the natural shape, and from where a hair rests that is rooted a degree away with a curl of 2 % less.
fn warm(hairs: usize) {
    println!("\nThousand hairs a second on one thread, 15 elements (iterations)\n");
    println!("| curl | natural shape | a neighbour's rest | ratio |");
    println!("| --- | --- | --- | --- |");
    let batch = Batch::default();
    for (name, turns) in CURLS {
        let (rods, near) = (heads(turns, hairs), neighbours(turns, hairs));
        let before = batch.solve(&near).controls;
        let seconds = best([&mut || drop(black_box(batch.solve(&rods))), &mut || {
            drop(black_box(batch.solve_from(&rods, before.clone())));
        }]);
        let [cold, warm] = seconds.map(|s| rate(rods.len(), s));
        let (few, fewer) =
            (iterations(&batch.solve(&rods)), iterations(&batch.solve_from(&rods, before.clone())));
        println!("| {name} | {cold:.1} ({few:.1}) | {warm:.1} ({fewer:.1}) | {:.2} |", warm / cold);
    }
}

/// Rest alone, with its nodes, to the gradient that derivatives need, and with the derivatives of a loss of all nodes.
fn derivatives(hairs: usize) {
    println!("\nThousand hairs a second, 15 elements, threads: {}\n", rayon::current_num_threads());
    println!(
        "| curl | rest to 1e-8 | and nodes | rest to 1e-10 | and derivatives | ratio | by themselves |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    let default = Batch::default();
    let exact = Batch { tolerance: 1e-10, ..default };
    for (name, turns) in CURLS {
        let rods = heads(turns, 4 * hairs);
        let loss = vec![DVec3::new(0.3, -0.2, 1.0); CHUNK * (exact.elements + 1)];
        let with = |rods: &[Rod]| {
            let found = exact.solve(rods);
            let loss = &loss[..rods.len() * (exact.elements + 1)];
            drop(black_box(exact.vjp(rods, &found, BatchLoss::of_positions(loss))));
        };
        let mut nodes = vec![[0.0; 3]; rods.len() * (default.elements + 1)];
        let seconds = best([
            &mut || in_chunks(&rods, default),
            &mut || {
                let places = nodes.par_chunks_mut(CHUNK * (default.elements + 1));
                rods.par_chunks(CHUNK)
                    .zip(places)
                    .for_each(|(rods, places)| default.solve(rods).put_positions(rods, places));
            },
            &mut || in_chunks(&rods, exact),
            &mut || rods.par_chunks(CHUNK).for_each(with),
        ]);
        let rates = seconds.map(|s| rate(rods.len(), s));
        println!(
            "| {name} | {:.0} | {:.0} | {:.0} | {:.0} | {:.2} | {:.0} |",
            rates[0],
            rates[1],
            rates[2],
            rates[3],
            rates[3] / rates[2],
            rate(rods.len(), seconds[3] - seconds[2]),
        );
    }
}

/// Hairs rooted a degree away, with a curl of 2 % less.
fn neighbours(turns: f64, hairs: usize) -> Vec<Rod> {
    let near = |rod: &Rod| {
        let tangent = rod.root().frame().z_axis;
        let turned = DQuat::from_axis_angle(tangent.any_orthonormal_vector(), 1_f64.to_radians());
        let natural = NaturalStrain::Uniform(rod.natural().at(0.0) * 0.98);
        let side = DVec3::new(0.1, 0.9, -0.2);
        let root = Root::from_tangent(DVec3::ZERO, turned * tangent, side).unwrap();
        Rod::new(RodSpec { natural, root, ..rod.spec().clone() }).unwrap()
    };
    heads(turns, hairs).iter().map(near).collect()
}
