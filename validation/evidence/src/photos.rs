//! Photos of locks whose curl is known: hairs at equilibrium, rendered in front of a plain background, with blur and noise.

use std::f64::consts::TAU;

use frisure::hairstyle::{Ellipticity, PRESETS, Preset};
use frisure::look::{Background, Camera, HairLook, Lights, Look, Shade};
use frisure::measure::Fibre;
use frisure::render::Scene;
use frisure::render::preview::{PreviewOptions, render};
use frisure::rod::{
    Load, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Section, SplitMix64, equilibrium,
};
use frisure::strands::Strands;
use glam::{DMat3, DVec2, DVec3, Vec3};

use crate::Stopped;
use crate::random::stream;

/// A lock in front of a plain background, and what is known of it.
#[derive(Clone, Debug)]
pub struct KnownLock {
    /// The hair type.
    pub preset: &'static Preset,
    /// Radius and pitch of the natural curl (m).
    pub natural: [f64; 2],
    /// Length of the hairs (m).
    pub length: f64,
    /// The fibre as it is, its spread 0.
    pub fibre: Fibre,
    /// Number of hairs.
    pub hairs: usize,
    /// Radius and pitch as it hangs (m): root mean square distance from the axis, and length of the axis per turn, of the lower nine tenths.
    pub hanging: [f64; 2],
    /// Turns as it hangs.
    pub turns: f64,
}

/// A photo of a lock.
#[derive(Clone, Debug)]
pub struct KnownPhoto {
    /// The lock.
    pub lock: KnownLock,
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Rows from the top, three bytes (sRGB) per pixel.
    pub rgb: Vec<u8>,
    /// Pixels per metre where the lock is.
    pub scale: f64,
}

/// Spread of the phase between the hairs of a lock (rad), as a whole and along it, and of places, of the natural radius. Chosen: locks whose hairs run together.
const PHASE: [f64; 2] = [0.1, 0.4];
const PHASE_ALONG: f64 = 0.25;
const PLACE: [f64; 2] = [0.05, 0.3];

/// Normal with deviation 1, by the sum of twelve.
fn normal(random: &mut SplitMix64) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// The lock with a seed: a hair type, a curl near that of the type, a fibre, a length of 4 to 12 turns (5 to 45 cm).
fn lock(random: &mut SplitMix64) -> Result<(KnownLock, Vec<DVec3>), Stopped> {
    let preset = &PRESETS[(random.unit() * PRESETS.len() as f64) as usize];
    let kind = preset.hair_type();
    let natural = [kind.curl.radius, kind.curl.pitch].map(|x| x * random.decades(0.8, 1.25));
    let turn = (TAU * natural[0]).hypot(natural[1]);
    let length = (turn * random.between(4.0, 12.0)).clamp(0.05, 0.45);
    let mean = kind.fibre(Ellipticity::Measured)?;
    let diameter = kind.diameter * (1.0 + kind.diameter_variation * normal(random)).max(0.6);
    let ratio = (kind.axis_ratio + kind.axis_ratio_deviation * normal(random)).max(1.0);
    let (material, torsion) = (mean.material, mean.torsion);
    let section = Section::from_diameter(diameter, ratio)?;
    let root = held(natural, random)?;
    let rod = Rod::new(RodSpec {
        length,
        section,
        material,
        torsion,
        natural: NaturalStrain::helix(natural[0], natural[1])?,
        root,
        load: Load::down(9.806_65),
    })?;
    let options = Options { resolution: Resolution::Accuracy(5e-5), ..Options::default() };
    let per_turn = 60;
    let points = (length / turn * f64::from(per_turn)).max(200.0) as usize;
    let line = equilibrium(&rod, &[], &options).centre_line(points);
    let hairs = if random.unit() < 0.35 { 1 } else { random.decades(3.0, 40.0) as usize };
    let fibre = Fibre { section, material, torsion, spread: 0.0 };
    let (hanging, turns) = helix(&line, per_turn as usize);
    Ok((KnownLock { preset, natural, length, fibre, hairs, hanging, turns }, line))
}

