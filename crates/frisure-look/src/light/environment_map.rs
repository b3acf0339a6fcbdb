//! Environment maps: an equirectangular image as light, importance-sampled by its radiance.

use std::f32::consts::{FRAC_PI_2, PI, TAU};
use std::fmt;
use std::sync::Arc;

use frisure_digest::{Digest, Digestible};
use glam::{DVec3, Vec3};

use super::error::{BRIGHTEST, InvalidLight, refusal};

/// Most pixels across of an environment map; chosen.
pub const MAX_ENVIRONMENT_WIDTH: usize = 16_384;

/// Most pixels across that are kept: each is a twelfth of a degree, a sixth of the sun; chosen.
const KEPT_WIDTH: usize = 4096;

/// An environment map: an equirectangular image of radiance, its upper edge straight above, its middle in front of
/// the face (−y), its left half on the head's left (+x).
///
/// Each pixel shines evenly. Pictures wider than 4096 pixels are averaged down to that, with all of
/// their light.
#[derive(Clone)]
pub struct EnvironmentMap {
    table: Arc<Table>,
    /// Cosine and sine of the turn about z, and factor on the light.
    turn: [f32; 2],
    strength: f32,
}

/// The pixels, and how likely each is chosen: as its light.
#[derive(Debug, PartialEq)]
struct Table {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
    /// Part of the light in the rows before each, from 0 to 1.
    rows: Vec<f32>,
    /// Of each row, part of its light in the columns before each, from 0 to 1.
    columns: Vec<f32>,
    /// z at the upper edge of each row, and at the lower edge of the last.
    heights: Vec<f32>,
    mean: Vec3,
    /// The digest of the pixels.
    digest: u64,
}

impl fmt::Debug for EnvironmentMap {
    /// Without the pixels, but with their digest.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Table { width, height, digest, .. } = &*self.table;
        let Self { turn, strength, .. } = self;
        write!(f, "EnvironmentMap({width} x {height}, {digest:016x}, {turn:?}, {strength})")
    }
}

impl Digestible for EnvironmentMap {
    fn add_to(&self, digest: &mut Digest) {
        let Self { table, turn, strength } = self;
        digest.field("size", &[table.width, table.height]).field("pixels", &table.digest);
        digest.field("turn", turn).field("strength", strength);
    }
}

impl PartialEq for EnvironmentMap {
    fn eq(&self, other: &Self) -> bool {
        let same = Arc::ptr_eq(&self.table, &other.table) || self.table == other.table;
        same && self.turn == other.turn && self.strength == other.strength
    }
}

impl EnvironmentMap {
    /// A picture of `width` × `height` pixels, rows from the top, radiance in linear sRGB.
    ///
    /// # Errors
    /// [`InvalidLight`], if there are no pixels, too many, or not `width` × `height`, or if a value is
    /// negative, not finite or above 1e12.
    pub fn new(width: usize, height: usize, pixels: Vec<[f32; 3]>) -> Result<Self, InvalidLight> {
        let size = 1..=MAX_ENVIRONMENT_WIDTH;
        if !size.contains(&width) || !size.contains(&height) || pixels.len() != width * height {
            let value = format!("{width} x {height} with {} pixels", pixels.len());
            let allowed = "1 to 16384 pixels across and down, and hold as many";
            return Err(refusal("the environment's size", value, allowed));
        }
        let bad = |p: &[f32; 3]| !p.iter().all(|x| (0.0..=BRIGHTEST).contains(x));
        if let Some(i) = pixels.iter().position(bad) {
            let value = format!("{:?} in column {} of row {}", pixels[i], i % width, i / width);
            let allowed = "finite and from 0 to 1e12 in each of red, green and blue";
            return Err(refusal("a pixel of the environment", value, allowed));
        }
        let table = match width > KEPT_WIDTH {
            true => narrowed(width, height, &pixels),
            false => Table::new(width, height, pixels),
        };
        Ok(Self { table: Arc::new(table), turn: [1.0, 0.0], strength: 1.0 })
    }

    /// The same, turned about z by an angle (rad), towards the head's left in front.
    #[must_use]
    pub fn turned(self, angle: f64) -> Self {
        let (sin, cos) = (angle as f32).sin_cos();
        let [c, s] = self.turn;
        Self { turn: [c * cos - s * sin, s * cos + c * sin], ..self }
    }

