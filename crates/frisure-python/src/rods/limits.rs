//! Ranges of what rods are made of: wide enough for anything that is a fibre, and narrow enough that the solver ends, with the ends of
//! the ranges in all combinations.

/// The range of a number, and how messages tell it.
pub(super) struct Limits {
    quantity: &'static str,
    unit: &'static str,
    least: f64,
    most: f64,
    allowed: &'static str,
}

pub(super) const LENGTH: Limits =
    Limits::new("length", "m", [1e-6, 100.0], "between 1 um and 100 m");
pub(super) const DIAMETER: Limits =
    Limits::new("mean diameter", "m", [1e-8, 0.1], "between 10 nm and 10 cm");
pub(super) const AXIS_RATIO: Limits =
    Limits::new("axis ratio", "", [1.0, 1000.0], "between 1 and 1000");
pub(super) const YOUNGS_MODULUS: Limits =
    Limits::new("Young's modulus", "Pa", [1e3, 1e13], "between 1 kPa and 10 TPa");
pub(super) const SHEAR_MODULUS: Limits =
    Limits::new("shear modulus", "Pa", [1e3, 1e13], "between 1 kPa and 10 TPa");
pub(super) const DENSITY: Limits =
    Limits::new("density", "kg/m³", [1e-3, 1e5], "between 0.001 and 100000 kg/m³");
pub(super) const GRAVITY: Limits =
    Limits::new("gravity", "m/s²", [0.0, 1e4], "between 0 and 10000 m/s²");
pub(super) const STRAIN: Limits = Limits::new(
    "component of the natural strain",
    "rad/m",
    [-1e7, 1e7],
    "between -1e7 and 1e7 rad/m, the curvature of a radius of 0.1 um",
);
pub(super) const POINT: Limits =
    Limits::new("coordinate", "m", [-1e6, 1e6], "within 1000 km of the origin");
pub(super) const ROOT: Limits =
    Limits::new("coordinate of the root", "m", [-1e6, 1e6], "within 1000 km of the origin");

impl Limits {
    const fn new(
        quantity: &'static str,
        unit: &'static str,
        [least, most]: [f64; 2],
        allowed: &'static str,
    ) -> Self {
        Self { quantity, unit, least, most, allowed }
    }

    /// The number, if it is in the range.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub(super) fn check(&self, value: f64) -> Result<f64, String> {
        if self.least <= value && value <= self.most {
            return Ok(value);
        }
        let Self { quantity, unit, allowed, .. } = self;
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        Err(format!("{quantity} is {value:?}{unit}; it must be {allowed}"))
    }
}
