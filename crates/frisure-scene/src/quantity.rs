//! Quantities as people write them: `25 cm`, `70 um`, `2.5 GPa`, `80 deg`.

use std::f64::consts::{PI, TAU};

use thiserror::Error;

/// A kind of quantity: its name and the units it can be written in.
#[derive(Debug, PartialEq)]
pub struct Dimension {
    /// What the quantity is, such as `a length`.
    pub name: &'static str,
    /// SI unit of a bare number; empty for pure numbers.
    pub si: &'static str,
    /// A value as one could write it.
    pub example: &'static str,
    /// Units in plain characters, and the factor to SI.
    units: &'static [(&'static str, f64)],
}

/// Why a text is not a quantity of a dimension.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum QuantityError {
    /// It does not start with a number.
    #[error("it must start with a number")]
    NoNumber,
    /// The number is infinite or not a number.
    #[error("it must be a finite number")]
    NotFinite,
    /// There is no unit.
    #[error("it has no unit")]
    NoUnit,
    /// The unit is not known.
    #[error("`{unit}` is not a unit of {of}")]
    UnknownUnit {
        /// The unit as written.
        unit: String,
        /// The expected dimension, such as `a length`.
        of: &'static str,
        /// The dimension that the unit does belong to.
        belongs_to: Option<&'static str>,
    },
}

