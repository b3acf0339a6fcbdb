//! A made-up head of hair, until true ones exist: wisps that leave a ball along its normal, turn
//! towards gravity and slide on the ball, with helices around their paths.

#![allow(dead_code, reason = "shared by programs that each use a part")]
#![allow(unreachable_pub, reason = "as above")]

use std::error::Error;
use std::f32::consts::TAU;

use frisure_strands::{Attribute, AttributeValues, Domain, Strands, Surface};
use glam::{DVec3, Vec3};

/// Radius of the ball (m).
pub const RADIUS: f32 = 0.09;

/// How the hair of a wig falls.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    wisps: usize,
    length: f32,
    curl_radius: f32,
    curl_pitch: f32,
    /// How closely the strands of a wisp keep together at their tips, 0 to 1.
    clump: f32,
    /// Part of the strands that leave their wisp.
    stray: f32,
}

impl Style {
    pub const STRAIGHT: Self = Self {
        wisps: 900,
        length: 0.30,
        curl_radius: 0.0006,
        curl_pitch: 0.09,
        clump: 0.55,
        stray: 0.05,
    };
    pub const WAVY: Self = Self {
        wisps: 500,
        length: 0.26,
        curl_radius: 0.005,
        curl_pitch: 0.06,
        clump: 0.7,
        stray: 0.06,
    };
    pub const CURLY: Self = Self {
        wisps: 400,
        length: 0.22,
        curl_radius: 0.0065,
        curl_pitch: 0.027,
        clump: 0.75,
        stray: 0.06,
    };
}

/// A small generator of random numbers (PCG-like), enough for a wig.
struct Dice(u64);

impl Dice {
    fn uniform(&mut self) -> f32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let x = ((self.0 >> 33) ^ (self.0 >> 51)) as u32 & 0x00ff_ffff;
        x as f32 / 16_777_216.0
    }

    fn normal(&mut self) -> f32 {
        (0..12).map(|_| self.uniform()).sum::<f32>() - 6.0
    }

    fn direction(&mut self) -> Vec3 {
        Vec3::new(self.normal(), self.normal(), self.normal()).normalize_or(Vec3::Z)
    }
}

const STEPS: usize = 160;

/// `count` strands of `points` points each, in wisps (attribute `guide`).
pub fn strands(style: &Style, count: usize, points: usize) -> Strands {
    let mut dice = Dice(20_261_121);
    let mut strands = Strands::with_capacity(count, count * points);
    let mut guide = Vec::with_capacity(count);
    for wisp in 0..style.wisps {
        let normal = scalp(&mut dice);
        let members = count / style.wisps + usize::from(wisp < count % style.wisps);
        grow_wisp(style, normal, members, points, &mut dice, &mut strands);
        guide.extend(std::iter::repeat_n(wisp as u32, members));
    }
    let values = AttributeValues::U32(guide);
    let guide = Attribute { name: "guide".into(), domain: Domain::Strand, values };
    strands.set_attribute(guide).expect("one guide per strand");
    strands
}

/// A direction in which hair grows: not the face, not the neck.
fn scalp(dice: &mut Dice) -> Vec3 {
    loop {
        let n = dice.direction();
        if n.z > -0.3 && n.y > 1.05 - 1.75 * n.z.max(0.0) - 1.0 * (n.x.abs() + 0.2) {
            return n;
        }
    }
}

fn grow_wisp(
    style: &Style,
    normal: Vec3,
    members: usize,
    points: usize,
    dice: &mut Dice,
    out: &mut Strands,
) {
    let layer = 0.004 + 0.016 * normal.z.max(0.0) + 0.006 * dice.uniform();
    let jitter = 0.15 * Vec3::new(dice.normal(), dice.normal(), dice.normal());
    let h = style.length / STEPS as f32;
    let path = path(normal, layer, jitter, h);
    let path = &path[..];
    let frames = frames(path);
    let (phase, turn) = (TAU * dice.uniform(), if dice.uniform() < 0.5 { 1.0 } else { -1.0 });
    let pitch = style.curl_pitch * (0.8 + 0.4 * dice.uniform());
    let radius = style.curl_radius * (0.7 + 0.6 * dice.uniform());
    let width = 0.0115 * (400.0 / style.wisps as f32).sqrt();
    for _ in 0..members {
        let (angle, r) = (TAU * dice.uniform(), dice.uniform().sqrt());
        let stray = dice.uniform() < style.stray;
        let spread = width * r * if stray { 1.8 } else { 1.0 };
        let own_phase = phase + dice.normal() * if stray { 0.8 } else { 0.25 };
        let own_radius = radius * (1.0 + dice.normal() * if stray { 0.35 } else { 0.12 });
        let drift = if stray { 0.006 * dice.direction() } else { 0.001 * dice.direction() };
        let length = 1.0 - 0.18 * dice.uniform().powi(2);
        let strand: Vec<Vec3> = (0..points)
            .map(|k| {
                let x = k as f32 / (points - 1) as f32 * length * (STEPS as f32 - 1e-3);
                let (i, f) = (x as usize, x.fract());
                let s = x * h;
                let [u, b] = [0, 1].map(|c| frames[i][c].lerp(frames[i + 1][c], f));
                let close = 1.0 - style.clump * (1.0 - (-s / 0.04).exp());
                let grown = 1.0 - (-(s / 0.025).powi(2)).exp();
                let turned = own_phase + turn * TAU * s / pitch;
                let p = path[i].lerp(path[i + 1], f)
                    + spread * close * (angle.cos() * u + angle.sin() * b)
                    + own_radius * grown * (turned.cos() * u + turned.sin() * b)
                    + drift * grown;
                if k == 0 {
                    p.normalize() * (RADIUS - 0.0005)
                } else {
                    p.clamp_length_min(RADIUS + 1e-4)
                }
            })
            .collect();
        out.push(&strand, &vec![4e-5; points]);
    }
}

