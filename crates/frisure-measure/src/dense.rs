//! Small systems of linear equations.

/// A symmetric matrix, by its lower triangle, and a right-hand side: normal equations of least squares.
#[derive(Clone, Debug)]
pub(crate) struct Normal {
    n: usize,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl Normal {
    pub(crate) fn new(n: usize) -> Self {
        Self { n, matrix: vec![0.0; n * n], right: vec![0.0; n] }
    }

    /// Adds the equation `row · x = value` with a weight.
    pub(crate) fn add(&mut self, row: &[f64], value: f64, weight: f64) {
        for (i, a) in row.iter().enumerate() {
            self.right[i] += weight * a * value;
            for (j, b) in row.iter().enumerate().take(i + 1) {
                self.matrix[i * self.n + j] += weight * a * b;
            }
        }
    }

    /// Adds that an unknown is near a value.
    pub(crate) fn pull(&mut self, unknown: usize, value: f64, weight: f64) {
        self.matrix[unknown * (self.n + 1)] += weight;
        self.right[unknown] += weight * value;
    }

    /// Multiplies the diagonal (Levenberg and Marquardt).
    pub(crate) fn damped(mut self, factor: f64) -> Self {
        for i in 0..self.n {
            self.matrix[i * (self.n + 1)] *= 1.0 + factor;
        }
        self
    }

    /// The solution by Cholesky's factors; none if the matrix is not positive definite.
    pub(crate) fn solve(&self) -> Option<Vec<f64>> {
        let n = self.n;
        let mut l = self.matrix.clone();
        for i in 0..n {
            for j in 0..=i {
                let dot: f64 = (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum();
                let rest = l[i * n + j] - dot;
                if i == j {
                    if !(rest > 1e-13 * self.matrix[i * (n + 1)].abs()) {
                        return None;
                    }
                    l[i * n + i] = rest.sqrt();
                } else {
                    l[i * n + j] = rest / l[j * n + j];
                }
            }
        }
        let mut x = self.right.clone();
        for i in 0..n {
            let dot: f64 = (0..i).map(|k| l[i * n + k] * x[k]).sum();
            x[i] = (x[i] - dot) / l[i * n + i];
        }
        for i in (0..n).rev() {
            let dot: f64 = (i + 1..n).map(|k| l[k * n + i] * x[k]).sum();
            x[i] = (x[i] - dot) / l[i * n + i];
        }
        Some(x)
    }

    /// The inverse of the matrix, by rows.
    pub(crate) fn inverse(&self) -> Option<Vec<Vec<f64>>> {
        let column = |j: usize| {
            let mut right = vec![0.0; self.n];
            right[j] = 1.0;
            Self { right, ..self.clone() }.solve()
        };
        (0..self.n).map(column).collect()
    }
}

/// The median; 0 of nothing.
pub(crate) fn median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
