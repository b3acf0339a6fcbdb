//! Strands to a picture, in a PNG file.
//!
//! ```sh
//! cargo run --release -p frisure-render --example first_picture -- [PNG]
//! ```
//!
//! A lock of wavy blond hair, drawn by the preview and lit by a portrait studio.

#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::fs::File;

use frisure_look::Melanin;
use frisure_render::Scene;
use frisure_render::preview::{PreviewOptions, render};
use frisure_strands::Strands;
use glam::Vec3;

/// Strands of the lock.
const COUNT: u16 = 3000;

/// Points of a strand.
const POINTS: u16 = 60;

fn main() -> Result<(), Box<dyn Error>> {
    // 1. Strands: points (m) from root to tip, and the radius (m) at each.
    let mut strands = Strands::new();
    for i in 0..COUNT {
        let (ring, turn) = ((f32::from(i) / f32::from(COUNT)).sqrt(), 2.4 * f32::from(i));
        let root = 0.02 * ring * Vec3::new(turn.cos(), turn.sin(), 0.0);
        let strand = (0..POINTS).map(|k| {
            let s = f32::from(k) / f32::from(POINTS - 1);
            let wave = 0.012 * s * Vec3::new((14.0 * s).sin(), 0.5 * (9.0 * s).cos(), 0.0);
            root * (1.0 - 0.6 * s) + wave - 0.25 * s * Vec3::Z
        });
        strands.push(&strand.collect::<Vec<Vec3>>(), &vec![3.5e-5; usize::from(POINTS)]);
    }

    // 2. The scene: a camera that frames the strands, a studio, and the material of the hair.
    let mut scene = Scene::portrait(&strands, None);
    scene.look.hair.melanin = Melanin::BLOND;

    // 3. The picture. `frisure_render::trace::render` makes the final one.
    let options = PreviewOptions { width: 600, height: 600, ..PreviewOptions::default() };
    let image = render(&scene, &options, &())?;

    // 4. The file.
    let path = std::env::args().nth(1).unwrap_or_else(|| "lock.png".to_owned());
    let mut encoder = png::Encoder::new(File::create(&path)?, 600, 600);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(&image.to_srgb8())?;
    println!("{path}");
    Ok(())
}
