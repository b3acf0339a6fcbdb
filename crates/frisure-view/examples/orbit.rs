//! Draws a made-up head of hair from all around and says how fast:
//! `orbit [STRANDS] [FRAMES] [WIDTHxHEIGHT] [SHARE] [none|coarse|fine]`.

mod support;
#[path = "../../frisure-render/examples/support/wig.rs"]
mod wig;

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write as _;
use std::time::Instant;

use frisure_look::{Camera, Lights, Look};
use frisure_view::{Canvas, Frame, Hair, Shadows, Skin};
use glam::DVec3;
use support::Gpu;

/// Points of each strand.
const POINTS: usize = 16;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let get = |i: usize, default: &str| arguments.get(i).map_or(default.to_owned(), Clone::clone);
    let count: usize = get(0, "20000").parse()?;
    let frames: u32 = get(1, "20").parse()?;
    let size = get(2, "1280x800");
    let (width, height) = size.split_once('x').ok_or("WIDTHxHEIGHT")?;
    let size = [width.parse::<u32>()?, height.parse::<u32>()?];
    let share: f32 = get(3, "1").parse()?;
    let shadows = match get(4, "fine").as_str() {
        "none" => Shadows::None,
        "coarse" => Shadows::Coarse,
        _ => Shadows::Fine,
    };
    let (strands, ball) = (wig::strands(&wig::Style::STRAIGHT, count, POINTS), wig::ball());
    let bounds = frisure_render::framed_bounds(&strands, Some(&ball));
    let first = Camera::framing(bounds, 0.0, 0.1, f64::from(size[0]) / f64::from(size[1]));
    let look = Look::default();

    let gpu = Gpu::new().ok_or("no adapter")?;
    let start = Instant::now();
    let hair = Hair::new(&gpu.renderer, &gpu.device, &gpu.queue, &strands, &look.hair);
    let skin = Skin::new(&gpu.renderer, &gpu.device, &gpu.queue, &ball);
    let made = start.elapsed().as_secs_f64();
    let mut canvas = Canvas::new(&gpu.device, size)?;
    let mut draw = |i: u32| {
        let camera = first.turned(DVec3::ZERO, TAU * f64::from(i) / f64::from(frames.max(1)));
        let lights = Lights::studio(&camera);
        let frame = Frame {
            hair: Some(&hair),
            skin: Some(&skin),
            share,
            shadows,
            ..Frame::new(camera, &lights, &look)
        };
        let start = Instant::now();
        gpu.draw(&mut canvas, &frame);
        let submitted = start.elapsed().as_secs_f64();
        gpu.wait();
        (submitted, start.elapsed().as_secs_f64())
    };
    let (_, begun) = draw(0);
    let times: Vec<(f64, f64)> = (0..frames).map(&mut draw).collect();
    let mut out = std::io::stdout().lock();
    let info = gpu.adapter.get_info();
    writeln!(out, "{} ({}, {})", info.name, info.backend, info.driver_info)?;
    writeln!(out, "{} strands, {} vertices, made in {made:.2} s", hair.strands(), hair.vertices())?;
    let sum = |of: fn(&(f64, f64)) -> f64| times.iter().map(of).sum::<f64>();
    let (submitted, all) = (sum(|t| t.0), sum(|t| t.1));
    let n = f64::from(frames.max(1));
    writeln!(
        out,
        "first {begun:.3} s, then {:.1} frames/s: {:.1} ms each, {:.1} ms of them before the device",
        n / all,
        1e3 * all / n,
        1e3 * submitted / n
    )?;
    Ok(())
}
