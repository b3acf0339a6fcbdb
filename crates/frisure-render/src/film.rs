//! The image, and its conversion to display bytes.

use frisure_look::ToneCurve;

/// Largest width or height of a picture (pixels).
pub const MAX_SIZE: usize = 16_384;

/// A picture of linear sRGB light with coverage, rows from the top.
///
/// Colours are scene-linear and premultiplied: a pixel half covered by a white object is
/// (0.5, 0.5, 0.5, 0.5).
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 4]>,
}

impl Image {
    /// A transparent black picture.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![[0.0; 4]; width * height] }
    }

    /// Pixels across.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Red, green, blue (scene-linear, premultiplied) and coverage of every pixel, row by row from
    /// the top left.
    #[must_use]
    pub fn pixels(&self) -> &[[f32; 4]] {
        &self.pixels
    }

    /// The pixels, to be written.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 4]] {
        &mut self.pixels
    }

    /// Pixel in column `x`, row `y` from the top left.
    ///
    /// # Panics
    /// If it lies outside the picture.
    #[must_use]
    pub fn pixel(&self, x: usize, y: usize) -> [f32; 4] {
        assert!(x < self.width, "column {x} of {}", self.width);
        self.pixels[y * self.width + x]
    }

    /// Bytes for a screen or a PNG file, developed with the default [`ToneCurve`]: sRGB-encoded red,
    /// green, blue and *unassociated* alpha per pixel, row by row from the top left.
    #[must_use]
    pub fn to_srgb8(&self) -> Vec<u8> {
        self.to_srgb8_with(ToneCurve::default(), 0.0)
    }

    /// As [`Self::to_srgb8`], with the tone curve given, and lighter by `stops` (factors of two).
    #[must_use]
    pub fn to_srgb8_with(&self, tone: ToneCurve, stops: f32) -> Vec<u8> {
        let gain = stops.exp2();
        let lit = |[r, g, b, a]: [f32; 4]| [r * gain, g * gain, b * gain, a];
        self.pixels.iter().flat_map(|&pixel| develop(lit(pixel), tone)).collect()
    }
}

/// One pixel as sRGB bytes with unassociated alpha.
fn develop([r, g, b, a]: [f32; 4], tone: ToneCurve) -> [u8; 4] {
    let whole = if a > 0.0 { 1.0 / a } else { 0.0 };
    let [r, g, b] = [r, g, b].map(|c| byte(srgb(tone.apply(c * whole))));
    [r, g, b, byte(a)]
}

/// The sRGB transfer function (IEC 61966-2-1) of a linear value from 0 to 1.
fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Nearest byte to a value from 0 to 1; the cast saturates, and not-a-number is 0.
fn byte(value: f32) -> u8 {
    (value * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_bytes_of_known_values() {
        let grey = |c: f32| develop([c, c, c, 1.0], ToneCurve::Plain)[0];
        assert_eq!((grey(0.0), grey(1.0), grey(9.0), grey(f32::NAN)), (0, 255, 255, 0));
        assert_eq!(grey(0.215_861), 128); // mid grey
        assert_eq!(develop([0.5, 0.0, 0.0, 0.5], ToneCurve::Plain), [255, 0, 0, 128]);
    }
}
