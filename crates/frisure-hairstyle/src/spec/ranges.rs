//! Ranges of numbers, and the error about a number outside of its range.

/// A description that cannot be computed.
#[derive(Clone, Debug, thiserror::Error, PartialEq)]
#[error("{field} is {value}; it must be {allowed}")]
pub struct InvalidSpec {
    /// Path of the field as scenes name it, such as `wisps.count`.
    pub field: &'static str,
    /// The value given.
    pub value: String,
    /// The allowed range in words.
    pub allowed: &'static str,
}

/// Checks a number against a range that is not in the table of [`number`](super::number).
///
/// # Errors
/// [`InvalidSpec`], if it is outside.
pub(crate) fn range(
    field: &'static str,
    value: f64,
    min: f64,
    max: f64,
    allowed: &'static str,
) -> Result<(), InvalidSpec> {
    let inside = value >= min && value <= max;
    let value = value.to_string();
    if inside { Ok(()) } else { Err(InvalidSpec { field, value, allowed }) }
}

/// The range in which a number of a description means something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Path of the field as scenes name it.
    pub field: &'static str,
    /// Smallest allowed value, in SI units.
    pub min: f64,
    /// Largest allowed value, in SI units.
    pub max: f64,
    /// The same in words.
    pub allowed: &'static str,
}

impl Range {
    /// A range from `min` to `max`.
    #[must_use]
    pub const fn new(field: &'static str, min: f64, max: f64, allowed: &'static str) -> Self {
        Self { field, min, max, allowed }
    }

    /// Checks that a value is in the range.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the field.
    pub fn check(&self, value: f64) -> Result<(), InvalidSpec> {
        range(self.field, value, self.min, self.max, self.allowed)
    }
}