/// Lengths, SI m.
pub const LENGTH: Dimension = Dimension {
    name: "a length",
    si: "m",
    example: "25 cm",
    units: &[("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6), ("nm", 1e-9), ("in", 0.0254)],
};

/// Angles, SI rad.
pub const ANGLE: Dimension = Dimension {
    name: "an angle",
    si: "rad",
    example: "30 deg",
    units: &[("deg", PI / 180.0), ("rad", 1.0), ("turn", TAU), ("°", PI / 180.0)],
};

/// Elastic moduli and pressures, SI Pa.
pub const PRESSURE: Dimension = Dimension {
    name: "a modulus",
    si: "Pa",
    example: "3.9 GPa",
    units: &[("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.0), ("N/m^2", 1.0)],
};

/// Densities, SI kg/m³.
pub const DENSITY: Dimension = Dimension {
    name: "a density",
    si: "kg/m^3",
    example: "1.3 g/cm^3",
    units: &[("g/cm^3", 1e3), ("kg/m^3", 1.0)],
};

/// Curvatures and twists, SI rad/m.
pub const STRAIN: Dimension = Dimension {
    name: "a curvature or twist",
    si: "rad/m",
    example: "100 1/m",
    units: &[
        ("1/m", 1.0),
        ("rad/m", 1.0),
        ("1/cm", 1e2),
        ("rad/cm", 1e2),
        ("1/mm", 1e3),
        ("rad/mm", 1e3),
        ("deg/cm", PI / 1.8),
        ("m^-1", 1.0),
        ("cm^-1", 1e2),
        ("mm^-1", 1e3),
    ],
};

/// Areas of sections, SI m².
pub const AREA: Dimension = Dimension {
    name: "an area",
    si: "m^2",
    example: "4000 um^2",
    units: &[("um^2", 1e-12), ("mm^2", 1e-6), ("cm^2", 1e-4), ("m^2", 1.0)],
};

/// Numbers of things per area, SI 1/m².
pub const NUMBER_DENSITY: Dimension = Dimension {
    name: "a number per area",
    si: "1/m^2",
    example: "190 1/cm^2",
    units: &[
        ("1/cm^2", 1e4),
        ("1/mm^2", 1e6),
        ("1/m^2", 1.0),
        ("/cm^2", 1e4),
        ("/mm^2", 1e6),
        ("cm^-2", 1e4),
        ("m^-2", 1.0),
    ],
};

/// Accelerations, SI m/s².
pub const ACCELERATION: Dimension = Dimension {
    name: "an acceleration",
    si: "m/s^2",
    example: "9.81 m/s^2",
    units: &[("m/s^2", 1.0), ("cm/s^2", 1e-2)],
};

/// A month (s), the twelfth part of a year of 365.2425 days.
pub const MONTH: f64 = 30.436_875 * 86_400.0;

/// Times, SI s.
pub const TIME: Dimension = Dimension {
    name: "a time",
    si: "s",
    example: "6 weeks",
    units: &[
        ("days", 86_400.0),
        ("day", 86_400.0),
        ("weeks", 604_800.0),
        ("week", 604_800.0),
        ("months", MONTH),
        ("month", MONTH),
        ("years", 12.0 * MONTH),
        ("year", 12.0 * MONTH),
        ("s", 1.0),
    ],
};

/// Speeds of wind, SI m/s.
pub const VELOCITY: Dimension = Dimension {
    name: "a speed",
    si: "m/s",
    example: "5 m/s",
    units: &[("m/s", 1.0), ("km/h", 1.0 / 3.6)],
};

/// Speeds, as hair grows; SI m/s.
pub const SPEED: Dimension = Dimension {
    name: "a speed",
    si: "m/s",
    example: "1.2 cm/month",
    units: &[
        ("cm/month", 1.0 / (100.0 * MONTH)),
        ("mm/month", 1.0 / (1000.0 * MONTH)),
        ("mm/day", 1.0 / 86_400_000.0),
        ("um/day", 1.0 / 86_400_000_000.0),
        ("m/s", 1.0),
    ],
};

/// Pure numbers; a text may give a percentage.
pub const RATIO: Dimension =
    Dimension { name: "a number", si: "", example: "0.1", units: &[("%", 1e-2)] };

/// The dimensions by their SI units; of speeds, that of growth.
static ALL: [&Dimension; 12] = [
    &LENGTH,
    &AREA,
    &ANGLE,
    &PRESSURE,
    &DENSITY,
    &STRAIN,
    &NUMBER_DENSITY,
    &ACCELERATION,
    &TIME,
    &SPEED,
    &VELOCITY,
    &RATIO,
];

impl Dimension {
    /// The value in SI units of a text such as `25 cm`.
    ///
    /// # Errors
    /// [`QuantityError`].
    pub fn parse(&self, text: &str) -> Result<f64, QuantityError> {
        let text = text.trim();
        let (number, unit) = text.split_at(number_length(text));
        let number: f64 = number.parse().map_err(|_| QuantityError::NoNumber)?;
        let unit = plain(unit);
        let factor = match self.factor(&unit) {
            Some(factor) => factor,
            None if unit.is_empty() && self.si.is_empty() => 1.0,
            None if unit.is_empty() => return Err(QuantityError::NoUnit),
            None => {
                let belongs_to = ALL.iter().find(|d| d.factor(&unit).is_some()).map(|d| d.name);
                return Err(QuantityError::UnknownUnit { unit, of: self.name, belongs_to });
            }
        };
        let value = scaled(number, factor);
        if value.is_finite() { Ok(value) } else { Err(QuantityError::NotFinite) }
    }

    /// The value as a person would write it, in one of some units: the shortest text of at most six
    /// digits that reads as exactly this number, if there is one.
    pub(crate) fn text(&self, value: f64, units: &[&str]) -> Option<String> {
        let exact = |text: &String| {
            self.parse(text).is_ok_and(|parsed| parsed.to_bits() == value.to_bits())
        };
        let written = |unit: &&str| {
            // Rounded to six digits, and printed with as many as that leaves.
            let scaled = value / self.factor(unit)?;
            let short: f64 = format!("{scaled:.5e}").parse().ok()?;
            (short.abs() < 1e6).then(|| format!("{short} {unit}")).filter(exact)
        };
        units.iter().filter_map(written).min_by_key(String::len)
    }

    /// The value as a person would write it, to four digits, in a unit in which the number is handy: a
    /// curl in mm, hair in cm. Pure numbers have no unit.
    #[must_use]
    pub fn written(&self, value: f64) -> String {
        let unit = self.handy(value);
        let scaled = value / unit.and_then(|unit| self.factor(unit)).unwrap_or(1.0);
        // Four digits, without the zeros at their end.
        let short: f64 = format!("{scaled:.3e}").parse().unwrap_or(scaled);
        let number = match short.abs() {
            x if x != 0.0 && !(1e-5..1e9).contains(&x) => format!("{short:e}"),
            _ => format!("{short}"),
        };
        unit.map_or(number.clone(), |unit| format!("{number} {unit}"))
    }

    /// The unit in which a value is handy.
    fn handy(&self, value: f64) -> Option<&'static str> {
        let steps: &[(f64, &str)] = match self.si {
            "" => return None,
            "m" => &[(1e-3, "um"), (4.95e-2, "mm"), (2.0, "cm"), (f64::INFINITY, "m")],
            "Pa" => &[(1e3, "Pa"), (1e6, "kPa"), (1e9, "MPa"), (f64::INFINITY, "GPa")],
            "s" => &[(86_400.0, "s"), (1_209_600.0, "days"), (f64::INFINITY, "months")],
            _ => &[],
        };
        let usual = self.example[number_length(self.example)..].trim();
        let usual = self.units().find(|unit| *unit == usual);
        let size = value.abs();
        let fitting = steps.iter().find(|(most, _)| size < *most && size > 0.0);
        fitting.map(|(_, unit)| *unit).or(usual)
    }

    /// A number written without a unit, in the first unit but SI's own in which it is within `least`
    /// and `most` (SI); the unit of the example comes first. Of pure numbers only fractions are meant
    /// in per cent.
    pub(crate) fn in_range(&self, number: &str, least: f64, most: f64) -> Option<String> {
        if self.si.is_empty() && most > 1.0 {
            return None;
        }
        let usual = self.example[number_length(self.example)..].trim();
        let others = self.units().filter(|unit| *unit != usual && *unit != self.si);
        let in_unit = |unit: &str| format!("{number} {unit}");
        let fits = |text: &String| self.parse(text).is_ok_and(|x| (least..=most).contains(&x));
        Some(usual).into_iter().filter(|u| !u.is_empty()).chain(others).map(in_unit).find(fits)
    }

    /// Every dimension.
    pub(crate) fn all() -> &'static [&'static Self] {
        &ALL
    }

    /// The dimension that a unit is SI's own unit of, the one with an example where there are several: wind and hair have
    /// speeds in other units. The empty unit is that of pure numbers.
    pub(crate) fn of_si(unit: &str, example: Option<&str>) -> Option<&'static Self> {
        let mut of_unit = ALL.into_iter().filter(|dimension| dimension.si == unit);
        let first = of_unit.clone().next();
        of_unit.find(|dimension| Some(dimension.example) == example).or(first)
    }

    /// Units that can be written, the most usual first.
    pub fn units(&self) -> impl Iterator<Item = &'static str> {
        self.units.iter().map(|u| u.0)
    }

    fn factor(&self, unit: &str) -> Option<f64> {
        self.units.iter().find(|u| u.0 == unit).map(|u| u.1)
    }
}

