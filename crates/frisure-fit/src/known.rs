//! What is known of a fibre before it is measured, and what numbers a fit gives.

use serde::Serialize;
use thiserror::Error;

/// Acceleration of gravity (m/s²) that stiffness over weight refers to.
pub const STANDARD_GRAVITY: f64 = 9.81;

/// A number and its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard deviation, in the same unit; 0: exact.
    pub deviation: f64,
}

impl Estimate {
    /// A number that is known exactly.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, deviation: 0.0 }
    }

    /// Standard deviation over the number.
    #[must_use]
    pub fn relative_deviation(&self) -> f64 {
        self.deviation / self.value.abs()
    }
}

/// What is known of a fibre besides its lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Known {
    /// EI/(ρSg) (m³) in the first state, with the smaller bending stiffness and g = 9.81 m/s².
    pub stiffness_over_weight: Option<Estimate>,
    /// GJ/EI, the torsional over the smaller bending stiffness, in the first state.
    pub torsion_ratio: Option<Estimate>,
    /// Natural curvature (rad/m).
    pub curvature: Option<Estimate>,
    /// Natural torsion (rad/m); negative: left-handed.
    pub torsion: Option<Estimate>,
    /// Longer over shorter axis of the section, at least 1: the square root of the larger over the smaller bending stiffness.
    pub axis_ratio: Option<Estimate>,
}

/// A number for a person: whole ones without a point, large and small ones with an exponent.
fn plain(value: f64) -> String {
    format!("{value:?}").trim_end_matches(".0").to_owned()
}

/// A number that cannot be known of a fibre.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{quantity} is {}; it must be {allowed}", plain(*value))]
pub struct KnownError {
    /// The name of the number.
    pub quantity: &'static str,
    /// The number.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

/// Hair of 40 µm to 120 µm has EI/(ρSg) from 3e-5 to 3e-4 m³. By default its logarithm is normal about this, with this deviation: 95 % are
/// between 5e-6 and 2e-3 m³.
pub(crate) const USUAL_STIFFNESS: Estimate = Estimate { value: 1e-4, deviation: 1.5 };

/// GJ/EI of a circular section with the moduli 3.89 and 0.89 GPa, in docs/hair-types.md, and by default the deviation of its logarithm: measured moduli vary
/// by about as much from person to person. That of an ellipse is larger: see [`of_ellipse`].
pub(crate) const USUAL_TORSION_RATIO: Estimate = Estimate { value: 0.46, deviation: 0.3 };

/// Deviation of the logarithm of GJ/EI in a further state: water lowers the shear modulus twice as much as Young's (docs/hair-types.md, "Wet hair").
pub(crate) const TORSION_RATIO_OF_STATES: f64 = 0.7;

/// Longer over shorter axis of a section that is not known, and the deviation of its logarithm: 95 % are between 0.84 and 1.86. Means of people are from 1.2 to
/// 1.5, and fibres of one person deviate by 0.19 (Lasisi et al. 2021); chosen so that the circle and 1.56 are as likely.
pub(crate) const USUAL_AXIS_RATIO: Estimate = Estimate { value: 1.25, deviation: 0.2 };

/// J/I of an ellipse over that of a circle: 2 r²/(1 + r²), r the axis ratio, by J = πa³b³/(a² + b²) and I = πab³/4.
pub(crate) fn of_ellipse(axis_ratio: f64) -> f64 {
    let square = axis_ratio * axis_ratio;
    2.0 * square / (1.0 + square)
}

impl Known {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`KnownError`], for the first that is wrong.
    pub fn check(&self) -> Result<(), KnownError> {
        let positive = "finite and more than 0, from 1e-9 to 1e3 m³";
        let one = |quantity, estimate: Option<Estimate>, allowed, good: fn(f64) -> bool| {
            let Some(Estimate { value, deviation }) = estimate else { return Ok(()) };
            if !good(value) {
                return Err(KnownError { quantity, value, allowed });
            }
            if deviation.is_finite() && deviation >= 0.0 {
                return Ok(());
            }
            let allowed = "finite and at least 0: its standard deviation";
            Err(KnownError { quantity, value: deviation, allowed })
        };
        let stiffness = self.stiffness_over_weight;
        one("stiffness over weight", stiffness, positive, |x| (1e-9..=1e3).contains(&x))?;
        let allowed = "from 1e-3 to 1e3";
        let ratio = |x| (1e-3..=1e3).contains(&x);
        one("torsional over bending stiffness", self.torsion_ratio, allowed, ratio)?;
        let allowed = "from 0 to 1e5 rad/m";
        one("natural curvature", self.curvature, allowed, |x| (0.0..=1e5).contains(&x))?;
        let allowed = "from -1e5 to 1e5 rad/m";
        one("natural torsion", self.torsion, allowed, |x| x.abs() <= 1e5)?;
        one("axis ratio", self.axis_ratio, "from 1 to 20", |x| (1.0..=20.0).contains(&x))
    }
}

/// How fibres are fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Standard deviation of each coordinate of each point (m). Without it, the deviation from the fitted line is taken for noise, and nothing can tell
    /// that the model does not fit.
    pub noise: Option<f64>,
    /// Knots between which the natural strain is linear, evenly spaced from root to tip; 1: the same all along.
    pub knots: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { noise: None, knots: 1 }
    }
}

/// Most knots of a natural strain. Chosen: a knot needs some points of its own.
pub const MOST_KNOTS: usize = 16;

impl Options {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`KnownError`], for the first that is wrong.
    pub fn check(&self) -> Result<(), KnownError> {
        if let Some(noise) = self.noise
            && !(1e-9..=0.1).contains(&noise)
        {
            let allowed = "from 1e-9 to 0.1 m";
            return Err(KnownError { quantity: "noise", value: noise, allowed });
        }
        if (1..=MOST_KNOTS).contains(&self.knots) {
            Ok(())
        } else {
            let value = self.knots as f64;
            Err(KnownError { quantity: "number of knots", value, allowed: "from 1 to 16" })
        }
    }
}