/// Largest angle between the vertical and the axis of the natural helix where a lock is held (degrees). Chosen: who photographs a curl turns it until it hangs
/// straight down.
const LEAN: f64 = 10.0;

/// The clamp of a helix whose axis hangs down within [`LEAN`].
fn held([radius, pitch]: [f64; 2], random: &mut SplitMix64) -> Result<Root, Stopped> {
    let [about, around] = [0, 1].map(|_| random.between(0.0, TAU));
    let lean = random.between(0.0, LEAN.to_radians());
    // The axis of the helix is along κ d1 + τ t.
    let (sin, cos) = (TAU * radius / pitch).atan().sin_cos();
    let turn = DMat3::from_rotation_z(about)
        * DMat3::from_rotation_y(lean)
        * DMat3::from_rotation_z(around);
    let tangent = turn * DVec3::new(sin, 0.0, -cos);
    Ok(Root::from_tangent(DVec3::ZERO, tangent, turn * DVec3::new(-cos, 0.0, -sin))?)
}

/// Radius and pitch (m) of a line that hangs as a helix, without its upper tenth, and its turns; the axis is the mean over a turn.
fn helix(line: &[DVec3], turn: usize) -> ([f64; 2], f64) {
    let seen = &line[line.len() / 10..];
    let mean = |i: usize| seen[i..i + turn].iter().sum::<DVec3>() / turn as f64;
    let mut turned = 0.0;
    for t in seen.windows(3) {
        turned += (t[1] - t[0]).truncate().angle_to((t[2] - t[1]).truncate());
    }
    let turns = turned.abs() / TAU;
    let axis: Vec<DVec3> = (0..=seen.len().saturating_sub(turn)).map(mean).collect();
    let (mut square, mut count) = (0.0, 0.0);
    for (i, pair) in axis.windows(2).enumerate() {
        let along = (pair[1] - pair[0]).normalize_or_zero();
        square += (seen[i + turn / 2] - pair[0]).reject_from_normalized(along).length_squared();
        count += 1.0;
    }
    let length: f64 = axis.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let whole = length * (seen.len() - 1) as f64 / f64::max(count, 1.0);
    ([(square / f64::max(count, 1.0)).sqrt(), whole / turns], turns)
}

fn axis(line: &[DVec3]) -> DVec2 {
    line.iter().map(|p| p.truncate()).sum::<DVec2>() / line.len() as f64
}

/// The hairs of a lock about its line.
fn hairs(lock: &KnownLock, line: &[DVec3], random: &mut SplitMix64) -> Strands {
    let axis = axis(&line[line.len() / 10..]);
    let spread = random.between(PHASE[0], PHASE[1]);
    let apart = random.between(PLACE[0], PLACE[1]) * lock.natural[0];
    let mut strands = Strands::new();
    let single = lock.hairs == 1;
    for _ in 0..lock.hairs {
        let part = if single { 0.0 } else { 1.0 };
        let (phase, along) = (part * spread * normal(random), part * PHASE_ALONG * normal(random));
        let shift = DVec2::new(normal(random), normal(random)) * apart * part;
        let end = if single { 1.0 } else { 1.0 - 0.03 * normal(random).abs() };
        let count = ((line.len() as f64 * end) as usize).clamp(2, line.len());
        let points: Vec<Vec3> = line[..count]
            .iter()
            .enumerate()
            .map(|(i, p)| {
                let x = i as f64 / line.len() as f64;
                // Hairs are held together at the root.
                let free = (x / 0.05).min(1.0);
                let turn = DVec2::from_angle(free * (phase + along * x));
                let place = axis + turn.rotate(p.truncate() - axis) + shift * free;
                place.extend(p.z).as_vec3()
            })
            .collect();
        let radius = lock.fibre.section.mean_radius() as f32;
        strands.push(&points, &vec![radius; count]);
    }
    strands
}

