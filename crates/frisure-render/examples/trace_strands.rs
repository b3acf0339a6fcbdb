//! The path tracer on plain strands, without scene files, to be compared with other programs:
//!
//! ```text
//! trace_strands wig STYLE STRANDS POINTS OUT      a made-up head of hair
//! trace_strands picture STRANDS OUT [KEY=VALUE]…  its picture
//! ```
//!
//! A file of strands holds the number of strands and of points of each (u32), the radius (f32, m) and
//! the points (f32, m); a picture holds four f32 per pixel, premultiplied, rows from the top. All are
//! little-endian. `validation/render` says what is done with them.

#[path = "support/wig.rs"]
mod wig;

use std::error::Error;
use std::fs;
use std::io::Write as _;
use std::time::Instant;

use frisure_look::Melanin;
use frisure_look::{Background, Camera, DistantLight, EnvironmentLight, Lamp, Lights, SOFTBOX};
use frisure_render::trace::{TraceOptions, render};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::{DVec3, Vec3};
use wig::Style;

type Outcome<T> = Result<T, Box<dyn Error>>;

const USAGE: &str = "trace_strands wig STYLE STRANDS POINTS OUT | picture STRANDS OUT [KEY=VALUE]…";

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["wig", style, strands, points, out] => {
            write_wig(style, strands.parse()?, points.parse()?, out)
        }
        ["picture", strands, out, ref keys @ ..] => picture(strands, out, keys),
        _ => Err(USAGE.into()),
    }
}

fn write_wig(style: &str, strands: usize, points: usize, out: &str) -> Outcome<()> {
    let style = match style {
        "straight" => Style::STRAIGHT,
        "wavy" => Style::WAVY,
        "curly" => Style::CURLY,
        _ => return Err(format!("no style {style}: straight, wavy or curly").into()),
    };
    let wig = wig::strands(&style, strands, points);
    let counts = [strands as u32, points as u32].map(u32::to_le_bytes);
    let mut bytes: Vec<u8> = counts.concat();
    let numbers = wig.points().iter().flat_map(Vec3::to_array);
    let radius = wig.radii().first().copied();
    bytes.extend(radius.into_iter().chain(numbers).flat_map(f32::to_le_bytes));
    Ok(fs::write(out, bytes)?)
}

fn read_strands(path: &str) -> Outcome<Strands> {
    let bytes = fs::read(path)?;
    let words: Vec<[u8; 4]> = bytes.as_chunks().0.to_vec();
    let [strands, points, radius, ref numbers @ ..] = words[..] else {
        return Err(format!("{path} is too short for strands").into());
    };
    let [count, each] = [strands, points].map(|w| u32::from_le_bytes(w) as usize);
    let numbers: Vec<f32> = numbers.iter().copied().map(f32::from_le_bytes).collect();
    if each == 0 || numbers.len() != 3 * count * each {
        return Err(format!("{path} does not hold {count} strands of {each} points").into());
    }
    let points: Vec<Vec3> = numbers.as_chunks().0.iter().map(|p| Vec3::from(*p)).collect();
    let mut strands = Strands::with_capacity(count, count * each);
    for strand in points.chunks(each) {
        strands.push(strand, &vec![f32::from_le_bytes(radius); each]);
    }
    Ok(strands)
}

/// What the keys say, or their defaults.
struct Job {
    size: usize,
    samples: usize,
    bounces: u32,
    seed: u32,
    eye: DVec3,
    target: DVec3,
    /// Degrees.
    field_of_view: f64,
    /// Radiance from everywhere.
    environment: f32,
    /// Irradiance from one lamp, and the direction to it.
    lamp: f32,
    towards: DVec3,
    eumelanin: f32,
    axis_ratio: f32,
    /// Diffuse reflectance of the ball; none without.
    ball: Option<f32>,
}

impl Job {
    fn read(keys: &[&str]) -> Outcome<Self> {
        let mut job = Self {
            size: 256,
            samples: 16,
            bounces: 100,
            seed: 1,
            eye: DVec3::new(0.5, 0.87, 0.15),
            target: DVec3::new(0.0, 0.0, -0.03),
            field_of_view: 20.0,
            environment: 1.0,
            lamp: 0.0,
            towards: DVec3::Z,
            eumelanin: 0.0,
            axis_ratio: 1.0,
            ball: None,
        };
        for key in keys {
            let (name, value) = key.split_once('=').ok_or(format!("{key} is no KEY=VALUE"))?;
            job.set(name, value)?;
        }
        Ok(job)
    }

