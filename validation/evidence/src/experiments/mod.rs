//! The experiments, one per file, in the order of the report.

mod buckling;
mod convergence;
mod elastica;
mod growth;
mod heads;
mod invariance;
mod robustness;
mod single;
mod speed;
mod suspended;
mod types;

mod curls;
mod plane;
mod sphere;

use crate::{Cancelled, Experiment, Progress};

/// Every experiment.
pub const EXPERIMENTS: &[&Experiment] = &[
    &elastica::EXPERIMENT,
    &buckling::EXPERIMENT,
    &convergence::EXPERIMENT,
    &invariance::EXPERIMENT,
    &single::EXPERIMENT,
    &growth::EXPERIMENT,
    &suspended::EXPERIMENT,
    &robustness::EXPERIMENT,
    &types::EXPERIMENT,
    &heads::EXPERIMENT,
    &speed::EXPERIMENT,
];

/// Reports the fraction of an experiment; an error if it is cancelled.
fn check(progress: &dyn Progress, name: &'static str, fraction: f64) -> Result<(), Cancelled> {
    progress.report(name, fraction);
    progress.check()
}