    /// The same, brighter by a factor; one that is negative or not finite leaves no light.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        let strength = self.strength * factor;
        let good = (0.0..=BRIGHTEST).contains(&strength);
        Self { strength: if good { strength } else { 0.0 }, ..self }
    }

    /// Radiance from a unit direction.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Vec3 {
        let [x, y] = self.table.pixel(self.unturned(towards));
        self.strength * self.table.at(x, y)
    }

    /// Radiance from a unit direction, bilinear between the middles of pixels, for backgrounds;
    /// [`Self::radiance`] is constant in each pixel.
    #[must_use]
    pub fn radiance_interpolated(&self, towards: Vec3) -> Vec3 {
        self.strength * self.table.interpolated(self.unturned(towards))
    }

    /// Mean radiance over all directions.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        self.strength * self.table.mean
    }

    /// Radiance from a unit direction, and the pdf (1/sr) of [`Self::sample`].
    #[must_use]
    pub fn radiance_and_pdf(&self, towards: Vec3) -> (Vec3, f32) {
        let [x, y] = self.table.pixel(self.unturned(towards));
        (self.strength * self.table.at(x, y), self.table.density(x, y))
    }

    /// Samples a direction with a pdf in proportion to its radiance, from numbers in [0, 1) (pbrt-v4, §12.5).
    #[must_use]
    pub fn sample(&self, [u, v]: [f32; 2]) -> Vec3 {
        let table = &self.table;
        let (y, v) = sample_interval(&table.rows, v);
        let (x, u) = sample_interval(table.row(y), u);
        // Uniform in z within the row: uniform on the sphere.
        let z = table.heights[y] + v * (table.heights[y + 1] - table.heights[y]);
        self.turned_by(direction((x as f32 + u) / table.width as f32, z))
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixel_count(&self) -> usize {
        self.table.pixels.len()
    }

    /// The middle of each pixel, its radiance and its solid angle (sr).
    pub fn pixels(&self) -> impl Iterator<Item = (Vec3, Vec3, f32)> {
        let table = &self.table;
        (0..table.pixels.len()).map(move |i| {
            let (x, y) = (i % table.width, i / table.width);
            let z = 0.5 * (table.heights[y] + table.heights[y + 1]);
            let towards = self.turned_by(direction((x as f32 + 0.5) / table.width as f32, z));
            (towards, self.strength * table.at(x, y), table.solid_angle(y))
        })
    }

    fn turned_by(&self, v: Vec3) -> Vec3 {
        let [c, s] = self.turn;
        Vec3::new(c * v.x - s * v.y, s * v.x + c * v.y, v.z)
    }

    fn unturned(&self, v: Vec3) -> Vec3 {
        let [c, s] = self.turn;
        Vec3::new(c * v.x + s * v.y, c * v.y - s * v.x, v.z)
    }
}

/// The position of a unit direction in the picture, as fractions of its width and height.
fn place(towards: Vec3) -> [f32; 2] {
    let u = 0.5 + (-towards.x).atan2(-towards.y) / TAU;
    // The arc cosine of what is near 1 has lost its digits.
    let across = towards.truncate().length();
    [u, (FRAC_PI_2 - towards.z.atan2(across)) / PI]
}

/// The unit direction at a part `u` of the picture's width and a height `z`.
fn direction(u: f32, z: f32) -> Vec3 {
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = (TAU * (u - 0.5)).sin_cos();
    Vec3::new(-r * sin, -r * cos, z)
}

/// The interval that a number in [0, 1) falls in, of those between rising values from 0 to 1, and where in
/// it.
fn sample_interval(rising: &[f32], u: f32) -> (usize, f32) {
    let i = rising.partition_point(|x| *x <= u).clamp(1, rising.len() - 1) - 1;
    let width = rising[i + 1] - rising[i];
    (i, if width > 0.0 { ((u - rising[i]) / width).clamp(0.0, 1.0) } else { 0.5 })
}

/// The sums before each of some values and after the last, as parts of the whole; even, if they are all
/// zero. Gives the whole, too.
fn parts(values: impl ExactSizeIterator<Item = f64>, out: &mut Vec<f32>) -> f64 {
    let (n, start) = (values.len(), out.len());
    let mut sums = vec![0.0; n + 1];
    for (i, value) in values.enumerate() {
        sums[i + 1] = sums[i] + value;
    }
    let whole = sums[n];
    let part = |(i, sum): (usize, f64)| {
        if whole > 0.0 { (sum / whole) as f32 } else { i as f32 / n as f32 }
    };
    out.extend(sums.into_iter().enumerate().map(part));
    // What is chosen last has light: nothing after it can be.
    debug_assert!(out[start] == 0.0 && out[start + n] == 1.0);
    whole
}

