//! What both documents say.

use super::Book;
use crate::{Criterion, EXPERIMENTS, Effort, Limit};

/// A measured number with as many digits as one reads.
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

/// A small number with two digits, and none of its minus where nothing is left.
pub(crate) fn small(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.1e}") }
}

/// So many decimals, without the minus of a number that is rounded to nothing.
pub(crate) fn rounded(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.into(),
        _ => text,
    }
}

pub(super) fn limit(limit: Limit) -> String {
    match limit {
        Limit::AtMost(x) => format!("at most {}", number(x)),
        Limit::AtLeast(x) => format!("at least {}", number(x)),
        Limit::Between(a, b) => format!("{} to {}", number(a), number(b)),
    }
}

pub(super) fn verdict(criterion: &Criterion) -> &'static str {
    if criterion.holds() { "holds" } else { "FAILS" }
}

/// Who wrote the report, and how.
pub(super) fn written(book: &Book<'_>) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let run = match book.effort {
        Effort::Quick => {
            "It is the quick run: fewer hairs and coarser scans than `frisure validate --full`, under the same criteria."
        }
        Effort::Full => "It is the full run.",
    };
    format!(
        "Written by frisure {version}. {run} Random hair is drawn from seeds that are fixed in the code, the same at \
         every run and on any number of threads."
    )
}

/// Which experiments the report is not of.
pub(super) fn left_out(book: &Book<'_>) -> Option<String> {
    let run = |name: &str| book.chapters.iter().any(|(e, _)| e.name == name);
    let names: Vec<&str> = EXPERIMENTS.iter().map(|e| e.name).filter(|name| !run(name)).collect();
    (!names.is_empty()).then(|| format!("Not run, and not told of here: {}.", names.join(", ")))
}

pub(super) const TITLE: &str = "frisure: the book of evidence";

pub(super) const INTRODUCTION: &str = "Each experiment asks a question, says how it is answered and \
    where the truth is from, shows what came out, and judges it by criteria. The truth is a closed form, a \
    published number, or Kirchhoff's equations solved as a boundary-value problem. Where there is none, an \
    experiment says so: what must not matter is frisure against itself, how often it fails is also told by its own \
    certificates, heads are held against sentences of the paper, and speed is of one machine.";

/// Above the times.
pub(super) fn times() -> String {
    format!(
        "Of the machine that wrote this, with {} threads, and of nothing else; they decide nothing, and are the \
         only numbers here that change from run to run.",
        rayon::current_num_threads()
    )
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
