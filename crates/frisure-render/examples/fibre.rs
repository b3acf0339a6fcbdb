//! Three fibres, much magnified, that differ in nothing but their section: `fibre OUT.png [PATHS]`.
//!
//! A wave turns its section with it, so that where an ellipse shows its long side and where its short
//! one changes along the fibre: the glints of an ellipse come and go where those of a circle are even.

use std::error::Error;
use std::f32::consts::TAU;
use std::fs::File;
use std::io::BufWriter;

use frisure_look::Melanin;
use frisure_look::{Background, Camera, Lights};
use frisure_render::Scene;
use frisure_render::trace::{TraceOptions, render};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::{DVec3, Vec3};

/// Axis ratios of the three.
const RATIOS: [f32; 3] = [1.0, 1.4, 1.8];

/// Points of a fibre.
const POINTS: u16 = 400;

/// Mean radius (m): a hair of 0.07 mm, seen from so near, has the same optics.
const RADIUS: f32 = 6e-4;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let out = arguments.first().ok_or("fibre OUT.png [PATHS]")?;
    let samples = arguments.get(1).map_or(Ok(512), |paths| paths.parse())?;
    let strands = fibres()?;
    let mut scene = Scene::portrait(&strands, None);
    let target = DVec3::new(0.0, 0.0, 0.0);
    scene.camera = Camera::look_at(DVec3::new(0.0, -0.3, 0.02), target, DVec3::Z, 0.082)?;
    scene.lights = Lights::studio(&scene.camera);
    scene.look.hair.melanin = Melanin { eumelanin: 0.35, pheomelanin: 0.1 };
    scene.look.hair.variation = 0.0;
    let grey = Vec3::splat(0.02);
    scene.look.background = Background::Gradient { centre: grey, corner: grey };
    let (width, height) = (1024, 640);
    let options = TraceOptions { width, height, samples, ..TraceOptions::default() };
    let image = render(&scene, &options, &())?;
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(out)?), 1024, 640);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(&image.to_srgb8())?;
    Ok(())
}

/// Waves along x, one above the other, that turn about their axes: d1 points to the inside of the curl.
fn fibres() -> Result<Strands, Box<dyn Error>> {
    let mut strands = Strands::new();
    let mut directors = Vec::new();
    for i in 0..RATIOS.len() {
        let height = 7.5e-3 * (1.0 - i as f32);
        let turn = |k: u16| TAU * 3.0 * f32::from(k) / f32::from(POINTS - 1);
        let way = |k: u16| Vec3::new(0.0, turn(k).cos(), turn(k).sin());
        let along = |k: u16| 0.046 * (f32::from(k) / f32::from(POINTS - 1) - 0.5);
        let point = |k: u16| Vec3::new(along(k), 0.0, height) + 1.6e-3 * way(k);
        let points: Vec<Vec3> = (0..POINTS).map(point).collect();
        strands.push(&points, &[RADIUS; POINTS as usize]);
        directors.extend((0..POINTS).map(|k| way(k).to_array()));
    }
    for (name, domain, values) in [
        ("d1", Domain::Point, AttributeValues::F32x3(directors)),
        ("axis_ratio", Domain::Strand, AttributeValues::F32(RATIOS.to_vec())),
    ] {
        strands.set_attribute(Attribute { name: name.into(), domain, values })?;
    }
    Ok(strands)
}
