//! Pictures of a head from four sides, its scalp tinted: `head_views OUT.png [MESH.obj]`.
//!
//! The mesh is in metres, y up and z forward, as modelling programs export it.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fs::File;
use std::io::BufWriter;

use frisure_hairstyle::head::{Head, ScalpSource};
use frisure_strands::Surface;
use glam::{DMat3, DVec3};

const SIZE: usize = 560;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let out = arguments.next().unwrap_or_else(|| "head.png".into());
    let head = match arguments.next() {
        Some(path) => Head::from_surface(read_obj(&path)?, ScalpSource::Guess)?,
        None => Head::mannequin(),
    };
    let tint = std::env::var_os("PLAIN").is_none();
    let views = [0.0, 0.7, FRAC_PI_2, PI];
    let mut image = vec![0; 4 * SIZE * SIZE * 3];
    for (column, turn) in views.into_iter().enumerate() {
        let view = View::new(&head, turn, tint);
        for y in 0..SIZE {
            for x in 0..SIZE {
                let at = (y * views.len() * SIZE + column * SIZE + x) * 3;
                image[at..at + 3].copy_from_slice(&view.pixels[y * SIZE + x]);
            }
        }
    }
    let mut encoder =
        png::Encoder::new(BufWriter::new(File::create(out)?), (4 * SIZE) as u32, SIZE as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&image)?;
    Ok(())
}

/// One picture, seen from the front turned by an angle to the head's left.
struct View {
    pixels: Vec<[u8; 3]>,
}

impl View {
    fn new(head: &Head, turn: f64, tint: bool) -> Self {
        let surface = head.surface();
        let (low, high) = surface.bounds();
        let zoom: f64 = std::env::var("ZOOM").ok().and_then(|z| z.parse().ok()).unwrap_or(1.0);
        let look = std::env::var("LOOK").ok().and_then(|z| z.parse().ok());
        let height = look.unwrap_or(0.5 * (low.z + high.z));
        let middle = DVec3::new(0.0, 0.5 * (low.y + high.y), height);
        let scale = zoom * 0.92 * SIZE as f64 / (high.z - low.z).max(high.x - low.x);
        let rotation = DMat3::from_rotation_z(-turn);
        let normals = surface.vertex_normals();
        let mut depth = vec![f64::INFINITY; SIZE * SIZE];
        let mut pixels = vec![[238, 238, 240]; SIZE * SIZE];
        for triangle in surface.triangles() {
            let c = triangle.map(|v| rotation * (surface.positions()[v as usize] - middle));
            let screen = c.map(|p| {
                let half = SIZE as f64 / 2.0;
                [half + scale * p.x, half - scale * p.z]
            });
            fill(screen, |x, y, w| {
                let mix = |v: [f64; 3]| v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
                let d = mix(c.map(|p| p.y));
                let at = y * SIZE + x;
                if d < depth[at] {
                    depth[at] = d;
                    let index = triangle.map(|v| v as usize);
                    let n = (0..3).map(|i| normals[index[i]] * w[i]).sum::<DVec3>().normalize();
                    let p = (0..3).map(|i| surface.positions()[index[i]] * w[i]).sum();
                    let hair = if tint { mix(index.map(|v| head.scalp()[v])) } else { 0.0 };
                    pixels[at] = shade(head, p, n, rotation * n, hair);
                }
            });
        }
        Self { pixels }
    }
}

fn shade(head: &Head, p: DVec3, normal: DVec3, seen: DVec3, hair: f64) -> [u8; 3] {
    // Light that reaches a point from above it: what the distance lacks some way out is blocked.
    let open = [0.004, 0.01, 0.02, 0.04]
        .map(|h| (head.signed_distance().value(p + normal * h) / h).clamp(0.0, 1.0));
    let sky = open.iter().product::<f64>().powf(0.6);
    let key = seen.dot(DVec3::new(-0.45, -0.65, 0.6).normalize()).max(0.0);
    let fill = seen.dot(DVec3::new(0.8, -0.5, 0.1).normalize()).max(0.0);
    let light = sky * (0.30 + 0.12 * seen.z) + key * (0.4 + 0.6 * sky) * 0.75 + 0.12 * fill;
    let skin = DVec3::new(0.86, 0.66, 0.54).lerp(DVec3::new(0.25, 0.35, 0.65), 0.75 * hair);
    (skin * light).to_array().map(|c| (255.0 * c.clamp(0.0, 1.0).powf(1.0 / 2.0)) as u8)
}

fn fill(s: [[f64; 2]; 3], mut pixel: impl FnMut(usize, usize, [f64; 3])) {
    let area =
        (s[1][0] - s[0][0]) * (s[2][1] - s[0][1]) - (s[2][0] - s[0][0]) * (s[1][1] - s[0][1]);
    let bound = |a: usize, f: fn(f64, f64) -> f64| {
        f(f(s[0][a], s[1][a]), s[2][a]).clamp(0.0, SIZE as f64 - 1.0)
    };
    for y in bound(1, f64::min) as usize..=bound(1, f64::max) as usize {
        for x in bound(0, f64::min) as usize..=bound(0, f64::max) as usize {
            let p = [x as f64 + 0.5, y as f64 + 0.5];
            let part = |a: [f64; 2], b: [f64; 2]| {
                ((b[0] - a[0]) * (p[1] - a[1]) - (p[0] - a[0]) * (b[1] - a[1])) / area
            };
            let w = [part(s[1], s[2]), part(s[2], s[0]), part(s[0], s[1])];
            if w.iter().all(|w| *w >= -1e-9) {
                pixel(x, y, w);
            }
        }
    }
}

fn read_obj(path: &str) -> Result<Surface, Box<dyn Error>> {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in std::fs::read_to_string(path)?.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let v: Vec<f64> = words.take(3).map(str::parse).collect::<Result<_, _>>()?;
                positions.push(DVec3::new(v[0], -v[2], v[1]));
            }
            Some("f") => {
                let index = |w: &str| w.split('/').next().unwrap_or("").parse::<u32>();
                let face: Vec<u32> = words.map(index).collect::<Result<_, _>>()?;
                for i in 1..face.len() - 1 {
                    triangles.push([face[0] - 1, face[i] - 1, face[i + 1] - 1]);
                }
            }
            _ => {}
        }
    }
    Ok(Surface::new(positions, triangles)?)
}