/// The photo with a seed; the same seed gives the same bytes.
///
/// # Errors
/// [`Stopped`], if a number makes no rod or the picture cannot be drawn.
pub fn photo(seed: u64) -> Result<KnownPhoto, Stopped> {
    let mut random = stream(seed, 0x000f_0700);
    let (lock, line) = lock(&mut random)?;
    let strands = hairs(&lock, &line, &mut random);
    let low = line.iter().map(|p| p.z).fold(0.0, f64::min);
    let width = line.iter().map(|p| p.truncate().length()).fold(0.0, f64::max);
    // The lock fills most of the picture's height.
    let shown = -low * random.between(1.12, 1.3);
    let height = random.between(1400.0, 2400.0) as usize;
    let scale = height as f64 / shown;
    let columns = ((2.0 * width + 0.25 * shown) * scale) as usize;
    let size = [columns.clamp(300, 2400), height];
    let distance = random.between(2.5, 5.0) * shown;
    let azimuth = random.between(0.0, TAU);
    let (roll, rise) = (random.between(-5.0, 5.0), random.between(-3.0, 3.0));
    let axis = axis(&line).extend(0.5 * low);
    let away = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0);
    let side = DVec3::Z.cross(away);
    let eye = axis + away * distance + DVec3::Z * (distance * f64::to_radians(rise).tan());
    let up = DVec3::Z + side * f64::to_radians(roll).tan();
    let view = 2.0 * (0.5 * shown / (eye - axis).length()).atan();
    let camera = Camera::look_at(eye, axis, up, view).map_err(|e| Stopped::Other(e.to_string()))?;
    let shades = ["black", "dark-brown", "brown", "light-brown", "auburn", "dark-blond", "blond"];
    let shade = (random.unit() * shades.len() as f64) as usize;
    let dark = shade < 5;
    let hair = match Shade::named(shades[shade]) {
        Some(shade) => HairLook { melanin: shade.melanin, ..HairLook::default() },
        None => return Err(Stopped::Other(format!("no shade {}", shades[shade]))),
    };
    // Paper behind dark hair, dark cloth behind light hair; the light falls off to the corners.
    let grey = if dark { random.between(0.5, 0.8) } else { random.between(0.01, 0.04) } as f32;
    let corner = grey * random.between(0.6, 1.0) as f32;
    let background =
        Background::Gradient { centre: Vec3::splat(grey), corner: Vec3::splat(corner) };
    let look = Look { hair, background, ..Look::default() };
    let lights = Lights::studio(&camera);
    let scene = Scene { strands: &strands, surface: None, accessories: &[], camera, lights, look };
    let options = PreviewOptions { width: size[0], height, samples: 1, width_scale: Some(1.0) };
    let mut image = render(&scene, &options, &()).map_err(|e| Stopped::Other(e.to_string()))?;
    blur(image.pixels_mut(), size, random.between(0.5, 0.9));
    let noise = random.between(0.005, 0.015) * 255.0;
    let mut rgb = Vec::with_capacity(3 * size[0] * height);
    for pixel in image.to_srgb8().chunks_exact(4) {
        for value in &pixel[..3] {
            // The cast saturates.
            rgb.push((f64::from(*value) + noise * normal(&mut random) + 0.5) as u8);
        }
    }
    Ok(KnownPhoto { lock, size, rgb, scale })
}

/// A Gaussian of a standard deviation in pixels, as of a lens.
fn blur(pixels: &mut [[f32; 4]], [width, height]: [usize; 2], sigma: f64) {
    let kernel: Vec<f32> =
        (-3..=3_i32).map(|i| (-0.5 * (f64::from(i) / sigma).powi(2)).exp() as f32).collect();
    let total: f32 = kernel.iter().sum();
    let mut pass = |count: usize, step: usize, lines: usize, stride: usize| {
        let mut line = vec![[0.0_f32; 4]; count];
        for l in 0..lines {
            for (i, value) in line.iter_mut().enumerate() {
                *value = pixels[l * stride + i * step];
            }
            for i in 0..count {
                let mut sum = [0.0_f32; 4];
                for (j, k) in kernel.iter().enumerate() {
                    let at = (i + j).saturating_sub(3).min(count - 1);
                    for c in 0..4 {
                        sum[c] += k / total * line[at][c];
                    }
                }
                pixels[l * stride + i * step] = sum;
            }
        }
    };
    pass(width, 1, height, width);
    pass(height, width, width, 1);
}
