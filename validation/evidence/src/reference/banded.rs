//! Linear equations whose matrix is a band around the diagonal, by elimination with row pivots.

/// A square matrix with `HALF` diagonals on either side of the middle one.
pub(crate) struct Banded {
    n: usize,
    values: Vec<f64>,
}

/// Diagonals on either side.
const HALF: usize = 8;
/// Space for diagonals that pivoting fills.
const WIDTH: usize = 3 * HALF + 1;

impl Banded {
    pub(crate) fn new(n: usize) -> Self {
        Self { n, values: vec![0.0; n * WIDTH] }
    }

    pub(crate) fn set(&mut self, row: usize, column: usize, value: f64) {
        let i = self.index(row, column);
        self.values[i] = value;
    }

    fn index(&self, row: usize, column: usize) -> usize {
        row * WIDTH + column + HALF - row
    }

    /// The solution for a right-hand side; `None` if the matrix is singular.
    pub(crate) fn solve(mut self, mut b: Vec<f64>) -> Option<Vec<f64>> {
        let n = self.n;
        for k in 0..n {
            let last_row = (k + HALF).min(n - 1);
            let last_column = (k + 2 * HALF).min(n - 1);
            let size = |m: &Self, row: usize| m.values[m.index(row, k)].abs();
            let pivot =
                (k..=last_row).max_by(|&p, &q| size(&self, p).total_cmp(&size(&self, q)))?;
            if !(size(&self, pivot) > 1e-300) {
                return None;
            }
            if pivot != k {
                for c in k..=last_column {
                    let (i, j) = (self.index(k, c), self.index(pivot, c));
                    self.values.swap(i, j);
                }
                b.swap(k, pivot);
            }
            for row in k + 1..=last_row {
                let factor = self.values[self.index(row, k)] / self.values[self.index(k, k)];
                if factor == 0.0 {
                    continue;
                }
                for c in k..=last_column {
                    let (i, j) = (self.index(row, c), self.index(k, c));
                    self.values[i] -= factor * self.values[j];
                }
                b[row] -= factor * b[k];
            }
        }
        for k in (0..n).rev() {
            for c in k + 1..=(k + 2 * HALF).min(n - 1) {
                b[k] -= self.values[self.index(k, c)] * b[c];
            }
            b[k] /= self.values[self.index(k, k)];
        }
        Some(b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_is_solved() {
        let n = 40;
        let value = |i: usize, j: usize| ((7 * i + 3 * j) % 11) as f64 - 4.0;
        let mut matrix = Banded::new(n);
        let mut b = vec![0.0; n];
        for (i, b) in b.iter_mut().enumerate() {
            for j in i.saturating_sub(HALF)..(i + HALF + 1).min(n) {
                matrix.set(i, j, value(i, j));
                *b += value(i, j) * (j as f64).sin();
            }
        }
        let x = matrix.solve(b).unwrap();
        for (j, x) in x.iter().enumerate() {
            assert!((x - (j as f64).sin()).abs() < 1e-9, "{j}: {x}");
        }
    }
}