impl Table {
    fn new(width: usize, height: usize, pixels: Vec<[f32; 3]>) -> Self {
        // The area of a zone of the sphere is in proportion to its height in z: rows are weighted by that.
        let edge = |y: usize| (std::f64::consts::PI * y as f64 / height as f64).cos();
        let heights = (0..=height).map(|y| edge(y) as f32).collect();
        let weight = |y: usize| edge(y) - edge(y + 1);
        let mut columns = Vec::with_capacity(height * (width + 1));
        let (mut lights, mut mean) = (Vec::with_capacity(height), DVec3::ZERO);
        for (y, row) in pixels.chunks_exact(width).enumerate() {
            let light = row.iter().map(|p| p.iter().map(|x| f64::from(*x)).sum());
            lights.push(weight(y) * parts(light, &mut columns));
            mean += weight(y) * row.iter().map(|p| Vec3::from(*p).as_dvec3()).sum::<DVec3>();
        }
        let mut rows = Vec::with_capacity(height + 1);
        parts(lights.into_iter(), &mut rows);
        let mean = (mean / (2.0 * width as f64)).as_vec3();
        let numbers = pixels.as_flattened().iter().map(|x| x.to_le_bytes());
        let digest = Digest::new("pixels").packed("radiance", numbers).key();
        Self { width, height, pixels, rows, columns, heights, mean, digest }
    }

    fn at(&self, x: usize, y: usize) -> Vec3 {
        self.pixels[y * self.width + x].into()
    }

    fn row(&self, y: usize) -> &[f32] {
        &self.columns[y * (self.width + 1)..][..=self.width]
    }

    fn solid_angle(&self, y: usize) -> f32 {
        TAU / self.width as f32 * (self.heights[y] - self.heights[y + 1])
    }

    /// Density of the directions of a pixel (1/sr).
    fn density(&self, x: usize, y: usize) -> f32 {
        let row = self.row(y);
        // Marginal times conditional probability of the pixel, over its solid angle.
        (self.rows[y + 1] - self.rows[y]) * (row[x + 1] - row[x]) / self.solid_angle(y)
    }

    fn pixel(&self, towards: Vec3) -> [usize; 2] {
        let [u, v] = place(towards);
        let index = |x: f32, n: usize| ((x * n as f32) as usize).min(n - 1);
        [index(u, self.width), index(v, self.height)]
    }

    /// Linear between the middles of the four pixels around a direction.
    fn interpolated(&self, towards: Vec3) -> Vec3 {
        let [u, v] = place(towards);
        let (x, y) = (u * self.width as f32 - 0.5, v * self.height as f32 - 0.5);
        let y = y.clamp(0.0, (self.height - 1) as f32);
        let (left, top) = (x.floor(), (y as usize).min(self.height - 1));
        // The picture closes around the sides, and ends above and below.
        let columns =
            [left, left + 1.0].map(|x| x.rem_euclid(self.width as f32) as usize % self.width);
        let bottom = (top + 1).min(self.height - 1);
        let row = |y: usize| self.at(columns[0], y).lerp(self.at(columns[1], y), x - left);
        row(top).lerp(row(bottom), y - top as f32)
    }
}

/// The same light in [`KEPT_WIDTH`] columns.
fn narrowed(from_width: usize, from_height: usize, from: &[[f32; 3]]) -> Table {
    let (width, height) = (KEPT_WIDTH, (from_height * KEPT_WIDTH / from_width).max(1));
    let latitude = |y: f64| -(std::f64::consts::PI * y / from_height as f64).cos();
    let columns: Vec<_> = (0..width).map(|x| shares(x, width, from_width, |x| x)).collect();
    let mut pixels = Vec::with_capacity(width * height);
    for y in 0..height {
        let rows = shares(y, height, from_height, latitude);
        for columns in &columns {
            let mut sum = DVec3::ZERO;
            for (y, part) in &rows {
                for (x, of) in columns {
                    sum += part * of * Vec3::from(from[y * from_width + x]).as_dvec3();
                }
            }
            pixels.push(sum.as_vec3().to_array());
        }
    }
    Table::new(width, height, pixels)
}

/// Which of `many` equal intervals one of `few` overlaps, and how much of it each takes in a measure.
fn shares(
    index: usize,
    few: usize,
    many: usize,
    measure: impl Fn(f64) -> f64,
) -> Vec<(usize, f64)> {
    let at = |i: usize| i as f64 * many as f64 / few as f64;
    let (low, high) = (at(index), at(index + 1));
    let whole = measure(high) - measure(low);
    let share = |i: usize| {
        let (a, b) = (low.max(i as f64), high.min(i as f64 + 1.0));
        (i, (measure(b) - measure(a)) / whole)
    };
    (low as usize..many.min(high.ceil() as usize)).map(share).filter(|s| s.1 > 0.0).collect()
}
