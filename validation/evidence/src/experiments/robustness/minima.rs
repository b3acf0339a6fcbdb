//! The number of equilibria of a hair.

use frisure::rod::minimise::{Minimiser, Newton, Problem, StoppingCriteria};
use frisure::rod::{
    Chain, ElementKind, NaturalStrain, Options, Resolution, Rod, RodSpec, Stability, equilibrium,
};
use glam::DVec3;
use rayon::prelude::*;

use crate::extremes::{largest, smallest};
use crate::random;
use crate::{Effort, Finding, Limit, Stopped, Table};

/// The number of minima of a hair, and whether gravity's branch ends in the lowest.
fn minima(spec: &RodSpec, starts: usize, seed: usize) -> Result<(usize, bool), Stopped> {
    let rod = Rod::new(spec.clone())?;
    let count = ElementKind::Jointed.resolving_elements(&rod).clamp(30, 120);
    let chain = Chain::uniform(&rod, ElementKind::Jointed, count);
    let problem = Problem::new(&chain, &[]);
    let stopping = StoppingCriteria { tolerance: 1e-9, max_iterations: 400 };
    let options = Options {
        resolution: Resolution::Elements(count),
        element: ElementKind::Jointed,
        estimate_error: false,
        eigenvalue: false,
        ..Options::default()
    };
    let branch = equilibrium(&rod, &[], &options);
    let mut found = vec![(branch.energy.total(), branch.shape.positions)];
    let mut random = random::stream(74, seed);
    for _ in 0..starts {
        let size = random.between(0.1, 1.2);
        let natural = chain.natural_shape().controls;
        let controls = natural.iter().map(|c| *c + random.cube() * size).collect();
        let minimum = Newton::default().minimise(&problem, chain.shape(controls), stopping);
        if minimum.stability != Stability::Stable {
            continue;
        }
        let line = minimum.shape.positions.clone();
        let gap = |other: &[DVec3]| {
            let pairs = line.iter().zip(other);
            largest(pairs.map(|(a, b)| a.distance(*b)))
        };
        if found.iter().all(|(_, other)| gap(other) > 0.01 * rod.length()) {
            found.push((problem.energy(&minimum.shape).total(), line));
        }
    }
    let lowest = smallest(found.iter().map(|f| f.0));
    let scale = rod.weight() * rod.length().powi(2);
    Ok((found.len(), found[0].0 <= lowest + 1e-9 * scale))
}

pub(super) fn add(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let (hairs, starts) = effort.pick((24, 12), (300, 60));
    let mut table = Table::new(
        &format!(
            "Minima found from {starts} random shapes, {hairs} hairs of each kind, 5 to 30 cm"
        ),
        &["hair", "one", "two", "three", "more", "gravity's branch is the lowest"],
    );
    let mut lowest = Vec::new();
    for (k, kind) in ["straight", "helices", "planar curls"].into_iter().enumerate() {
        let one = |i: usize| {
            let mut random = random::stream(73, i + 1_000_000 * k);
            let radius = random.decades(0.003, 0.02);
            let natural = match k {
                0 => NaturalStrain::STRAIGHT,
                1 => NaturalStrain::helix(radius, random.between(0.8, 3.0) * radius)?,
                _ => NaturalStrain::helix(radius, 0.0)?,
            };
            let length = random.between(0.05, 0.30);
            minima(&RodSpec { length, natural, ..random::realistic(&mut random)? }, starts, i)
        };
        let all: Vec<(usize, bool)> =
            (0..hairs).into_par_iter().map(one).collect::<Result<_, Stopped>>()?;
        let with = |n: usize| all.iter().filter(|a| a.0 == n).count();
        let best = all.iter().filter(|a| a.1).count();
        lowest.push(best as f64 / hairs as f64);
        table.row([
            kind.to_owned(),
            with(1).to_string(),
            with(2).to_string(),
            with(3).to_string(),
            (hairs - with(1) - with(2) - with(3)).to_string(),
            format!("{best} of {hairs}"),
        ]);
    }
    finding.table(table);
    finding.check(
        "share of helices in which gravity's branch is the lowest minimum found",
        lowest[1],
        Limit::AtLeast(0.9),
    );
    Ok(())
}
