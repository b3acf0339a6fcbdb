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

mod experiment;
mod experiments;
mod extremes;
mod finding;
mod numbers;
pub mod plot;
mod random;
pub mod reference;
pub mod report;
mod rods;

pub use experiment::{Effort, Experiment, Stopped};
pub use experiments::{EXPERIMENTS, experiment};
pub use finding::{Criterion, Finding, Item, Limit, Picture, Table, Timing};
pub use frisure::progress::{Cancelled, Progress};
