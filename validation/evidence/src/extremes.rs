//! Largest and smallest of measured numbers. `f64::max` ignores NaN, so a criterion could hold by mistake; here one NaN
//! makes the result NaN, and so does an empty set.

/// Returns the largest number; NaN if one is NaN or there is none.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().reduce(larger).unwrap_or(f64::NAN)
}

/// Returns the smallest number; NaN if one is NaN or there is none.
pub(crate) fn smallest(values: impl IntoIterator<Item = f64>) -> f64 {
    -largest(values.into_iter().map(|x| -x))
}

/// The larger of two numbers; NaN if either is NaN.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_and_empty_sets_give_nan() {
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        assert_eq!(smallest([1.0, -3.0, 2.0]), -3.0);
        for values in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            assert!(largest(values).is_nan() && smallest(values).is_nan());
        }
        assert!(largest([]).is_nan() && smallest([]).is_nan());
    }
}
