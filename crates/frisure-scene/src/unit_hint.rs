//! Hints about numbers without a unit that are out of range.

use crate::error::{Diagnostic, SceneError};
use crate::schema::{Quantity, quantity, schema};

/// Adds a hint to an error about a bare number that is out of range and has no hint.
pub(crate) fn add(error: SceneError) -> SceneError {
    match error {
        SceneError::Invalid(diagnostic)
            if diagnostic.hint.is_empty() && diagnostic.problem.is_empty() =>
        {
            let written = diagnostic.text.get(diagnostic.span.clone()).unwrap_or_default();
            let hint = hint(&diagnostic.key, written).unwrap_or_default();
            SceneError::Invalid(Box::new(Diagnostic { hint, ..*diagnostic }))
        }
        error => error,
    }
}

/// The unit that a bare number is read in, and one in which it would be in range; `key` is its path in a scene or in a step.
fn hint(key: &str, written: &str) -> Option<String> {
    let digits = written.trim_matches(['"', '\'']).replace('_', "");
    digits.parse().ok().filter(|x: &f64| x.is_finite())?;
    let steps = &schema()["properties"]["step"]["items"];
    let Quantity { dimension, min, max } =
        quantity(schema(), key).or_else(|| quantity(steps, key))?;
    let bounded = min.is_some() || max.is_some();
    let (min, max) = (min.unwrap_or(f64::NEG_INFINITY), max.unwrap_or(f64::INFINITY));
    let in_unit = dimension.in_range(&digits, min, max).filter(|_| bounded);
    let in_unit = in_unit.map(|text| format!("did you mean \"{text}\"?"));
    if dimension.si.is_empty() {
        return in_unit;
    }
    let unit = format!("a number without quotes is in {}", dimension.si);
    let example = || format!("write a unit, as in \"{}\"", dimension.example);
    Some(format!("{unit}; {}", in_unit.unwrap_or_else(example)))
}