/// The way of a wisp: out along the normal, over to gravity, sliding on a ball.
fn path(normal: Vec3, layer: f32, jitter: Vec3, h: f32) -> Vec<Vec3> {
    let mut p = RADIUS * normal;
    // Combed away from a parting, and back at the front.
    let side = if normal.x >= 0.015 { Vec3::X } else { -Vec3::X };
    let back = 0.9 * (0.35 - normal.y).max(0.0) * Vec3::Y;
    let mut d = (0.45 * normal + (0.8 * side + back) * normal.z.max(0.0) + jitter).normalize();
    let mut path = vec![p];
    for i in 0..STEPS {
        let g = -Vec3::Z;
        d = (d + 42.0 * h * (g - g.dot(d) * d)).normalize();
        let mut q = p + h * d;
        let need = RADIUS + layer.min(0.0002 + 0.35 * (i + 1) as f32 * h);
        if q.length() < need {
            q = q.normalize() * need;
            d = (q - p).normalize();
            q = p + h * d;
        }
        p = q;
        path.push(p);
    }
    path
}

/// Two directions across the path at each of its points, turning as little as they can.
fn frames(path: &[Vec3]) -> Vec<[Vec3; 2]> {
    let mut u = (path[1] - path[0]).any_orthogonal_vector().normalize();
    (0..path.len())
        .map(|i| {
            let t = (path[(i + 1).min(path.len() - 1)] - path[i.saturating_sub(1)]).normalize();
            u = (u - u.dot(t) * t).normalize_or(t.any_orthonormal_vector());
            [u, t.cross(u)]
        })
        .collect()
}

/// The ball on which a wig grows.
pub fn ball() -> Surface {
    const N: u32 = 96;
    let point = |i: u32, j: u32| {
        let (st, ct) = (f64::from(i) / f64::from(N) * std::f64::consts::PI).sin_cos();
        let (sp, cp) = (f64::from(j) / f64::from(N) * std::f64::consts::TAU).sin_cos();
        f64::from(RADIUS) * DVec3::new(st * cp, st * sp, ct)
    };
    let positions = (0..=N).flat_map(|i| (0..N).map(move |j| point(i, j))).collect();
    let quads = (0..N).flat_map(|i| (0..N).map(move |j| (i, j)));
    let triangles = quads
        .flat_map(|(i, j)| {
            let k = (j + 1) % N;
            let [a, b, c, d] = [i * N + j, i * N + k, (i + 1) * N + j, (i + 1) * N + k];
            [[a, c, d], [a, d, b]]
        })
        .collect();
    Surface::new(positions, triangles).expect("a ball is a surface")
}

/// A head from a Wavefront file (metres, y up, z forward), moved so that a wig fits on it.
pub fn read_head(path: &str) -> Result<Surface, Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let [x, y, z] = [0; 3].map(|_| words.next().and_then(|w| w.parse().ok()));
                let (Some(x), Some(y), Some(z)) = (x, y, z) else { continue };
                positions.push(DVec3::new(x, -f64::from(z as f32), y));
            }
            Some("f") => {
                let index = |w: &str| w.split('/').next().and_then(|i| i.parse::<u32>().ok());
                let corners: Vec<u32> = words.filter_map(index).map(|i| i - 1).collect();
                for i in 2..corners.len() {
                    triangles.push([corners[0], corners[i - 1], corners[i]]);
                }
            }
            _ => {}
        }
    }
    let top = positions.iter().fold(f64::NEG_INFINITY, |m, p: &DVec3| m.max(p.z));
    for p in &mut positions {
        *p = (*p - DVec3::new(0.0, -0.035, top)) * 0.95 + DVec3::Z * (f64::from(RADIUS) + 0.002);
    }
    Ok(Surface::new(positions, triangles)?)
}
