//! Numbers with error bars.

use serde::Serialize;

/// A number with its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

impl Estimate {
    /// The bounds of the interval that contains the truth with a probability of 95 %.
    #[must_use]
    pub fn bounds(&self) -> [f64; 2] {
        [self.value - 1.96 * self.deviation, self.value + 1.96 * self.deviation]
    }

    /// A number of whose logarithm the deviation is known.
    pub(crate) fn of_logarithm(value: f64, deviation: f64) -> Self {
        Self { value, deviation: value * deviation }
    }
}