    fn set(&mut self, name: &str, value: &str) -> Outcome<()> {
        match name {
            "size" => self.size = value.parse()?,
            "samples" => self.samples = value.parse()?,
            "bounces" => self.bounces = value.parse()?,
            "seed" => self.seed = value.parse()?,
            "eye" => self.eye = vector(value)?,
            "target" => self.target = vector(value)?,
            "field_of_view" => self.field_of_view = value.parse()?,
            "room" => self.environment = value.parse()?,
            "lamp" => self.lamp = value.parse()?,
            "towards" => self.towards = vector(value)?,
            "eumelanin" => self.eumelanin = value.parse()?,
            "axis_ratio" => self.axis_ratio = value.parse()?,
            "ball" => self.ball = Some(value.parse()?),
            _ => return Err(format!("no key {name}").into()),
        }
        Ok(())
    }

    fn lights(&self) -> Outcome<Lights> {
        let lamp = DistantLight::new(self.towards, Vec3::splat(self.lamp), SOFTBOX)?;
        let lamps = if self.lamp > 0.0 { vec![Lamp::Distant(lamp)] } else { Vec::new() };
        let (sky, ground) = (Vec3::splat(self.environment), Vec3::splat(self.environment));
        Ok(Lights { lamps, environment: EnvironmentLight::Gradient { sky, ground } })
    }
}

fn vector(text: &str) -> Outcome<DVec3> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(str::parse).collect();
    let numbers: [f64; 3] = numbers?.try_into().map_err(|_| format!("{text} is no X,Y,Z"))?;
    Ok(numbers.into())
}

/// Makes fibres elliptical, directed at random.
fn flatten(strands: &mut Strands, axis_ratio: f32) -> Outcome<()> {
    let across = |p: &[Vec3]| (p[1] - p[0]).try_normalize().map(Vec3::any_orthonormal_vector);
    let d1: Vec<[f32; 3]> = (strands.iter())
        .flat_map(|s| {
            let ways = s.points.windows(2).map(|p| across(p).unwrap_or(Vec3::X).to_array());
            let ways: Vec<_> = ways.collect();
            ways.iter().chain(ways.last()).copied().collect::<Vec<_>>()
        })
        .collect();
    let ratios = vec![axis_ratio; strands.len()];
    for (name, domain, values) in [
        ("d1", Domain::Point, AttributeValues::F32x3(d1)),
        ("axis_ratio", Domain::Strand, AttributeValues::F32(ratios)),
    ] {
        strands.set_attribute(Attribute { name: name.into(), domain, values })?;
    }
    Ok(())
}

fn picture(path: &str, out: &str, keys: &[&str]) -> Outcome<()> {
    let job = Job::read(keys)?;
    let mut strands = read_strands(path)?;
    if job.axis_ratio != 1.0 {
        flatten(&mut strands, job.axis_ratio)?;
    }
    let ball = job.ball.map(|_| wig::ball());
    let mut scene = frisure_render::Scene::portrait(&strands, ball.as_ref());
    let fov = job.field_of_view.to_radians();
    scene.camera = Camera::look_at(job.eye, job.target, DVec3::Z, fov)?;
    scene.lights = job.lights()?;
    scene.look.background = Background::Transparent;
    scene.look.hair.melanin = Melanin { eumelanin: job.eumelanin, pheomelanin: 0.0 };
    scene.look.hair.variation = 0.0;
    scene.look.skin.gloss = 0.0;
    scene.look.skin.colour = Vec3::splat(job.ball.unwrap_or(0.0));
    let (width, height) = (job.size, job.size);
    let Job { samples, bounces, seed, .. } = job;
    let options = TraceOptions { width, height, samples, noise: None, bounces, clamp: None, seed };
    let start = Instant::now();
    let image = render(&scene, &options, &())?;
    writeln!(std::io::stdout().lock(), "{:.2} s", start.elapsed().as_secs_f64())?;
    let bytes: Vec<u8> = image.pixels().iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    Ok(fs::write(out, bytes)?)
}
