//! An experiment: a question, a method, and a function that computes the answer.

use frisure::hairstyle::PredictError;
use frisure::progress::{Cancelled, Progress};
use frisure::rod::InvalidQuantity;
use thiserror::Error;

use crate::finding::Finding;
use crate::reference::NoSolution;

/// The number of hairs and the resolution of scans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// The effort of the tests: fewer hairs and coarser scans of the same experiments, under the same
    /// criteria.
    Quick,
    /// Everything.
    Full,
}

impl Effort {
    /// `quick` or `full`, for this effort.
    #[must_use]
    pub fn pick<T>(self, quick: T, full: T) -> T {
        match self {
            Self::Quick => quick,
            Self::Full => full,
        }
    }
}

/// An experiment without a finding.
#[derive(Debug, Error)]
pub enum Stopped {
    /// The computation was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A quantity of a rod is out of range.
    #[error(transparent)]
    Quantity(#[from] InvalidQuantity),
    /// A head of hair could not be predicted.
    #[error(transparent)]
    Predict(#[from] PredictError),
    /// The reference has no solution.
    #[error(transparent)]
    Reference(#[from] NoSolution),
    /// Any other failure.
    #[error("{0}")]
    Other(String),
}

/// A question and the function that answers it.
#[derive(Debug)]
pub struct Experiment {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading of its section of the report.
    pub title: &'static str,
    /// The question.
    pub question: &'static str,
    /// The method and the source of the truth. An empty line separates paragraphs.
    pub method: &'static str,
    /// Computes the answer.
    pub run: fn(Effort, &dyn Progress) -> Result<Finding, Stopped>,
}

/// Reports the fraction of an experiment that is done; an error if it is cancelled.
pub(crate) fn check(
    progress: &dyn Progress,
    name: &'static str,
    fraction: f64,
) -> Result<(), Cancelled> {
    progress.report(name, fraction);
    progress.check()
}
