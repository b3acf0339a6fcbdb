//! Grey pictures, and Gaussian filters of them.

/// A grey picture, row by row from the top.
#[derive(Clone, Debug)]
pub(crate) struct Grey {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<f32>,
}

impl Grey {
    pub(crate) fn at(&self, x: usize, y: usize) -> f32 {
        self.values[y * self.width + x]
    }

    /// The picture under a Gaussian of standard deviation `sigma` (pixels), or its derivatives of order `dx`, `dy` (0 to 2): convolutions with
    /// derivatives of the Gaussian. Edges are continued.
    pub(crate) fn gaussian(&self, sigma: f64, dx: usize, dy: usize) -> Self {
        let (across, down) = (kernel(sigma, dx), kernel(sigma, dy));
        let (w, h) = (self.width, self.height);
        let reach = across.len() / 2;
        let mut rows = vec![0.0_f32; w * h];
        let mut padded = vec![0.0_f32; w + 2 * reach];
        for y in 0..h {
            let line = &self.values[y * w..(y + 1) * w];
            padded[..reach].fill(line[0]);
            padded[reach..reach + w].copy_from_slice(line);
            padded[reach + w..].fill(line[w - 1]);
            for (x, value) in rows[y * w..(y + 1) * w].iter_mut().enumerate() {
                *value = across.iter().zip(&padded[x..]).map(|(k, v)| k * v).sum();
            }
        }
        let mut values = vec![0.0_f32; w * h];
        for y in 0..h {
            let sum = &mut values[y * w..(y + 1) * w];
            for (i, k) in down.iter().enumerate() {
                let from = (y + i).saturating_sub(reach).min(h - 1);
                for (v, x) in sum.iter_mut().zip(&rows[from * w..(from + 1) * w]) {
                    *v += k * x;
                }
            }
        }
        Self { width: w, height: h, values }
    }
}

/// A Gaussian or a derivative of it, mirrored for a convolution as a sum over neighbours.
fn kernel(sigma: f64, order: usize) -> Vec<f32> {
    let reach = (3.5 * sigma).ceil() as i32;
    let of = |i: i32| {
        let x = f64::from(i) / sigma;
        (-0.5 * x * x).exp()
    };
    let total: f64 = (-reach..=reach).map(of).sum();
    let at = |i: i32| {
        let x = f64::from(i) / sigma;
        let factor = match order {
            0 => 1.0,
            // Neighbour i counts with −G′(−i) = … = +x/σ.
            1 => x / sigma,
            _ => (x * x - 1.0) / (sigma * sigma),
        };
        (factor * of(i) / total) as f32
    };
    (-reach..=reach).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_a_parabola_are_its_coefficients() {
        let (width, height) = (40, 30);
        let value = |i: usize| {
            let (x, y) = ((i % width) as f32, (i / width) as f32);
            0.5 * x * x * 0.02 + 0.03 * x * y - 0.1 * y
        };
        let grey = Grey { width, height, values: (0..width * height).map(value).collect() };
        let at = |dx, dy| grey.gaussian(1.5, dx, dy).at(20, 15);
        for (found, expected) in [
            (at(1, 0), 0.02 * 20.0 + 0.03 * 15.0),
            (at(0, 1), 0.03 * 20.0 - 0.1),
            (at(2, 0), 0.02),
            (at(1, 1), 0.03),
            (at(0, 2), 0.0),
        ] {
            assert!((found - expected).abs() < 2e-3, "{found} {expected}");
        }
    }
}
