//! The rate of failures.

mod batches;
mod exact;
mod minima;

use frisure::rod::{Equilibrium, Options, Resolution, Rod, RodSpec, Stability, equilibrium};
use rayon::prelude::*;

use crate::experiment::check;
use crate::numbers::small;
use crate::plot::{Mark, Plot, Scale};
use crate::random;
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Table};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "robustness",
    title: "Robustness: realistic and absurd random hair",
    question: "How many random hairs converge, in how many iterations, with what certificate; and how many \
        equilibria does a curly hair have?",
    method: "Realistic hairs: 1 to 60 cm, 45 to 110 µm, axis ratio 1 to 2, E 1 to 5 GPa, straight, curled in a plane, or \
        helices of 1.5 to 60 mm, roots in any direction; solved to 0.1 mm. Absurd hairs: a millimetre to ten metres, axis \
        ratios up to 10, moduli of rubber to diamond, Γ from 0 to 30 000, natural turns up to forty; solved to a thousandth of the \
        length with at most 4000 elements. The certificate of each is its relative gradient and whether its second \
        variation is positive: numbers of frisure's own solver. An independent check covers some hairs of both \
        kinds, and hairs with two curls, whose strain changes linearly from one to the other or jumps, and fibres that hardly resist twist (G/E from 1e-4 to 3e-3, axis ratios up to 13, solved to a thousandth of the length). The boundary-value problem starts Newton's method at frisure's line, on equations \
        that do not depend on the start: the distance of its solution from the line is the error, and Morse's index of the \
        solution states whether it is a minimum. The boundary-value problem also solves the realistic hairs from the natural shape, \
        as the weight increases; it fails where it cannot follow a stable branch. G/E is random: E 1 to 5 GPa and G \
        0.4 to 1.4 GPa for realistic hair, 0.02 to 2 for absurd.\n\n\
        The number of equilibria is that of minima found from random shapes: every element of a division into 30 to 120 is \
        rotated at random about its natural rotation. Minima whose lines differ by more than a hundredth of the length count \
        as different.",
    run,
};

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    let realistic = solved(effort.pick(400, 10_000), progress, 0.0, |i| {
        let spec = random::realistic(&mut random::stream(71, i))?;
        Ok((spec, Resolution::Accuracy(1e-4)))
    })?;
    let absurd = solved(effort.pick(60, 1000), progress, 0.4, |i| {
        let spec = random::absurd(&mut random::stream(72, i))?;
        let accuracy = 1e-3 * spec.length;
        Ok((spec, Resolution::Accuracy(accuracy)))
    })?;
    add_results(&mut finding, &realistic, &absurd);
    exact::add(&mut finding, effort)?;
    check(progress, "robustness", 0.8)?;
    batches::add(&mut finding, effort)?;
    check(progress, "robustness", 0.85)?;
    minima::add(&mut finding, effort)?;
    Ok(finding)
}

/// Results of a hair that was solved.
struct Solved {
    stability: Stability,
    gradient: f64,
    iterations: usize,
    elements: usize,
    /// Estimate of the error over the requested accuracy.
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
    progress: &dyn Progress,
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
        check(progress, "robustness", from + 0.02 * part as f64)?;
        all.extend(items.par_iter().map(one).collect::<Result<Vec<_>, Stopped>>()?);
    }
    Ok(all)
}

fn add_results(finding: &mut Finding, realistic: &[Solved], absurd: &[Solved]) {
    let mut table = Table::new("Results", &["", "realistic", "absurd"]);
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
    row("stable, with an estimated error above the requested accuracy", &|s| {
        count(s, &|s| s.stability == Stability::Stable && !(s.estimate <= 1.0)).to_string()
    });
    for (name, share) in [("iterations: median", 0.5), ("99 of 100", 0.99), ("maximum", 1.0)] {
        row(name, &|s| format!("{:.0}", at(&sorted(s, &|s| s.iterations as f64), share)));
    }
    for (name, share) in [("elements: median", 0.5), ("99 of 100", 0.99)] {
        row(name, &|s| format!("{:.0}", at(&sorted(s, &|s| s.elements as f64), share)));
    }
    for (name, share) in [("relative gradient: median", 0.5), ("largest", 1.0)] {
        row(name, &|s| small(at(&sorted(s, &|s| s.gradient), share)));
    }
    finding.table(table);
    let mut plot = Plot::new(
        "Iterations, over all divisions and steps of gravity",
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
    finding.check(
        "share of realistic hairs that are stable and within the accuracy by their estimate",
        share(realistic),
        Limit::AtLeast(1.0),
    );
    // A branch that comes near a loss of stability is followed twice.
    finding.check("iterations of 99 of 100 realistic hairs", at(&most, 0.99), Limit::AtMost(400.0));
    finding.check("share of absurd hairs that are stable", stable(absurd), Limit::AtLeast(1.0));
}
