//! How long a slider waits, and how long all hair at rest takes, for every hair type.
//!
//! `cargo bench -p frisure-engine`

use divan::Bencher;
use frisure_engine::Session;
use frisure_engine::{Quality, Request, Response, SceneRef};

fn main() {
    divan::main();
}

const TYPES: [&str; 6] = [
    "asian-straight",
    "caucasian-straight",
    "caucasian-wavy",
    "caucasian-curly",
    "frizzy",
    "african-coily",
];

fn asked(kind: &str, length: f64, steps: &str, done: usize) -> SceneRef {
    let text = format!("[hair]\ntype = '{kind}'\nlength = {length}\n{steps}");
    SceneRef { name: "bench".into(), text, folder: String::new(), done }
}

fn show(session: &mut Session, asked: SceneRef, effort: Quality) {
    let answer = session.execute(&Request::Preview { scene: asked, quality: effort }, &());
    assert!(matches!(answer, Response::Preview(_)), "{answer:?}");
}

/// A slider that moves by a hundredth, on hair at rest.
fn drag(bencher: Bencher<'_, '_>, kind: &str, steps: &str, done: usize) {
    let mut session = Session::new();
    let mut length = 0.2;
    show(&mut session, asked(kind, length, steps, done), Quality::Exact);
    bencher.bench_local(|| {
        length *= 1.01;
        show(&mut session, asked(kind, length, steps, done), Quality::Coarse);
    });
}

/// A slider moves.
#[divan::bench(args = TYPES, sample_count = 10)]
fn coarse(bencher: Bencher<'_, '_>, kind: &str) {
    drag(bencher, kind, "", 0);
}

/// The same of wet hair that was cut.
#[divan::bench(args = ["caucasian-curly"], sample_count = 10)]
fn coarse_styled(bencher: Bencher<'_, '_>, kind: &str) {
    let steps = "[[step]]\nwet = {}\n[[step]]\ncut = { below = 'chin' }\n[[step]]\ndry = {}\n";
    drag(bencher, kind, steps, 3);
}

/// The first picture of a scene.
#[divan::bench(args = ["caucasian-curly"], sample_count = 3)]
fn first(bencher: Bencher<'_, '_>, kind: &str) {
    bencher.bench_local(|| {
        show(&mut Session::new(), asked(kind, 0.2, "", 0), Quality::Coarse);
    });
}

/// All hair, at rest.
#[divan::bench(args = TYPES, sample_count = 1)]
fn exact(bencher: Bencher<'_, '_>, kind: &str) {
    bencher.bench_local(|| {
        show(&mut Session::new(), asked(kind, 0.2, "", 0), Quality::Exact);
    });
}

/// Another clumping: other hairs around the same guides.
#[divan::bench(args = ["caucasian-curly"], sample_count = 2)]
fn redrawn(bencher: Bencher<'_, '_>, kind: &str) {
    let (mut session, mut clumping) = (Session::new(), 0.5);
    bencher.bench_local(|| {
        clumping *= 0.99;
        let wisps = format!("[wisps]\nclumping = {clumping}\n");
        show(&mut session, asked(kind, 0.2, &wisps, 0), Quality::Exact);
    });
}
