//! Text of both documents.

use super::book::Book;
use crate::numbers::number;
use crate::{Criterion, EXPERIMENTS, Effort, Limit};

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

/// The version of frisure and the effort of the report.
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

/// The experiments that were not run.
pub(super) fn left_out(book: &Book<'_>) -> Option<String> {
    let run = |name: &str| book.chapters.iter().any(|(e, _)| e.name == name);
    let names: Vec<&str> = EXPERIMENTS.iter().map(|e| e.name).filter(|name| !run(name)).collect();
    (!names.is_empty()).then(|| format!("Not run: {}.", names.join(", ")))
}

pub(super) const TITLE: &str = "frisure: validation report";

pub(super) const INTRODUCTION: &str = "Each experiment has a question, a method with its \
    reference, results, and criteria. The reference is a closed form, a \
    published number, or Kirchhoff's equations solved as a boundary-value problem. Experiments without such a reference \
    state so: `invariance` compares frisure with itself, `robustness` also reports frisure's own \
    certificates, `heads` compares heads with sentences of the paper, and `speed` measures one machine.";

/// Above the times.
pub(super) fn times() -> String {
    format!(
        "The times are those of the machine that wrote this report, with {} threads. They have no criteria, and are the \
         only numbers here that change from run to run.",
        rayon::current_num_threads()
    )
}
