//! Small dense symmetric systems: some dozen unknowns of one fibre.
//!
//! A library of linear algebra would be the largest dependency of this crate for thirty lines of Cholesky and Jacobi.

/// A symmetric matrix, all of it stored, by rows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Symmetric {
    n: usize,
    entries: Vec<f64>,
}

impl Symmetric {
    pub(crate) fn zero(n: usize) -> Self {
        Self { n, entries: vec![0.0; n * n] }
    }

    pub(crate) fn len(&self) -> usize {
        self.n
    }

    pub(crate) fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.n + j]
    }

    pub(crate) fn set(&mut self, i: usize, j: usize, x: f64) {
        self.entries[i * self.n + j] = x;
        self.entries[j * self.n + i] = x;
    }

    pub(crate) fn add(&mut self, i: usize, j: usize, x: f64) {
        self.entries[i * self.n + j] += x;
        if i != j {
            self.entries[j * self.n + i] += x;
        }
    }

    pub(crate) fn add_diagonal(&mut self, i: usize, x: f64) {
        self.entries[i * self.n + i] += x;
    }

    /// Multiplies all entries.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.entries.iter_mut().for_each(|x| *x *= factor);
    }

    /// The rows and columns of some indices.
    pub(crate) fn part(&self, indices: &[usize]) -> Self {
        let mut part = Self::zero(indices.len());
        for (a, &i) in indices.iter().enumerate() {
            for (b, &j) in indices.iter().enumerate() {
                part.entries[a * indices.len() + b] = self.at(i, j);
            }
        }
        part
    }

    /// `xᵀ A x`.
    pub(crate) fn square(&self, x: &[f64]) -> f64 {
        let row = |i: usize| -> f64 { (0..self.n).map(|j| self.at(i, j) * x[j]).sum() };
        (0..self.n).map(|i| x[i] * row(i)).sum()
    }

    /// `A = L Lᵀ`, after scaling to a diagonal of ones; `None` if it is not positive definite to rounding.
    pub(crate) fn cholesky(&self) -> Option<Cholesky> {
        let n = self.n;
        let scale: Vec<f64> = (0..n).map(|i| self.at(i, i).sqrt().recip()).collect();
        if !scale.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut lower = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let before: f64 = (0..j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
                let rest = self.at(i, j) * scale[i] * scale[j] - before;
                if i == j {
                    // Some times the rounding of a sum of n products of numbers of at most one.
                    if !(rest > 1e-14) {
                        return None;
                    }
                    lower[i * n + i] = rest.sqrt();
                } else {
                    lower[i * n + j] = rest / lower[j * n + j];
                }
            }
        }
        Some(Cholesky { n, lower, scale })
    }

    /// Eigenvalues, and eigenvectors as rows, by Jacobi's rotations; in no order.
    pub(crate) fn eigen(&self) -> (Vec<f64>, Vec<Vec<f64>>) {
        let n = self.n;
        let mut a = self.clone();
        let mut vectors: Vec<Vec<f64>> =
            (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        // Converges quadratically: matrices of ten rows take six or seven sweeps.
        for _ in 0..40 {
            let rest: f64 = (0..n)
                .flat_map(|i| (0..i).map(move |j| (i, j)))
                .map(|(i, j)| a.at(i, j).powi(2))
                .sum();
            let size: f64 = (0..n).map(|i| a.at(i, i).powi(2)).sum();
            if rest <= 1e-30 * size {
                break;
            }
            for p in 0..n {
                for q in p + 1..n {
                    a.rotate(p, q, &mut vectors);
                }
            }
        }
        ((0..n).map(|i| a.at(i, i)).collect(), vectors)
    }

    /// The rotation of the plane of two axes that makes their entry zero.
    fn rotate(&mut self, p: usize, q: usize, vectors: &mut [Vec<f64>]) {
        let mixed = self.at(p, q);
        if mixed == 0.0 {
            return;
        }
        let theta = (self.at(q, q) - self.at(p, p)) / (2.0 * mixed);
        let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
        let c = t.hypot(1.0).recip();
        let s = t * c;
        for k in 0..self.n {
            let (x, y) = (self.at(k, p), self.at(k, q));
            self.entries[k * self.n + p] = c * x - s * y;
            self.entries[k * self.n + q] = s * x + c * y;
        }
        for k in 0..self.n {
            let (x, y) = (self.at(p, k), self.at(q, k));
            self.entries[p * self.n + k] = c * x - s * y;
            self.entries[q * self.n + k] = s * x + c * y;
        }
        let (before, after) = vectors.split_at_mut(q);
        for (x, y) in before[p].iter_mut().zip(&mut after[0]) {
            (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
        }
    }
}

/// Factors of a positive definite matrix.
pub(crate) struct Cholesky {
    n: usize,
    lower: Vec<f64>,
    scale: Vec<f64>,
}

impl Cholesky {
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let n = self.n;
        let mut x: Vec<f64> = right.iter().zip(&self.scale).map(|(r, s)| r * s).collect();
        for i in 0..n {
            let before: f64 = (0..i).map(|k| self.lower[i * n + k] * x[k]).sum();
            x[i] = (x[i] - before) / self.lower[i * n + i];
        }
        for i in (0..n).rev() {
            let after: f64 = (i + 1..n).map(|k| self.lower[k * n + i] * x[k]).sum();
            x[i] = (x[i] - after) / self.lower[i * n + i];
        }
        x.iter().zip(&self.scale).map(|(x, s)| x * s).collect()
    }

    pub(crate) fn inverse(&self) -> Symmetric {
        let mut inverse = Symmetric::zero(self.n);
        for i in 0..self.n {
            let mut unit = vec![0.0; self.n];
            unit[i] = 1.0;
            for (j, x) in self.solve(&unit).into_iter().enumerate().skip(i) {
                inverse.set(i, j, x);
            }
        }
        inverse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symmetric, positive definite, with columns of very different sizes.
    fn matrix() -> Symmetric {
        let rows = [[4.0, 1.0, 0.5], [1.0, 3.0, -0.2], [0.5, -0.2, 2.0]];
        let sizes = [1.0, 1e-6, 1e4];
        let mut a = Symmetric::zero(3);
        for i in 0..3 {
            for j in 0..=i {
                a.set(i, j, rows[i][j] * sizes[i] * sizes[j]);
            }
        }
        a
    }

    #[test]
    fn the_inverse_times_the_matrix_is_one() {
        let a = matrix();
        let inverse = a.cholesky().unwrap().inverse();
        for i in 0..3 {
            for j in 0..3 {
                let sum: f64 = (0..3).map(|k| a.at(i, k) * inverse.at(k, j)).sum();
                let scale = (a.at(i, i) / a.at(j, j)).sqrt();
                assert!((sum - f64::from(u8::from(i == j))).abs() < 1e-12 * scale.max(1.0));
            }
        }
        let mut singular = matrix();
        singular.set(1, 1, 0.0);
        assert!(singular.cholesky().is_none());
    }

    #[test]
    fn eigenvectors_are_mapped_to_multiples_of_themselves() {
        let mut a = Symmetric::zero(4);
        for i in 0..4 {
            for j in 0..=i {
                a.set(i, j, 1.0 / (1.0 + i as f64 + j as f64));
            }
        }
        let (values, vectors) = a.eigen();
        for (value, vector) in values.iter().zip(&vectors) {
            for i in 0..4 {
                let sum: f64 = (0..4).map(|j| a.at(i, j) * vector[j]).sum();
                assert!((sum - value * vector[i]).abs() < 1e-14);
            }
        }
    }
}
