//! Times beside those of the paper.

use std::time::Instant;

use frisure::hairstyle::{PredictOptions, predict, preset, settling_report};
use frisure::rod::batch::Batch;
use frisure::rod::{ElementKind, Rod, RodSpec, Stability, equilibrium};
use rayon::prelude::*;

use crate::experiment::check;
use crate::random;
use crate::reference::Hanging;
use crate::rods::{elements, line, to_accuracy};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Timing};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "speed",
    title: "Speed, beside the paper's of 2005",
    question: "How long do ten hairs, a hundred hairs, and a head of a hundred guides take?",
    method: "Random realistic hairs of 15 cm, each divided into the paper's 15 helix elements, from their natural \
        shapes; the same to 0.1 mm; one thread, the best of three runs. A head of 100 curly guides with all its contacts, \
        on all threads. The paper has ten hairs in real time, a hundred in a few seconds, and 6 s for the equilibrium of a \
        head of about a hundred guides, on a machine that it does not name. The last section of this report has the \
        times; this section checks only that the timed results are correct.",
    run,
};

fn hairs(count: usize) -> Result<Vec<Rod>, Stopped> {
    let one = |i| {
        Ok(Rod::new(RodSpec { length: 0.15, ..random::realistic(&mut random::stream(91, i))? })?)
    };
    (0..count).map(one).collect()
}

/// The shortest of three times (s), and the number of stable hairs.
fn timed(rods: &[Rod], solve: impl Fn(&Rod) -> Stability) -> (f64, usize) {
    let mut best = f64::INFINITY;
    let mut stable = 0;
    for _ in 0..3 {
        let start = Instant::now();
        stable = rods.iter().filter(|rod| solve(rod) == Stability::Stable).count();
        best = best.min(start.elapsed().as_secs_f64());
    }
    (best, stable)
}

/// The shortest of three times (s) of a batch, and the number of stable hairs.
fn batched(rods: &[Rod]) -> (f64, usize) {
    let mut best = f64::INFINITY;
    let mut stable = 0;
    for _ in 0..3 {
        let start = Instant::now();
        let found = Batch::default().solve(rods);
        best = best.min(start.elapsed().as_secs_f64());
        stable = found.rods.iter().filter(|h| h.stability == Stability::Stable).count();
    }
    (best, stable)
}

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    progress.report("speed", 0.0);
    let mut right = (0, 0);
    for (count, beside) in [(10, "the paper: in real time"), (100, "the paper: a few seconds")] {
        let rods = hairs(count)?;
        let fixed = |rod: &Rod| {
            equilibrium(rod, &[], &elements(15, ElementKind::Helix)).certificate.stability
        };
        let exact =
            |rod: &Rod| equilibrium(rod, &[], &to_accuracy(rod, 1e-4 / 0.15)).certificate.stability;
        let what = format!("{count} hairs, 15 helix elements");
        let (seconds, stable) = timed(&rods, fixed);
        finding.timings.push(Timing { what, seconds, beside: beside.into() });
        right = (right.0 + stable, right.1 + count);
        let what = format!("{count} hairs to 0.1 mm, with certificates");
        let (seconds, stable) = timed(&rods, exact);
        finding.timings.push(Timing { what, seconds, beside: "nothing in the paper".into() });
        right = (right.0 + stable, right.1 + count);
        let what = format!("{count} hairs, 15 jointed elements, as a batch");
        let (seconds, stable) = batched(&rods);
        finding.timings.push(Timing { what, seconds, beside: beside.into() });
        right = (right.0 + stable, right.1 + count);
    }
    check(progress, "speed", 0.3)?;
    errors(&mut finding)?;
    check(progress, "speed", 0.5)?;
    head(&mut finding, effort, progress)?;
    finding.check(
        "share of the timed hairs that are stable",
        right.0 as f64 / right.1 as f64,
        Limit::AtLeast(1.0),
    );
    Ok(finding)
}

/// Errors of the paper's fifteen elements on such hair.
fn errors(finding: &mut Finding) -> Result<(), Stopped> {
    let one = |rod: &Rod| -> Option<[f64; 2]> {
        let reference = Hanging::new(rod.spec()).solve().ok()?;
        let options = [elements(15, ElementKind::Helix), to_accuracy(rod, 1e-4 / 0.15)];
        Some(options.map(|o| 150.0 * reference.distance(line(&equilibrium(rod, &[], &o)))))
    };
    let found: Vec<[f64; 2]> = hairs(100)?.par_iter().filter_map(one).collect();
    let at = |k: usize, share: f64| {
        let mut errors: Vec<f64> = found.iter().map(|e| e[k]).collect();
        errors.sort_by(f64::total_cmp);
        errors[((errors.len() - 1) as f64 * share) as usize]
    };
    finding.text(format!(
        "For the hundred hairs, against the boundary-value problem (which followed {}), the error of fifteen helix elements is \
         {:.2} mm in the median and {:.1} mm in one of ten; with 0.1 mm requested, the largest error is {:.4} mm.",
        found.len(),
        at(0, 0.5),
        at(0, 0.9),
        at(1, 1.0)
    ));
    finding.check(
        "largest error of the timed hairs, 0.1 mm requested (mm)",
        at(1, 1.0),
        Limit::AtMost(0.1),
    );
    Ok(())
}

fn head(finding: &mut Finding, effort: Effort, progress: &dyn Progress) -> Result<(), Stopped> {
    let head = super::heads::mannequin();
    let preset = preset("caucasian-curly").ok_or_else(|| Stopped::Other("no curly hair".into()))?;
    let mut spec = preset.spec();
    spec.wisps.count = effort.pick(40, 100);
    spec.length.mean = 0.28;
    let start = Instant::now();
    let hairstyle = predict(&spec, head, PredictOptions::default(), progress)?;
    let seconds = start.elapsed().as_secs_f64();
    let report = settling_report(&hairstyle, head);
    let what = format!("a head of {} curly guides, all contacts", report.guides);
    finding.timings.push(Timing {
        what,
        seconds,
        beside: "the paper: 6 s, about a hundred guides".into(),
    });
    finding.check(
        "share of the timed head's guides in a minimum",
        report.stable as f64 / report.guides as f64,
        Limit::AtLeast(1.0),
    );
    Ok(())
}
