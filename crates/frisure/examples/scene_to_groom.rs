//! A scene as text, predicted, styled and written as a groom that other programs read.
//!
//! `cargo run --release -p frisure --example scene_to_groom`

#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use frisure::files::frame::FrameChoice;
use frisure::formats::groom::{Groom, write_groom};
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{
    PredictOptions, StrandOptions, StyleOptions, predict, settling_report, strands, style,
};
use frisure::scene::Scene;

const SCENE: &str = r#"
    hair = { type = "caucasian-wavy", length = "22 cm" }
    wisps = { count = 80, hairs = 4000 }

    [[step]]
    wet = {}
    [[step]]
    cut = { below = "chin" }
    [[step]]
    dry = {}
"#;

fn main() -> Result<(), Box<dyn Error>> {
    // 1. Read: a checked description of the hair, and the operations on it.
    let scene = Scene::parse("bob.toml", SCENE, "".as_ref())?;
    let head = Head::mannequin();

    // 2. Predict: each guide comes to the minimum of its energy.
    let mut hair = predict(&scene.hairstyle_spec()?, &head, PredictOptions::default(), &())?;

    // 3. Style: each operation gives another hairstyle, at rest again.
    for step in scene.steps() {
        hair = style(&hair, &head, step, StyleOptions::default(), &())?;
        let report = settling_report(&hair, &head);
        println!("{}: {} of {} guides are at rest", step.name(), report.stable, report.guides);
    }

    // 4. Interpolate the drawn hairs, and write them in two formats.
    let hairs = strands(&hair, &head, StrandOptions::default(), &())?.strands;
    println!("{} strands of {} points in all", hairs.len(), hairs.points().len());
    let groom = Groom { name: "bob".into(), ..Groom::of(hairs) };
    for name in ["frisure-example.hair", "frisure-example.usda"] {
        let path = std::env::temp_dir().join(name);
        write_groom(&path, &groom, FrameChoice::default())?;
        println!("{}: {} kB", path.display(), std::fs::metadata(&path)?.len() / 1000);
        std::fs::remove_file(&path)?;
    }
    Ok(())
}
