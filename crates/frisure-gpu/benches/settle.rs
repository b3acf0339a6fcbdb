//! Hairs a second on a graphics processor, as the table of docs/performance.md: `cargo bench -p frisure-gpu`.
//!
//! The hairs are those of `cargo bench -p frisure-rod --bench batch`: 15 cm long, of 70 µm, with roots all over a sphere, from their
//! natural shapes. Each figure is the best of some runs that take turns; times are wall-clock, with all that is done here for the device.
//! `--hairs N` sets how many there are, `--software` takes the driver that is a program, to compare.

#![expect(clippy::print_stdout, reason = "the tables are what it is for")]

use std::hint::black_box;
use std::time::Instant;

use frisure_gpu::{Device, OnDevice, Seconds};
use frisure_rod::batch::Batch;
use frisure_rod::{Chain, ElementKind, Rod};
use glam::DVec3;

#[path = "../../frisure-rod/benches/hairs/mod.rs"]
mod hairs;

use hairs::{CURLS, heads};

/// Hairs of a batch, on a graphics processor and on a program that stands for one.
const HAIRS: usize = 65_536;
const FEWER: usize = 8192;

/// Runs of each.
const RUNS: usize = 5;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let given = |name: &str| arguments.iter().position(|a| a == name);
    // `cargo test --benches` wants to know that it runs, not how fast.
    let quick = given("--bench").is_none();
    let found = if given("--software").is_some() { Device::software() } else { Device::new() };
    let device = match found {
        Ok(device) => device,
        Err(error) => {
            println!("nothing measured: {error}");
            return;
        }
    };
    let hairs = match given("--hairs").and_then(|i| arguments.get(i + 1)?.parse().ok()) {
        Some(hairs) => hairs,
        None if quick => 64,
        None if device.is_software() => FEWER,
        None => HAIRS,
    };
    let threads = rayon::current_num_threads();
    println!("{}; {threads} threads; {hairs} hairs", device.name());
    if device.is_software() {
        println!("no graphics processor found or asked for: this is a program on the processor");
    }
    println!("\nThousand hairs a second\n");
    println!(
        "| curl | elements | processor, one thread | device alone | with the judge, one thread | with the judge, all threads | gain on one thread | if the device took no time | sweeps | given up | error before the judge (mm) |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    let mut spent = Vec::new();
    for (name, turns) in CURLS {
        let rods = heads(turns, hairs);
        for elements in [15, 30, 60] {
            let batch = Batch { elements, ..Batch::default() };
            spent.push((name, elements, row(name, &rods, batch, &device)));
        }
    }
    println!("\nMilliseconds of one batch on one thread\n");
    println!("| curl | elements | divide | upload | device | download | judge |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for (name, elements, s) in spent {
        let [a, b, c, d, e] = [s.divide, s.upload, s.device, s.download, s.judge].map(|s| 1e3 * s);
        println!("| {name} | {elements} | {a:.1} | {b:.1} | {c:.1} | {d:.1} | {e:.1} |");
    }
}

/// One row of the first table; the shortest time of each stage on one thread.
fn row(name: &str, rods: &[Rod], batch: Batch, device: &Device) -> Seconds {
    let there = device.with(batch);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let ever = f64::INFINITY;
    let mut spent =
        Seconds { divide: ever, upload: ever, device: ever, download: ever, judge: ever };
    let seconds = best([
        &mut || drop(black_box(batch.settle(rods))),
        &mut || drop(black_box(there.unjudged(rods).unwrap())),
        &mut || {
            let (_, report) = one.install(|| there.settle(rods)).unwrap();
            spent = shortest(spent, report.seconds);
        },
        &mut || drop(black_box(there.settle(rods).unwrap())),
    ]);
    let [here, alone, judged, all] = seconds.map(|s| rods.len() as f64 / s / 1e3);
    let (_, report) = there.settle(rods).unwrap();
    let processor = spent.divide + spent.upload + spent.download + spent.judge;
    println!(
        "| {name} | {} | {here:.1} | {alone:.1} | {judged:.1} | {all:.1} | {:.2} | {:.2} | {:.1} | {} | {:.4} |",
        batch.elements,
        judged / here,
        seconds[0] / processor,
        report.sweeps as f64 / rods.len() as f64,
        report.given_up,
        1e3 * error(&there, rods, batch.elements),
    );
    spent
}

/// Of each stage.
fn shortest(a: Seconds, b: Seconds) -> Seconds {
    Seconds {
        divide: a.divide.min(b.divide),
        upload: a.upload.min(b.upload),
        device: a.device.min(b.device),
        download: a.download.min(b.download),
        judge: a.judge.min(b.judge),
    }
}

/// Farthest that a tip is (m) before the judge from where it is after; of hairs that the device did not give up.
fn error(there: &OnDevice<'_>, rods: &[Rod], elements: usize) -> f64 {
    let before = there.unjudged(rods).unwrap();
    let (after, _) = there.settle(rods).unwrap();
    let tip = |rod: &Rod, controls: &[DVec3]| {
        let chain = Chain::uniform(rod, ElementKind::Jointed, elements);
        *chain.shape(controls.to_vec()).positions.last().unwrap()
    };
    let pairs = before.controls.chunks(elements).zip(after.controls.chunks(elements));
    let settled = rods.iter().zip(pairs).zip(&before.settled).filter(|(_, settled)| **settled);
    settled.map(|((rod, (a, b)), _)| tip(rod, a).distance(tip(rod, b))).fold(0.0, f64::max)
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
