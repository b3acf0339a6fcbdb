//! Errors and checks of lights.

use std::fmt::Display;

use glam::{DVec3, Vec3};
use thiserror::Error;

/// A value of a light that is out of its range.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{field} is {value}; it must be {allowed}")]
pub struct InvalidLight {
    /// What the value is, such as `the lamp's radius`.
    pub field: &'static str,
    /// The value given.
    pub value: String,
    /// What would be allowed, in words.
    pub allowed: &'static str,
}

/// Greatest amount of light: single precision has room for its sums; chosen.
pub(super) const BRIGHTEST: f32 = 1e12;

const AMOUNT: &str = "from 0 to 1e12 in each of red, green and blue";

/// An amount of light.
pub(super) fn amount(field: &'static str, value: Vec3) -> Result<Vec3, InvalidLight> {
    let good = value.to_array().iter().all(|x| (0.0..=BRIGHTEST).contains(x));
    check(good, field, value, AMOUNT).map(|()| value)
}

/// A place (m).
pub(super) fn place(field: &'static str, value: DVec3) -> Result<DVec3, InvalidLight> {
    let good = value.is_finite() && value.abs().max_element() <= 1e4;
    check(good, field, value, "finite and within 10 km of the origin").map(|()| value)
}

/// A direction; it becomes a unit vector.
pub(super) fn direction(field: &'static str, value: DVec3) -> Result<DVec3, InvalidLight> {
    let unit = value.try_normalize();
    unit.ok_or_else(|| refusal(field, value, "finite and not zero"))
}

/// A number from `least` to `most`.
pub(super) fn within(
    field: &'static str,
    value: f64,
    (least, most): (f64, f64),
    allowed: &'static str,
) -> Result<f64, InvalidLight> {
    check((least..=most).contains(&value), field, value, allowed).map(|()| value)
}

fn check(
    good: bool,
    field: &'static str,
    value: impl Display,
    allowed: &'static str,
) -> Result<(), InvalidLight> {
    if good { Ok(()) } else { Err(refusal(field, value, allowed)) }
}

pub(super) fn refusal(
    field: &'static str,
    value: impl Display,
    allowed: &'static str,
) -> InvalidLight {
    InvalidLight { field, value: value.to_string(), allowed }
}
