//! Writing a whole head of hair: 100 000 strands of 30 points.

use frisure_files::frame::FrameChoice;
use frisure_formats::groom::{Groom, read_groom, write_groom};
use frisure_strands::Strands;
use glam::Vec3;

fn main() {
    divan::main();
}

fn head() -> Groom {
    let (count, points) = (100_000_u32, 30_u32);
    let mut strands = Strands::with_capacity(count as usize, (count * points) as usize);
    for i in 0..count {
        let turn = f64::from(i) * 2.399;
        let line: Vec<Vec3> = (0..points)
            .map(|k| {
                let s = 0.01 * f64::from(k);
                let (x, y) = (0.1 * turn.cos() + 0.01 * (30.0 * s).sin(), 0.1 * turn.sin());
                Vec3::new(x as f32, y as f32, (0.15 - s) as f32)
            })
            .collect();
        strands.push(&line, &[35e-6; 30]);
    }
    Groom::of(strands)
}

#[divan::bench(args = ["hair", "ply", "obj", "usdc", "usda", "abc", "data", "npz", "txt", "pbrt", "glb"], sample_count = 10)]
fn write(bencher: divan::Bencher, extension: &str) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(format!("head.{extension}"));
    let strands = head();
    bencher.bench_local(|| {
        write_groom(&path, &strands, FrameChoice::default()).expect("it is written");
    });
}

#[divan::bench(args = ["hair", "ply", "obj", "usdc", "usda", "abc", "data", "npz"], sample_count = 10)]
fn read(bencher: divan::Bencher, extension: &str) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(format!("head.{extension}"));
    write_groom(&path, &head(), FrameChoice::default()).expect("it is written");
    bencher.bench_local(|| read_groom(&path, FrameChoice::default()).expect("it is read"));
}
