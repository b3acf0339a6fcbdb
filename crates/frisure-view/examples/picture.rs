//! Draws a groom file on the mannequin, in the interactive view and, beside it, in the preview:
//! `picture GROOM OUT.png [COLOUR] [AZIMUTH_DEG] [WIDTHxHEIGHT] [ZOOM] [SHARE] [wet]`.

mod support;

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::time::Instant;

use frisure_hairstyle::head::Head;
use frisure_look::Shade;
use frisure_look::{Camera, Lights};
use frisure_render::preview;
use frisure_strands::{Attribute, AttributeValues, Domain};
use frisure_view::{Frame, Hair, Skin};
use glam::DVec3;
use support::Gpu;
use support::measure::compare;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let get = |i: usize, default: &str| arguments.get(i).map_or(default.to_owned(), Clone::clone);
    let mut strands =
        frisure_formats::groom::read_groom(Path::new(&get(0, "groom.hair")), Default::default())?
            .hairs;
    let shade = Shade::named(&get(2, "brown")).ok_or("no such colour")?;
    let azimuth = get(3, "30").parse::<f64>()?.to_radians();
    let size = get(4, "640x640");
    let (width, height) = size.split_once('x').ok_or("WIDTHxHEIGHT")?;
    let size = [width.parse::<u32>()?, height.parse::<u32>()?];
    let zoom: f64 = get(5, "1").parse()?;
    let share: f32 = get(6, "1").parse()?;
    if get(7, "") == "wet" {
        let values = AttributeValues::F32(vec![1.0; strands.points().len()]);
        strands.set_attribute(Attribute {
            name: "wetness".into(),
            domain: Domain::Point,
            values,
        })?;
    }
    let head = Head::mannequin();

    let mut scene = frisure_render::Scene::portrait(&strands, Some(head.surface()));
    let (low, high) = frisure_render::framed_bounds(&strands, Some(head.surface()));
    let (centre, half) = (0.5 * (low + high), 0.5 * (high - low) / zoom);
    let lift = DVec3::Z * if zoom > 1.0 { 0.25 * (high.z - low.z) } else { 0.0 };
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let bounds = (centre - half + lift, centre + half + lift);
    scene.camera = Camera::framing(bounds, azimuth, 0.08, aspect);
    scene.lights = Lights::studio(&scene.camera);
    scene.look.hair.melanin = shade.melanin;
    scene.look.hair.white_share = shade.white_share;

    let gpu = Gpu::new().ok_or("no adapter")?;
    let start = Instant::now();
    let hair = Hair::new(&gpu.renderer, &gpu.device, &gpu.queue, &strands, &scene.look.hair);
    let skin = Skin::new(&gpu.renderer, &gpu.device, &gpu.queue, head.surface());
    let made = start.elapsed().as_secs_f64();
    let frame = Frame {
        hair: Some(&hair),
        skin: Some(&skin),
        share,
        ..Frame::new(scene.camera, &scene.lights, &scene.look)
    };
    let start = Instant::now();
    let view = gpu.picture(&frame, size)?;
    let drawn = start.elapsed().as_secs_f64();
    let options = preview::PreviewOptions {
        width: size[0] as usize,
        height: size[1] as usize,
        ..Default::default()
    };
    let image = preview::render(&scene, &options, &())?;
    let empty = gpu.picture(&Frame::new(scene.camera, &scene.lights, &scene.look), size)?;
    let difference = compare(&image.to_srgb8(), &view, &empty, size);
    let info = gpu.adapter.get_info();
    writeln!(
        std::io::stdout().lock(),
        "{} ({}): {} strands, {} vertices: made {made:.2} s, drawn {drawn:.2} s\n{difference:.4?}",
        info.name,
        info.backend,
        hair.strands(),
        hair.vertices()
    )?;
    let row = 4 * size[0] as usize;
    let (left, right) = (image.to_srgb8(), view);
    let rows = left.chunks(row).zip(right.chunks(row));
    let both: Vec<u8> = rows.flat_map(|(a, b)| [a, b].concat()).collect();
    let out = BufWriter::new(File::create(get(1, "picture.png"))?);
    let mut encoder = png::Encoder::new(out, 2 * size[0], size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(&both)?;
    Ok(())
}
