//! The experiments, one per file, in the order of the report.

mod buckling;
mod convergence;
mod elastica;
mod friction;
mod growth;
mod heads;
mod invariance;
mod photo;
mod ponytail;
mod robustness;
mod set;
mod single;
mod speed;
mod suspended;
mod types;

mod curls;
mod plane;
mod sphere;
mod surfaces;

use crate::Experiment;

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
    &friction::EXPERIMENT,
    &set::EXPERIMENT,
    &ponytail::EXPERIMENT,
    &photo::EXPERIMENT,
    &speed::EXPERIMENT,
];

/// The experiment with the name `name`.
#[must_use]
pub fn experiment(name: &str) -> Option<&'static Experiment> {
    EXPERIMENTS.iter().copied().find(|e| e.name == name)
}
