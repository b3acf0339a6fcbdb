//! How often it fails.

use frisure::rod::batch::Batch;
use frisure::rod::minimise::{Minimiser, Problem, Riccati, Stopping};
use frisure::rod::{
    Chain, ElementKind, Equilibrium, NaturalStrain, Options, Resolution, Rod, RodSpec, Stability,
    equilibrium,
};
use glam::DVec3;
use rayon::prelude::*;

use crate::plot::{Mark, Plot, Scale};
use crate::random::Random;
use crate::reference::Hanging;
use crate::rods::{elements, line};
use crate::{Effort, Experiment, Finding, Limit, Monitor, Stopped, Table};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "robustness",
    title: "Robustness: ten thousand hairs, and a thousand that no one has",
    question: "How many random hairs come to rest, in how many iterations, with what certificate; and how many \
        equilibria does a curly hair have?",
    method: "Realistic hairs: 1 to 60 cm, 45 to 110 µm, axis ratio 1 to 2, E 1 to 5 GPa, straight, curled in a plane, or \
        helices of 1.5 to 60 mm, roots anywhere; solved to 0.1 mm. Absurd ones: a millimetre to ten metres, axis \
        ratios up to 10, moduli of rubber to diamond, Γ from 0 to 30 000, natural turns up to forty; solved to a thousandth of the \
        length with at most 4000 elements. The certificate of each is its relative gradient and whether its second \
        variation is positive. Some realistic hairs are solved by the boundary-value problem too, which gives up where \
        it cannot follow a stable branch: where it does not, the lines are compared.\n\n\
        Equilibria are counted by minimising from random shapes: every element of a division into 30 to 120 is \
        turned at random about its natural turn. Minima whose lines differ by more than a hundredth of the length are \
        two.",
    run,
};

fn run(effort: Effort, monitor: &dyn Monitor) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    let realistic = solved(effort.pick(400, 10_000), monitor, 0.0, |i| {
        let spec = Random::new(71, i).realistic()?;
        Ok((spec, Resolution::Accuracy(1e-4)))
    })?;
    let absurd = solved(effort.pick(60, 1000), monitor, 0.4, |i| {
        let spec = Random::new(72, i).absurd()?;
        let accuracy = 1e-3 * spec.length;
        Ok((spec, Resolution::Accuracy(accuracy)))
    })?;
    told(&mut finding, &realistic, &absurd);
    compared(&mut finding, effort)?;
    super::check(monitor, "robustness", 0.8)?;
    side_by_side(&mut finding, effort)?;
    super::check(monitor, "robustness", 0.85)?;
    counted(&mut finding, effort)?;
    Ok(finding)
}

/// What is known of a hair that was solved.
struct Solved {
    stability: Stability,
    gradient: f64,
    iterations: usize,
    elements: usize,
    /// Estimate of the error over what was asked for.
    estimate: f64,
}

impl Solved {
    fn new(found: &Equilibrium, asked: Resolution) -> Self {
        let asked = if let Resolution::Accuracy(a) = asked { a } else { f64::NAN };
        Self {
            stability: found.certificate.stability,
            gradient: found.certificate.gradient_norm,
            iterations: found.certificate.iterations,
            elements: found.elements,
            estimate: found.error_estimate.unwrap_or(f64::NAN) / asked,
        }
    }
}

fn solved(
    count: usize,
    monitor: &dyn Monitor,
    from: f64,
    hair: impl Fn(usize) -> Result<(RodSpec, Resolution), Stopped> + Sync,
) -> Result<Vec<Solved>, Stopped> {
    let one = |&i: &usize| {
        let (spec, resolution) = hair(i)?;
        let options = Options { resolution, max_elements: 4000, ..Options::default() };
        Ok(Solved::new(&equilibrium(&Rod::new(spec)?, &[], &options), resolution))
    };
    let mut all = Vec::new();
    for (part, items) in (0..count).collect::<Vec<_>>().chunks(count.div_ceil(20)).enumerate() {
        super::check(monitor, "robustness", from + 0.02 * part as f64)?;
        all.extend(items.par_iter().map(one).collect::<Result<Vec<_>, Stopped>>()?);
    }
    Ok(all)
}

