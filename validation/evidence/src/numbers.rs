//! Numbers as text, for tables and plots.

/// A measured number with about four significant digits.
pub(crate) fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if (x - x.round()).abs() < 1e-9 * x.abs() && x.abs() < 1e6 {
        return format!("{x:.0}");
    }
    match x.abs() {
        a if !(1e-3..1e6).contains(&a) => format!("{x:.2e}"),
        a => {
            let digits = (3 - a.log10().floor() as i32).clamp(0, 6) as usize;
            format!("{x:.digits$}")
        }
    }
}

/// A small number in scientific notation with two digits.
pub(crate) fn small(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.1e}") }
}

/// A number with `decimals` decimals; without a minus sign if it rounds to zero.
pub(crate) fn rounded(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.into(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_easily() {
        for (x, text) in [
            (0.0, "0"),
            (12.0, "12"),
            (7.837_347, "7.837"),
            (1.0e-7, "1.00e-7"),
            (0.012_345, "0.01235"),
            (123_456.7, "123457"),
        ] {
            assert_eq!(number(x), text);
        }
        assert_eq!([small(0.0), small(1.26e-9)], ["0", "1.3e-9"]);
        assert_eq!([rounded(-1e-9, 4), rounded(-1e-3, 3)], ["0.0000", "-0.001"]);
    }
}
