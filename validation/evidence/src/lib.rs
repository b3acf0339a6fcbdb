//! The book of evidence: experiments that compare frisure with independent physics and against the
//! figures of the paper.
//!
//! An [`Experiment`] has a question, a method and a program. The program gives a [`Finding`]: tables,
//! plots, pictures, and criteria, each with what was measured, what is allowed, and the verdict that
//! follows. [`report`] makes a page of findings. What is compared with is a closed form, a published number,
//! or what [`mod@reference`] solves, by another method from other equations. Where there is none of these, the
//! experiment says so: `invariance` holds frisure against itself, `robustness` also tells frisure's own
//! certificates, `heads` has the paper's sentences, and `speed` has a clock.
//!
//! Everything but times is the same at every run.

#![forbid(unsafe_code)]

mod experiments;
mod extremes;
mod finding;
pub mod plot;
mod random;
pub mod reference;
pub mod report;
mod rods;

pub use experiments::EXPERIMENTS;
pub use finding::{Criterion, Finding, Item, Limit, Picture, Table, Timing};
pub use frisure::progress::{Cancelled, Progress};

use frisure::hairstyle::PredictError;
use frisure::rod::InvalidQuantity;
use thiserror::Error;

/// How much is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// What runs in the tests: fewer hairs and coarser scans of the same experiments, under the same
    /// criteria.
    Quick,
    /// Everything.
    Full,
}

impl Effort {
    /// One of two values.
    #[must_use]
    pub fn pick<T>(self, quick: T, full: T) -> T {
        match self {
            Self::Quick => quick,
            Self::Full => full,
        }
    }
}

/// Why an experiment gave no finding.
#[derive(Debug, Error)]
pub enum Stopped {
    /// The progress said to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A rod of the experiment is none.
    #[error(transparent)]
    Quantity(#[from] InvalidQuantity),
    /// A head of hair could not be predicted.
    #[error(transparent)]
    Predict(#[from] PredictError),
    /// The reference could not be computed.
    #[error(transparent)]
    Reference(#[from] reference::NoSolution),
    /// Something else that the experiment needs.
    #[error("{0}")]
    Other(String),
}

/// A question, and the program that answers it.
#[derive(Debug)]
pub struct Experiment {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading of its part of the report.
    pub title: &'static str,
    /// What is asked.
    pub question: &'static str,
    /// How it is answered, and where the truth is from. Paragraphs are apart by an empty line.
    pub method: &'static str,
    /// The program.
    pub run: fn(Effort, &dyn Progress) -> Result<Finding, Stopped>,
}

/// The experiment of that name.
#[must_use]
pub fn experiment(name: &str) -> Option<&'static Experiment> {
    EXPERIMENTS.iter().copied().find(|e| e.name == name)
}