/// `number × factor`, rounded as the decimal text is: 70 × 1e-6 is not 70e-6 in binary, 70 / 1e6 is.
fn scaled(number: f64, factor: f64) -> f64 {
    let inverse = (1.0 / factor).round();
    if factor < 1.0 && 1.0 / inverse == factor { number / inverse } else { number * factor }
}

/// The unit in plain characters: no spaces, `u` for µ, `^2` for ².
fn plain(unit: &str) -> String {
    let mut out = String::with_capacity(unit.len());
    for c in unit.chars() {
        match c {
            // MICRO SIGN and GREEK SMALL LETTER MU look the same and are both on keyboards.
            'µ' | 'μ' => out.push('u'),
            // After a raised minus the power has begun already.
            '²' => out.push_str(if out.ends_with("^-") { "2" } else { "^2" }),
            '³' => out.push_str(if out.ends_with("^-") { "3" } else { "^3" }),
            '⁻' => out.push_str("^-"),
            '¹' => out.push('1'),
            c if c.is_whitespace() => {}
            c => out.push(c),
        }
    }
    out
}

/// Length in bytes of the decimal number that a text starts with.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut end = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    end += digits(end);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    // An `e` is an exponent only if digits follow: `2 em` is not a number with a broken exponent.
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits((end + 1 + sign).min(bytes.len()));
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_as_people_write_them() {
        let cases: &[(&Dimension, &str, f64)] = &[
            (&LENGTH, "25 cm", 0.25),
            (&LENGTH, "70um", 70e-6),
            (&LENGTH, "70 µm", 70e-6),
            (&LENGTH, "70 μm", 70e-6),
            (&LENGTH, " 1.5e-2 m ", 0.015),
            (&LENGTH, "+.5 mm", 0.0005),
            (&LENGTH, "10 in", 0.254),
            (&ANGLE, "90 deg", PI / 2.0),
            (&ANGLE, "90°", PI / 2.0),
            (&PRESSURE, "2.5 GPa", 2.5e9),
            (&DENSITY, "1.3 g/cm³", 1300.0),
            (&DENSITY, "1300 kg / m^3", 1300.0),
            (&STRAIN, "100 1/m", 100.0),
            (&STRAIN, "-100 rad/m", -100.0),
            (&STRAIN, "1 mm⁻¹", 1000.0),
            (&NUMBER_DENSITY, "190 1/cm^2", 190e4),
            (&NUMBER_DENSITY, "1.9/mm²", 1.9e6),
            (&NUMBER_DENSITY, "190 cm⁻²", 190e4),
            (&ACCELERATION, "9.81 m/s²", 9.81),
            (&TIME, "2 weeks", 1_209_600.0),
            (&TIME, "1 year", 365.2425 * 86_400.0),
            (&SPEED, "3 mm/day", 3.0 / 86_400_000.0),
            (&SPEED, "367 µm/day", 367.0 / 86_400_000_000.0),
            (&RATIO, "5 %", 0.05),
            (&RATIO, "0.3", 0.3),
        ];
        for (dimension, text, value) in cases {
            assert_eq!(dimension.parse(text), Ok(*value), "{text}");
        }
    }

    #[test]
    fn a_number_is_written_as_a_person_would() {
        let cases: &[(&Dimension, f64, &str)] = &[
            (&LENGTH, 0.009_5, "9.5 mm"),
            (&LENGTH, 70e-6, "70 um"),
            (&LENGTH, 0.28, "28 cm"),
            (&LENGTH, 0.0, "0 cm"),
            (&LENGTH, -0.02, "-20 mm"),
            (&LENGTH, 2.5, "2.5 m"),
            (&LENGTH, 0.123_456, "12.35 cm"),
            (&ANGLE, PI / 6.0, "30 deg"),
            (&PRESSURE, 3.9e9, "3.9 GPa"),
            (&PRESSURE, 0.5, "0.5 Pa"),
            (&DENSITY, 1320.0, "1.32 g/cm^3"),
            (&NUMBER_DENSITY, 1.9e6, "190 1/cm^2"),
            (&STRAIN, 100.0, "100 1/m"),
            (&ACCELERATION, 9.81, "9.81 m/s^2"),
            (&TIME, 604_800.0, "7 days"),
            (&SPEED, 0.012 / MONTH, "1.2 cm/month"),
            (&RATIO, 0.25, "0.25"),
        ];
        for (dimension, value, text) in cases {
            assert_eq!(&dimension.written(*value), text);
        }
    }

    #[test]
    fn what_is_written_reads_as_the_same_to_four_digits() {
        for dimension in ALL {
            for exponent in -12..12 {
                for digits in [1.0, 1.2345, -9.999_96] {
                    let value = digits * 10_f64.powi(exponent);
                    let text = dimension.written(value);
                    let read = dimension.parse(&text).unwrap();
                    assert!((read / value - 1.0).abs() < 5e-4, "{text} is not {value}");
                }
            }
        }
    }

    #[test]
    fn what_is_not_a_quantity() {
        let bad = |d: &Dimension, t: &str| d.parse(t).unwrap_err();
        for text in ["", "cm", "inf m", "nan", "--1 m", "e5 m", ".", "- m", "∞ m"] {
            assert_eq!(bad(&LENGTH, text), QuantityError::NoNumber, "{text}");
        }
        assert_eq!(bad(&LENGTH, "25"), QuantityError::NoUnit);
        assert_eq!(bad(&LENGTH, "1e999 m"), QuantityError::NotFinite);
        let QuantityError::UnknownUnit { unit, belongs_to, .. } = bad(&LENGTH, "3 GPa") else {
            panic!("a pressure is not a length");
        };
        assert_eq!((unit.as_str(), belongs_to), ("GPa", Some("a modulus")));
        assert!(matches!(bad(&LENGTH, "2 em"), QuantityError::UnknownUnit { .. }));
        assert!(matches!(bad(&LENGTH, "1 2 m"), QuantityError::UnknownUnit { .. }));
    }

    #[test]
    fn a_bare_number_is_meant_in_the_first_unit_that_fits() {
        let in_range = |d: &Dimension, number, least, most| d.in_range(number, least, most);
        let text = |text: &str| Some(text.to_owned());
        assert_eq!(in_range(&ANGLE, "45", 0.0, PI), text("45 deg"));
        assert_eq!(in_range(&ANGLE, "1000", 0.0, PI), None);
        assert_eq!(in_range(&LENGTH, "8", 1e-3, 3.0), text("8 cm"));
        assert_eq!(in_range(&LENGTH, "15", 1e-3, 0.1), text("15 mm"));
        assert_eq!(in_range(&LENGTH, "70", 1e-5, 1e-3), text("70 um"));
        assert_eq!(in_range(&RATIO, "50", 0.0, 1.0), text("50 %"));
        assert_eq!(in_range(&RATIO, "50", 0.0, 0.4), None);
        // Months are no fraction.
        assert_eq!(in_range(&RATIO, "300", 0.0, 240.0), None);
        for d in ALL {
            assert_eq!(Dimension::of_si(d.si, Some(d.example)), Some(d));
        }
    }

    #[test]
    fn every_example_is_a_value() {
        for d in ALL {
            assert!(d.parse(d.example).is_ok(), "{}", d.example);
        }
    }
}
