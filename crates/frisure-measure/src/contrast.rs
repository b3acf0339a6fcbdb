//! How much each pixel differs from the background.

use crate::abstain::Abstention;
use crate::dense::{Normal, median};
use crate::filter::Grey;
use crate::photo::Photo;

/// Part of the width and the height at the left, right and lower edge where the background is looked for first. Chosen.
const BORDER: f64 = 0.06;

/// Largest deviation (of 0 to 1) of the border from a smooth background that is plain. Chosen: paper and cloth in even light have 0.01 to 0.03.
const PLAIN: f64 = 0.06;

/// Least difference from the background that is hair, in standard deviations of the noise. Chosen.
const ABOVE_NOISE: f64 = 2.5;

/// Standard deviation of the Gaussian (pixels) under which hair is separated from noise, colour by colour. Chosen: about the blur of a lens.
pub(crate) const SMOOTHING: f64 = 1.0;

/// Median of the root mean square of three normal numbers of deviation 1.
const MEDIAN: f64 = 0.888;

/// Pixels, about, from which the background is computed. Chosen.
const SAMPLES: usize = 40_000;

/// The distance in colour of each pixel from the background, smoothed, less noise.
#[derive(Clone, Debug)]
pub(crate) struct Contrast {
    pub(crate) grey: Grey,
    /// Standard deviation of the background's noise, smoothed.
    pub(crate) noise: f64,
}

impl Contrast {
    /// Fits a polynomial in both coordinates to each colour of the background, of second degree along the border, then of fourth degree everywhere, with
    /// pixels left out that deviate by more than 4 standard deviations.
    pub(crate) fn new(photo: &Photo) -> Result<Self, Abstention> {
        let (w, h) = (photo.width(), photo.height());
        let step = ((w * h / SAMPLES) as f64).sqrt().floor().max(1.0) as usize;
        let all: Vec<(usize, usize)> =
            (0..h).step_by(step).flat_map(|y| (0..w).step_by(step).map(move |x| (x, y))).collect();
        let (side, foot) = ((BORDER * w as f64).ceil(), (BORDER * h as f64).ceil());
        let at_border = |&&(x, y): &&(usize, usize)| {
            (x as f64) < side || (x as f64) >= w as f64 - side || (y as f64) >= h as f64 - foot
        };
        let border: Vec<(usize, usize)> = all.iter().filter(at_border).copied().collect();
        let mut background =
            Background { width: w, height: h, terms: FEW, colours: [[0.0; MANY]; 3] };
        let mut deviation = background.refine(photo, &border, f64::INFINITY);
        for _ in 0..8 {
            deviation = background.refine(photo, &border, (3.0 * deviation).max(0.01));
        }
        if !(deviation < PLAIN) {
            return Err(Abstention::Background { deviation });
        }
        background.terms = MANY;
        for _ in 0..4 {
            deviation = background.refine(photo, &all, (4.0 * deviation).max(0.01));
        }
        let mut smooth = [0, 1, 2].map(|channel| background.rest(photo, channel));
        for grey in &mut smooth {
            *grey = grey.gaussian(SMOOTHING, 0, 0);
        }
        let norm = |i: usize| {
            let square: f32 = smooth.iter().map(|grey| grey.values[i] * grey.values[i]).sum();
            (square / 3.0).sqrt()
        };
        let mut values: Vec<f32> = (0..w * h).map(norm).collect();
        let mut sampled: Vec<f64> = values.iter().step_by(step).map(|v| f64::from(*v)).collect();
        let noise = (median(&mut sampled) / MEDIAN).max(3e-4);
        let floor = (ABOVE_NOISE * noise) as f32;
        values.iter_mut().for_each(|v| *v = (*v - floor).max(0.0));
        Ok(Self { grey: Grey { width: w, height: h, values }, noise })
    }
}

/// Coefficients of a polynomial of second and of fourth degree in two coordinates.
const FEW: usize = 6;
const MANY: usize = 15;

/// A smooth background: a polynomial for each colour.
struct Background {
    width: usize,
    height: usize,
    /// Coefficients that are used.
    terms: usize,
    colours: [[f64; MANY]; 3],
}

impl Background {
    fn row(&self, x: usize, y: usize) -> [f64; MANY] {
        let unit = |x: usize, size: usize| 2.0 * x as f64 / size as f64 - 1.0;
        let (u, v) = (unit(x, self.width), unit(y, self.height));
        let (u2, v2) = (u * u, v * v);
        let [few, cubic] =
            [[1.0, u, v, u2, u * v, v2], [u2 * u, u2 * v, u * v2, v2 * v, u2 * u2, 0.0]];
        let quartic = [u2 * u * v, u2 * v2, u * v2 * v, v2 * v2];
        let mut row = [0.0; MANY];
        row[..6].copy_from_slice(&few);
        row[6..11].copy_from_slice(&cubic[..5]);
        row[11..].copy_from_slice(&quartic);
        row
    }

    /// Distance of a pixel's colour from that of the background, of 0 to 1.
    fn distance(&self, photo: &Photo, x: usize, y: usize) -> f64 {
        let row = self.row(x, y);
        let pixel = photo.rgb()[y * photo.width() + x];
        let square: f64 = (self.colours.iter().zip(pixel))
            .map(|(colour, value)| (f64::from(value) - dot(colour, &row)).powi(2))
            .sum();
        (square / 3.0).sqrt()
    }

    /// Fits it to the pixels that are nearer than `limit` to it, and returns their standard deviation, by the median.
    fn refine(&mut self, photo: &Photo, places: &[(usize, usize)], limit: f64) -> f64 {
        let near: Vec<(usize, usize)> =
            places.iter().copied().filter(|&(x, y)| self.distance(photo, x, y) < limit).collect();
        for channel in 0..3 {
            let mut normal = Normal::new(self.terms);
            for &(x, y) in &near {
                let value = f64::from(photo.rgb()[y * photo.width() + x][channel]);
                normal.add(&self.row(x, y)[..self.terms], value, 1.0);
            }
            (0..self.terms).for_each(|i| normal.pull(i, if i == 0 { 0.5 } else { 0.0 }, 1e-3));
            if let Some(found) = normal.solve() {
                self.colours[channel][..self.terms].copy_from_slice(&found);
            }
        }
        let mut distances: Vec<f64> =
            places.iter().map(|&(x, y)| self.distance(photo, x, y)).collect();
        median(&mut distances) / MEDIAN
    }

    /// What a colour of each pixel differs by.
    fn rest(&self, photo: &Photo, channel: usize) -> Grey {
        let (width, height) = (photo.width(), photo.height());
        let value = |i: usize| {
            let row = self.row(i % width, i / width);
            photo.rgb()[i][channel] - dot(&self.colours[channel], &row) as f32
        };
        Grey { width, height, values: (0..width * height).map(value).collect() }
    }
}

fn dot(a: &[f64; MANY], b: &[f64; MANY]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
