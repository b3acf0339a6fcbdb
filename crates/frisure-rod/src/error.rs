//! The error for a physical quantity out of its range.

use thiserror::Error;

/// A physical quantity outside the range in which it means something.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{quantity} is {value} {unit}; it must be {allowed}")]
pub struct InvalidQuantity {
    /// The quantity in words, such as `Young's modulus`.
    pub quantity: &'static str,
    /// The value given, in SI units.
    pub value: f64,
    /// SI unit of the value; empty for pure numbers.
    pub unit: &'static str,
    /// The allowed range in words.
    pub allowed: &'static str,
}

/// The value, if it is finite and greater than zero.
///
/// # Errors
/// [`InvalidQuantity`] for anything else, NaN included.
pub(crate) fn positive(
    quantity: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<f64, InvalidQuantity> {
    let allowed = "a finite number greater than zero";
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(InvalidQuantity { quantity, value, unit, allowed })
    }
}

/// The value, if it is finite.
///
/// # Errors
/// [`InvalidQuantity`] for infinities and NaN.
pub(crate) fn finite(
    quantity: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<f64, InvalidQuantity> {
    let allowed = "a finite number";
    if value.is_finite() {
        Ok(value)
    } else {
        Err(InvalidQuantity { quantity, value, unit, allowed })
    }
}
