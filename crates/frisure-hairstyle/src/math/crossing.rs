//! Where a function first becomes positive.

/// Where a function first becomes positive between 0 and `end`, searched in `steps` steps; the step
/// is then bisected `halvings` times. 0 if it is positive there, none if it is positive nowhere.
pub(crate) fn first_positive(
    end: f64,
    steps: usize,
    halvings: u32,
    value: impl Fn(f64) -> f64,
) -> Option<f64> {
    let place = |k: usize| k as f64 / steps as f64 * end;
    let first = (0..=steps).find(|&k| value(place(k)) > 0.0)?;
    let (mut before, mut after) = (place(first.saturating_sub(1)), place(first));
    for _ in 0..halvings {
        let middle = 0.5 * (before + after);
        if value(middle) > 0.0 {
            after = middle;
        } else {
            before = middle;
        }
    }
    Some(before)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_several_crossings_is_found() {
        let found = |f: fn(f64) -> f64| first_positive(4.0, 64, 40, f);
        let third = found(|x| (x - 1.0 / 3.0) * (1.0 - x)).unwrap();
        assert!((third - 1.0 / 3.0).abs() < 1e-11);
        assert_eq!(found(|_| 1.0), Some(0.0));
        assert_eq!(found(|_| -1.0), None);
    }
}