fn told(finding: &mut Finding, realistic: &[Solved], absurd: &[Solved]) {
    let mut table = Table::new("What became of them", &["", "realistic", "absurd"]);
    let both = [realistic, absurd];
    let mut row = |name: &str, of: &dyn Fn(&[Solved]) -> String| {
        table.row([name.to_owned(), of(both[0]), of(both[1])]);
    };
    let count = |s: &[Solved], yes: &dyn Fn(&Solved) -> bool| s.iter().filter(|s| yes(s)).count();
    let sorted = |s: &[Solved], of: &dyn Fn(&Solved) -> f64| {
        let mut values: Vec<f64> = s.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let at = |values: &[f64], share: f64| values[((values.len() - 1) as f64 * share) as usize];
    row("hairs", &|s| s.len().to_string());
    row("stable", &|s| count(s, &|s| s.stability == Stability::Stable).to_string());
    row("saddles", &|s| count(s, &|s| s.stability == Stability::Saddle).to_string());
    row("not converged", &|s| count(s, &|s| s.stability == Stability::NotConverged).to_string());
    row("stable, with an estimated error above what was asked", &|s| {
        count(s, &|s| s.stability == Stability::Stable && !(s.estimate <= 1.0)).to_string()
    });
    for (name, share) in [("iterations: median", 0.5), ("99 of 100", 0.99), ("most", 1.0)] {
        row(name, &|s| format!("{:.0}", at(&sorted(s, &|s| s.iterations as f64), share)));
    }
    for (name, share) in [("elements: median", 0.5), ("99 of 100", 0.99)] {
        row(name, &|s| format!("{:.0}", at(&sorted(s, &|s| s.elements as f64), share)));
    }
    for (name, share) in [("relative gradient: median", 0.5), ("largest", 1.0)] {
        row(name, &|s| format!("{:.1e}", at(&sorted(s, &|s| s.gradient), share)));
    }
    finding.table(table);
    let mut plot = Plot::new(
        "Iterations, all divisions and steps of gravity together",
        "iterations",
        "share of hairs that need more",
        [Scale::Log, Scale::Log],
    );
    for (name, these) in [("realistic", realistic), ("absurd", absurd)] {
        let values = sorted(these, &|s| s.iterations as f64);
        let n = values.len() as f64;
        let shares = values.iter().enumerate().map(|(i, v)| (*v, 1.0 - i as f64 / n));
        plot.add(name, Mark::Line, shares);
    }
    finding.plot(plot);
    let share = |s: &[Solved]| {
        count(s, &|s| s.stability == Stability::Stable && s.estimate <= 1.0) as f64 / s.len() as f64
    };
    let stable =
        |s: &[Solved]| count(s, &|s| s.stability == Stability::Stable) as f64 / s.len() as f64;
    let most = sorted(realistic, &|s| s.iterations as f64);
    finding.judge(
        "share of realistic hairs that are stable and within the accuracy by their estimate",
        share(realistic),
        Limit::AtLeast(1.0),
    );
    finding.judge("iterations of 99 of 100 realistic hairs", at(&most, 0.99), Limit::AtMost(200.0));
    finding.judge("share of absurd hairs that are stable", stable(absurd), Limit::AtLeast(0.99));
}

/// Realistic hairs against the boundary-value problem.
fn compared(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let one = |i: usize| -> Result<Option<f64>, Stopped> {
        let spec = Random::new(71, i).realistic()?;
        let Ok(reference) = Hanging::new(&spec).solve() else { return Ok(None) };
        let options = Options { resolution: Resolution::Accuracy(1e-4), ..Options::default() };
        let found = equilibrium(&Rod::new(spec)?, &[], &options);
        Ok(Some(reference.distance(line(&found)) * found.rod.length()))
    };
    let gaps: Vec<Option<f64>> =
        (0..effort.pick(60, 1000)).into_par_iter().map(one).collect::<Result<_, Stopped>>()?;
    let known: Vec<f64> = gaps.iter().copied().flatten().collect();
    let other = known.iter().filter(|g| **g > 1e-3).count();
    let worst = known.iter().copied().filter(|g| *g <= 1e-3).fold(0.0, f64::max);
    finding.text(format!(
        "Of {} realistic hairs the boundary-value problem followed {}; in {other} of them frisure ends in another \
         stable equilibrium (more than a millimetre away). The others are within {:.4} mm, where 0.1 mm was asked for.",
        gaps.len(),
        known.len(),
        1e3 * worst
    ));
    finding.judge(
        "largest distance from the boundary-value problem's line (mm), same equilibrium, 0.1 mm asked for",
        1e3 * worst,
        Limit::AtMost(0.1),
    );
    finding.judge(
        "share of those followed that end in another equilibrium",
        other as f64 / known.len() as f64,
        Limit::AtMost(0.02),
    );
    finding.judge(
        "share that the boundary-value problem could follow",
        known.len() as f64 / gaps.len() as f64,
        Limit::AtLeast(0.5),
    );
    Ok(())
}

/// The same hairs in a batch, which goes straight to rest, and one by one along gravity's branch, with the same
/// elements.
fn side_by_side(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let count = effort.pick(300, 4000);
    let spec = |i| Random::new(75, i).realistic().and_then(Rod::new);
    let rods: Vec<Rod> = (0..count).map(spec).collect::<Result<_, _>>()?;
    let batch = Batch { elements: 60, ..Batch::default() };
    let batches = rods.par_chunks(200).map(|rods| (rods, batch.settle(rods)));
    let gaps = batches.flat_map_iter(|(rods, rest)| {
        let each = move |(k, rod): (usize, &Rod)| {
            let alone = equilibrium(rod, &[], &elements(60, ElementKind::Jointed));
            let tip = rest.shape(rod, k).positions[60];
            let stable = rest.hairs[k].stability == Stability::Stable;
            (stable, tip.distance(alone.shape.positions[60]) / rod.length())
        };
        rods.iter().enumerate().map(each).collect::<Vec<_>>()
    });
    let gaps: Vec<(bool, f64)> = gaps.collect();
    let stable = gaps.iter().filter(|g| g.0).count();
    let other = gaps.iter().filter(|g| g.1 > 1e-3).count();
    let worst = gaps.iter().map(|g| g.1).filter(|g| *g <= 1e-3).fold(0.0, f64::max);
    finding.text(format!(
        "Side by side, straight from the natural shape (60 jointed elements), {stable} of {count} realistic hairs come to \
         rest in a minimum; {other} in another one than by gravity's branch. The tips of the others are within \
         {worst:.0e} of the length."
    ));
    finding.judge(
        "share of hairs that a batch brings to rest in a minimum",
        stable as f64 / count as f64,
        Limit::AtLeast(1.0),
    );
    finding.judge(
        "share of hairs that a batch brings to rest elsewhere than gravity's branch",
        other as f64 / count as f64,
        Limit::AtMost(0.05),
    );
    Ok(())
}

/// How many minima a hair has, and whether gravity's branch ends in the lowest.
fn minima(spec: &RodSpec, starts: usize, seed: usize) -> Result<(usize, bool), Stopped> {
    let rod = Rod::new(spec.clone())?;
    let count = ElementKind::Jointed.resolving_elements(&rod).clamp(30, 120);
    let chain = Chain::uniform(&rod, ElementKind::Jointed, count);
    let problem = Problem::new(&chain, &[]);
    let stopping = Stopping { tolerance: 1e-9, max_iterations: 400 };
    let options = Options {
        resolution: Resolution::Elements(count),
        element: ElementKind::Jointed,
        estimate_error: false,
        eigenvalue: false,
        ..Options::default()
    };
    let branch = equilibrium(&rod, &[], &options);
    let mut found = vec![(branch.energy.total(), branch.shape.positions)];
    let mut random = Random::new(74, seed);
    for _ in 0..starts {
        let size = random.between(0.1, 1.2);
        let natural = chain.natural_shape().controls;
        let controls = natural.iter().map(|c| *c + random.cube() * size).collect();
        let minimum = Riccati::default().minimise(&problem, chain.shape(controls), stopping);
        if minimum.stability != Stability::Stable {
            continue;
        }
        let line = minimum.shape.positions.clone();
        let gap = |other: &[DVec3]| {
            let pairs = line.iter().zip(other);
            pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
        };
        if found.iter().all(|(_, other)| gap(other) > 0.01 * rod.length()) {
            found.push((problem.energy(&minimum.shape).total(), line));
        }
    }
    let lowest = found.iter().map(|f| f.0).fold(f64::INFINITY, f64::min);
    let scale = rod.weight() * rod.length().powi(2);
    Ok((found.len(), found[0].0 <= lowest + 1e-9 * scale))
}

fn counted(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
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
            let mut random = Random::new(73, i + 1_000_000 * k);
            let radius = random.decades(0.003, 0.02);
            let natural = match k {
                0 => NaturalStrain::STRAIGHT,
                1 => NaturalStrain::helix(radius, random.between(0.8, 3.0) * radius)?,
                _ => NaturalStrain::helix(radius, 0.0)?,
            };
            let length = random.between(0.05, 0.30);
            minima(&RodSpec { length, natural, ..random.realistic()? }, starts, i)
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
    finding.judge(
        "share of helices in which gravity's branch is the lowest minimum found",
        lowest[1],
        Limit::AtLeast(0.9),
    );
    Ok(())
}
