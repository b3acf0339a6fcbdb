//! What both documents say.

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
