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

use crate::{Cancelled, Experiment, Monitor};

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

/// Says how far an experiment is, and hears whether it should stop.
fn check(monitor: &dyn Monitor, name: &'static str, fraction: f64) -> Result<(), Cancelled> {
    monitor.progress(name, fraction);
    if monitor.cancelled() { Err(Cancelled) } else { Ok(()) }
}
