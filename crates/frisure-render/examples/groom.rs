//! Draws a made-up head of hair: `groom STYLE COLOUR OUT.png [AZIMUTH_DEG] [STRANDS] [SIZE] [HEAD.obj]`,
//! with STYLE straight, wavy or curly and COLOUR blond, red, brown, black or white.

#[path = "support/wig.rs"]
mod wig;

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::time::Instant;

use frisure_look::Melanin;
use frisure_look::{Camera, Lights};
use frisure_render::preview;
use wig::Style;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let get = |i: usize, default: &str| arguments.get(i).map_or(default.to_owned(), Clone::clone);
    let style = match get(0, "wavy").as_str() {
        "straight" => Style::STRAIGHT,
        "curly" => Style::CURLY,
        _ => Style::WAVY,
    };
    let melanin = match get(1, "brown").as_str() {
        "blond" => Melanin::BLOND,
        "red" => Melanin::RED,
        "black" => Melanin::BLACK,
        "white" => Melanin::WHITE,
        _ => Melanin::BROWN,
    };
    let azimuth = get(3, "30").parse::<f64>()?.to_radians();
    let size: usize = get(5, "1024").parse()?;
    let strands = wig::strands(&style, get(4, "100000").parse()?, 20);
    let head = match arguments.get(6) {
        Some(path) => wig::read_head(path)?,
        None => wig::ball(),
    };

    let mut scene = frisure_render::Scene::portrait(&strands, Some(&head));
    let bounds = frisure_render::framed_bounds(&strands, Some(&head));
    scene.camera = Camera::framing(bounds, azimuth, 0.1, 1.0);
    scene.lights = Lights::studio(&scene.camera);
    scene.look.hair.melanin = melanin;
    let options = preview::PreviewOptions { width: size, height: size, ..Default::default() };
    let start = Instant::now();
    let image = preview::render(&scene, &options, &())?;
    let seconds = start.elapsed().as_secs_f64();
    writeln!(std::io::stdout().lock(), "{} points, {seconds:.2} s", strands.points().len())?;

    let out = BufWriter::new(File::create(get(2, "groom.png"))?);
    let mut encoder = png::Encoder::new(out, size as u32, size as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(&image.to_srgb8())?;
    Ok(())
}
