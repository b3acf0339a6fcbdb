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

/// Pixels, about, from which the background is computed. Chosen.
const SAMPLES: usize = 40_000;

/// The distance in colour of each pixel from the background, less noise.
#[derive(Clone, Debug)]
pub(crate) struct Contrast {
    pub(crate) grey: Grey,
    /// Standard deviation of the background's noise.
    pub(crate) noise: f64,
}

impl Contrast {
    /// Fits a quadratic in both coordinates to each colour of the background, first along the border, then everywhere, with pixels left out that
    /// deviate by more than 4 standard deviations.
    pub(crate) fn new(photo: &Photo) -> Result<Self, Abstention> {
        let (w, h) = (photo.width(), photo.height());
        let step = ((w * h / SAMPLES) as f64).sqrt().floor().max(1.0) as usize;
        let all: Vec<(usize, usize)> = (0..h)
            .step_by(step)
            .flat_map(|y| (0..w).step_by(step).map(move |x| (x, y)))
            .collect();
        let (side, foot) = ((BORDER * w as f64).ceil(), (BORDER * h as f64).ceil());
        let at_border = |&&(x, y): &&(usize, usize)| {
            (x as f64) < side || (x as f64) >= w as f64 - side || (y as f64) >= h as f64 - foot
        };
        let border: Vec<(usize, usize)> = all.iter().filter(at_border).copied().collect();
        let mut background = Background { width: w, height: h, colours: [[0.0; 6]; 3] };
        let mut deviation = background.refine(photo, &border, f64::INFINITY);
        for _ in 0..8 {
            deviation = background.refine(photo, &border, (3.0 * deviation).max(0.01));
        }
        if !(deviation < PLAIN) {
            return Err(Abstention::Background { deviation });
        }
        for _ in 0..4 {
            deviation = background.refine(photo, &all, (4.0 * deviation).max(0.01));
        }
        let noise = deviation.max(1e-3);
        let floor = ABOVE_NOISE * noise;
        let mut values = Vec::with_capacity(w * h);
        for y in 0..h {
            values.extend((0..w).map(|x| (background.distance(photo, x, y) - floor).max(0.0) as f32));
        }
        Ok(Self { grey: Grey { width: w, height: h, values }, noise })
    }
}

/// A smooth background: a quadratic for each colour.
struct Background {
    width: usize,
    height: usize,
    colours: [[f64; 6]; 3],
}

impl Background {
    fn row(&self, x: usize, y: usize) -> [f64; 6] {
        let (u, v) = (2.0 * x as f64 / self.width as f64 - 1.0, 2.0 * y as f64 / self.height as f64 - 1.0);
        [1.0, u, v, u * u, u * v, v * v]
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
            let mut normal = Normal::new(6);
            for &(x, y) in &near {
                let value = f64::from(photo.rgb()[y * photo.width() + x][channel]);
                normal.add(&self.row(x, y), value, 1.0);
            }
            (0..6).for_each(|i| normal.pull(i, if i == 0 { 0.5 } else { 0.0 }, 1e-3));
            if let Some(found) = normal.solve() {
                self.colours[channel].copy_from_slice(&found);
            }
        }
        let mut distances: Vec<f64> =
            places.iter().map(|&(x, y)| self.distance(photo, x, y)).collect();
        // The distance over three colours has its median at 0.888 of the deviation of one.
        median(&mut distances) / 0.888
    }
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
