//! The range of each number of a description, stated once.
//!
//! [`HairstyleSpec::check`](super::HairstyleSpec::check) refuses what is outside; schemas, documentation and sliders can read
//! the same table.

use std::f64::consts::PI;

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

/// Checks a number against a range that is not in [`RANGES`].
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

const fn of(field: &'static str, min: f64, max: f64, allowed: &'static str) -> Range {
    Range::new(field, min, max, allowed)
}

/// The ranges of all numbers of a [`HairstyleSpec`](super::HairstyleSpec) that are checked one by one.
#[rustfmt::skip]
pub const RANGES: &[Range] = &[
    of("hair.length", 1e-3, 3.0, "between 1 mm and 3 m"),
    of("hair.length_variation", 0.0, 0.5, "0 to 0.5"),
    of("hair.fibre.variation", 0.0, 0.5, "between 0 and 0.5"),
    of("hair.growth_rate", 0.0, 1e-7, "between 0 and 26 cm a month"),
    of("hair.fibre.axis_ratio_variation", 0.0, 1.0, "between 0 and 1"),
    of("hair.curl", 0.0, 2e4, "a strain of at most 20000 rad/m (0.05 mm radius)"),
    of("hair.curl.variation_between", 0.0, 1.0, "between 0 and 1"),
    of("hair.curl.variation_along", 0.0, 1.0, "between 0 and 1"),
    of("hair.curl.variation_scale", 1e-3, 1.0, "1 mm to 1 m"),
    of("wisps.count", 1.0, 2e4, "between 1 and 20000"),
    of("wisps.hairs", 1.0, 1e6, "between 1 and 1000000"),
    of("wisps.hairs_per_wisp", 1.0, 1e5, "between 1 and 100000"),
    of("wisps.density", 1e4, 1e7, "between 1 and 1000 1/cm^2"),
    of("wisps.clumping", 0.0, 1.0, "between 0 and 1"),
    of("wisps.fuzziness", 0.0, 2.0, "between 0 and 2"),
    of("wisps.length_variation", 0.0, 0.5, "0 to 0.5"),
    of("wisps.flyaways", 0.0, 1.0, "between 0 and 1"),
    of("wisps.splits", 1.0, 100.0, "between 1 and 100"),
    of("wisps.profile", 0.0, 10.0, "three factors between 0 and 10 each, such as [1, 1, 0.5]"),
    of("wisps.blending", 0.0, 1.0, "between 0 and 1"),
    of("wisps.points", 2.0, 1000.0, "between 2 and 1000"),
    of("contact.stiffness", 1e-6, 1e5, "between 1e-6 and 1e5 Pa"),
    of("contact.hair_stiffness", 1e-6, 1e5, "between 1e-6 and 1e5 Pa"),
    of("contact.volume", 0.0, 10.0, "between 0 and 10"),
    of("gravity", 0.0, 1000.0, "between 0 and 1000 m/s²"),
    of("equilibrium.elements", 1.0, 1000.0, "between 1 and 1000 on a head"),
    of("equilibrium.tolerance", 1e-8, 0.1, "between 1e-8 and 0.1"),
    of("hair.wetting.youngs_modulus", 0.01, 1.0, "between 0.01 and 1"),
    of("hair.wetting.shear_modulus", 0.01, 1.0, "between 0.01 and 1"),
    of("hair.wetting.diameter", 1.0, 1.5, "between 1 and 1.5"),
    of("hair.wetting.length", 1.0, 1.1, "between 1 and 1.1"),
    of("hair.wetting.wisp", 0.1, 1.0, "between 0.1 and 1"),
    of("implantation.jitter", 0.0, 1.0, "0 to 1 rad (57 deg)"),
    of("implantation.parting", -0.06, 0.06, "within 6 cm of the middle"),
    of("implantation.lift_scale", 0.0, 6.0, "between 0 and 6"),
    of("implantation.lift", 0.0, PI / 2.0, "between 0 and 90 deg"),
    of("implantation.whorls", 1.0, 2.0, "1 or 2"),
    of("implantation.whorl_offset", -0.05, 0.05, "within 5 cm of the usual place"),
    of("implantation.baby_hairs", 0.0, 1.0, "between 0 and 1"),
    of("implantation.hairline.irregularity", 0.0, 0.01, "between 0 and 1 cm"),
    of("implantation.hairline.height", -0.03, 0.05, "between -3 and 5 cm"),
    of("implantation.hairline.recession", 0.0, 0.04, "between 0 and 4 cm"),
    of("implantation.hairline.widows_peak", 0.0, 0.03, "between 0 and 3 cm"),
    of("implantation.partings.offset", -0.06, 0.06, "within 6 cm of the middle"),
    of("region.length", 1e-3, 3.0, "between 1 mm and 3 m"),
    of("region.lift", 0.0, PI / 2.0, "between 0 and 90 deg"),
    of("region.curl", 0.0, 10.0, "between 0 and 10"),
];

/// The range of a field; none if it has none of its own.
#[must_use]
pub fn range_of(field: &str) -> Option<&'static Range> {
    RANGES.iter().find(|range| range.field == field)
}

/// Checks a number against the range of its field.
///
/// # Errors
/// [`InvalidSpec`], if it is outside.
///
/// # Panics
/// If the field is not in [`RANGES`].
pub(crate) fn within(field: &'static str, value: f64) -> Result<(), InvalidSpec> {
    range_of(field).expect("every checked field has a range").check(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_has_one_range_with_room_in_it() {
        for (i, range) in RANGES.iter().enumerate() {
            assert!(range.min < range.max, "{}", range.field);
            assert!(RANGES[..i].iter().all(|other| other.field != range.field), "{}", range.field);
        }
    }
}
