//! The lines that were found, drawn over the photo.

use crate::measure::Drawing;

/// Colours (sRGB) of ridge lines, axis and curve. Chosen: none is a colour of hair.
const RIDGES: [u8; 3] = [0, 200, 255];
const AXIS: [u8; 3] = [255, 220, 0];
const CURVE: [u8; 3] = [255, 0, 160];

/// Draws over a photo of `width` pixels a row (three bytes per pixel, changed in place): ridge lines in blue, the axis dashed in yellow, the fitted wave in
/// magenta.
pub fn draw(width: usize, rgb: &mut [u8], drawing: &Drawing) {
    let height = if width == 0 { 0 } else { rgb.len() / (3 * width) };
    // A line of a thousandth of the picture's longer side, and at least a pixel.
    let half = (width.max(height) / 2000) as i64;
    let mut canvas = Canvas { width: width as i64, height: height as i64, rgb };
    for line in &drawing.ridges {
        canvas.line(line, RIDGES, 0, 1);
    }
    canvas.line(&drawing.axis, AXIS, half, 2);
    canvas.line(&drawing.curve, CURVE, half, 1);
}

struct Canvas<'a> {
    width: i64,
    height: i64,
    rgb: &'a mut [u8],
}

impl Canvas<'_> {
    /// Draws every `dash`-th piece of a line, `2 half + 1` pixels wide.
    fn line(&mut self, line: &[[f64; 2]], colour: [u8; 3], half: i64, dash: usize) {
        for pair in line.windows(2).step_by(dash) {
            let [dx, dy] = [0, 1].map(|i: usize| pair[1][i] - pair[0][i]);
            let steps = dx.abs().max(dy.abs()).ceil().clamp(1.0, 1e5);
            for i in 0..=steps as usize {
                let part = i as f64 / steps;
                let at = [0, 1].map(|c: usize| pair[0][c] + part * (pair[1][c] - pair[0][c]));
                self.dot(at.map(|x| x.round() as i64), colour, half);
            }
        }
    }

    fn dot(&mut self, [x, y]: [i64; 2], colour: [u8; 3], half: i64) {
        for v in y - half..=y + half {
            for u in x - half..=x + half {
                if (0..self.width).contains(&u) && (0..self.height).contains(&v) {
                    let i = 3 * (v * self.width + u) as usize;
                    self.rgb[i..i + 3].copy_from_slice(&colour);
                }
            }
        }
    }
}
