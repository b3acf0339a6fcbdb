//! What both documents say.

use crate::{Criterion, Effort, Finding, Limit};

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

pub(super) fn verdict_of(finding: &Finding) -> String {
    let (count, held) = counts(finding);
    match count - held {
        0 => format!("all {count} criteria hold"),
        failed => format!("{failed} of {count} criteria FAIL"),
    }
}

/// How many criteria there are, and how many of them hold.
pub(super) fn counts(finding: &Finding) -> (usize, usize) {
    (finding.criteria.len(), finding.criteria.iter().filter(|c| c.holds()).count())
}

pub(super) fn effort(effort: Effort) -> &'static str {
    match effort {
        Effort::Quick => {
            "This is the quick run: fewer hairs and coarser scans than `frisure validate --full`, \
             under the same criteria."
        }
        Effort::Full => "This is the full run.",
    }
}

pub(super) const TITLE: &str = "frisure: the book of evidence";

pub(super) const INTRODUCTION: &str = "Each experiment asks a question, says how it is answered and \
    where the truth is from, shows what came out, and judges it by criteria. What is compared with \
    is never computed by the code that is judged.";

pub(super) const TIMES: &str = "Of the machine that wrote this, and of nothing else; they decide \
    nothing, and are the only numbers here that change from run to run.";

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
    }
}
