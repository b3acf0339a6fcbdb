//! The scale of a photo, as people write it.

use thiserror::Error;

/// Pixels per metre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale(f64);

/// Why a text is no scale.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ScaleError {
    /// It does not start with a number.
    #[error("it must start with a number, such as \"52 px/mm\"")]
    NoNumber,
    /// There is no unit.
    #[error("it has no unit; it must be such as \"52 px/mm\"")]
    NoUnit,
    /// The unit is not known.
    #[error(
        "`{0}` is no unit of a scale; the units are px/mm, px/cm, px/m, px/in, dpi, um/px and mm/px"
    )]
    Unit(String),
    /// The number is out of range.
    #[error("it must be from 10 px/m to 1e7 px/m (0.01 px/mm to 10000 px/mm)")]
    Range,
}

/// Units, the factor to pixels per metre, and whether it is a length per pixel.
const UNITS: [(&str, f64, bool); 11] = [
    ("px/mm", 1e3, false),
    ("px/cm", 1e2, false),
    ("px/m", 1.0, false),
    ("px/in", 1.0 / 0.0254, false),
    ("px/inch", 1.0 / 0.0254, false),
    ("dpi", 1.0 / 0.0254, false),
    ("ppi", 1.0 / 0.0254, false),
    ("um/px", 1e6, true),
    ("µm/px", 1e6, true),
    ("mm/px", 1e3, true),
    ("cm/px", 1e2, true),
];

impl Scale {
    /// A scale of so many pixels per metre.
    ///
    /// # Errors
    /// [`ScaleError::Range`].
    pub fn new(pixels_per_metre: f64) -> Result<Self, ScaleError> {
        let good = (10.0..=1e7).contains(&pixels_per_metre);
        if good { Ok(Self(pixels_per_metre)) } else { Err(ScaleError::Range) }
    }

    /// Reads `52 px/mm`, `520 px/cm`, `1200 dpi`, `19 um/px`.
    ///
    /// # Errors
    /// [`ScaleError`].
    pub fn parse(text: &str) -> Result<Self, ScaleError> {
        let text = text.trim();
        let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-');
        let exponent = |i: usize| {
            let rest = &text.as_bytes()[i + 1..];
            rest.first().is_some_and(|c| c.is_ascii_digit() || matches!(c, b'+' | b'-'))
        };
        let end = text
            .char_indices()
            .find(|&(i, c)| !(number(c) || i > 0 && matches!(c, 'e' | 'E') && exponent(i)))
            .map_or(text.len(), |(i, _)| i);
        let value: f64 = text[..end].parse().map_err(|_| ScaleError::NoNumber)?;
        let unit: String = text[end..].split_whitespace().collect();
        if unit.is_empty() {
            return Err(ScaleError::NoUnit);
        }
        let plain = unit.replace("pixels", "px").replace("pixel", "px").replace('μ', "µ");
        let known = UNITS.iter().find(|(name, ..)| name.eq_ignore_ascii_case(&plain));
        let &(_, factor, inverse) = known.ok_or(ScaleError::Unit(unit))?;
        Self::new(if inverse { factor / value } else { factor * value })
    }

    /// Pixels per metre.
    #[must_use]
    pub fn pixels_per_metre(self) -> f64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_read_with_their_units() {
        let cases = [
            ("52 px/mm", 52e3),
            ("520px/cm", 52e3),
            ("1.2e3 dpi", 1200.0 / 0.0254),
            ("20 um/px", 5e4),
            ("20 µm/px", 5e4),
            ("0.1 mm / px", 1e4),
        ];
        for (text, pixels) in cases {
            let found = Scale::parse(text).unwrap().pixels_per_metre();
            assert!((found / pixels - 1.0).abs() < 1e-12, "{text}: {found}");
        }
        for text in ["", "px/mm", "52", "52 mm", "0 px/mm", "-3 px/mm", "nan px/mm", "inf px/mm"] {
            assert!(Scale::parse(text).is_err(), "{text}");
        }
        for text in ["1e300 px/mm", "0 um/px", "1e 3 px/mm"] {
            assert!(Scale::parse(text).is_err(), "{text}");
        }
    }
}
