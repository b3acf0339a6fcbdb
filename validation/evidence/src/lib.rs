//! Experiments that compare frisure with independent physics and with the figures of the paper, and their report.
//!
//! An [`Experiment`] has a question, a method and a program. The program gives a [`Finding`]: tables,
//! plots, pictures, and criteria, each with a measured number, a limit and the verdict.
//! [`report`] makes a page of findings. The reference is a closed form, a published number,
//! or a solution by [`mod@reference`], with another method and other equations. Experiments without a reference
//! state so: `invariance` compares frisure with itself, `robustness` also reports frisure's own
//! certificates, `heads` uses the paper's sentences, and `speed` measures times.
//!
//! All results except times are the same at every run.

#![forbid(unsafe_code)]

mod experiment;
mod experiments;
mod extremes;
mod finding;
mod numbers;
pub mod photos;
pub mod plot;
mod random;
pub mod reference;
pub mod report;
mod rods;

pub use experiment::{Effort, Experiment, Stopped};
pub use experiments::{EXPERIMENTS, experiment};
pub use finding::{Criterion, Finding, Item, Limit, Picture, Table, Timing};
pub use frisure::progress::{Cancelled, Progress};
