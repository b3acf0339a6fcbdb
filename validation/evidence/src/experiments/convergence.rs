//! Convergence of errors with the number of elements.

use frisure::rod::{
    ElementKind, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, Stability,
    TorsionConstant, equilibrium,
};
use glam::DVec3;
use rayon::prelude::*;

use crate::experiment::check;
use crate::extremes::{larger, largest, smallest};
use crate::plot::{Mark, Plot, Scale};
use crate::reference::{Hanging, Solution};
use crate::rods::{elements, line, to_accuracy};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Table};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "convergence",
    title: "Convergence: how many elements a hair needs",
    question: "How does the error fall with the number of elements, for straight, curly and elliptical hair; \
        how many elements does each curl need; and is the error within a requested accuracy?",
    method: "The error is the largest distance of any point of the centre line from the solution of the \
        boundary-value problem, over the length. Its slope against the number of elements N is fitted in \
        logarithms from N = 80 on (from eight elements per turn on, for curls). Both kinds of element are of \
        second order by construction. Lines are compared at 97 points and more. The hair has 75 µm, E = 3.9 GPa, \
        G = 0.9 GPa (GJ/EI from 0.46 of round hair to 0.70 of a/b = 1.75), and leaves its root horizontally; a curl's \
        pitch is twice its radius. There is one orientation, one pitch, one length (15 cm) and one material: other hair needs \
        other numbers. N is tried in steps of 2^¼, so a number in the table may be a fifth too large.",
    run,
};

/// A hair of the experiment.
struct Case {
    name: String,
    spec: RodSpec,
    turns: f64,
}

/// 15 cm of hair; a curl's pitch is twice its radius.
fn hair(name: &str, turns: f64, ratio: f64) -> Result<Case, Stopped> {
    let length: f64 = 0.15;
    let natural = if turns == 0.0 {
        NaturalStrain::STRAIGHT
    } else {
        let turn = length / turns;
        let radius = turn / (std::f64::consts::TAU.powi(2) + 4.0).sqrt();
        NaturalStrain::helix(radius, 2.0 * radius)?
    };
    let spec = RodSpec {
        length,
        section: Section::from_diameter(75e-6, ratio)?,
        material: Material::new(3.9e9, 0.9e9, 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural,
        root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::new(0.1, 1.0, 0.3))?,
        load: Load::down(9.81),
    };
    Ok(Case { name: name.to_owned(), spec, turns })
}

const KINDS: [(ElementKind, &str); 2] =
    [(ElementKind::Helix, "helices"), (ElementKind::Jointed, "jointed")];

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    slopes(&mut finding, effort)?;
    check(progress, "convergence", 0.4)?;
    needed(&mut finding, effort)?;
    check(progress, "convergence", 0.8)?;
    requests(&mut finding, effort)?;
    Ok(finding)
}

/// Error with `count` elements, over the length; NaN if no stable equilibrium is found.
fn error(rod: &Rod, exact: &Solution, kind: ElementKind, count: usize) -> f64 {
    let found = equilibrium(rod, &[], &elements(count, kind));
    match found.certificate.stability {
        Stability::Stable => exact.distance(line(&found)),
        _ => f64::NAN,
    }
}

/// Numbers of elements in steps of 2^¼.
fn counts(to: f64) -> Vec<usize> {
    let count = (4.0 * (to / 5.0).log2()).round() as i32;
    let mut counts: Vec<usize> =
        (0..=count).map(|i| (5.0 * 2_f64.powf(0.25 * f64::from(i))).round() as usize).collect();
    counts.dedup();
    counts
}

fn slopes(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let cases = [
        hair("straight hair", 0.0, 1.0)?,
        hair("a wave of one turn", 1.0, 1.4)?,
        hair("a curl of 4 turns, round", 4.0, 1.0)?,
        hair("a curl of 4 turns, a/b = 1.75", 4.0, 1.75)?,
        hair("a coil of 10 turns, a/b = 1.75", 10.0, 1.75)?,
    ];
    let counts: Vec<usize> = counts(effort.pick(320.0, 1280.0));
    let mut table = Table::new(
        "Slope of the error against N",
        &["hair", "Γ", "helices", "jointed", "ratio of errors"],
    );
    let mut slopes = Vec::new();
    for case in &cases {
        let rod = Rod::new(case.spec.clone())?;
        let exact = Hanging::new(&case.spec).solve()?;
        let mut plot = Plot::new(
            &format!("Error of {}", case.name),
            "number of elements",
            "error over the length",
            [Scale::Log, Scale::Log],
        );
        plot.size = [520.0, 320.0];
        let mut cells = vec![case.name.clone(), format!("{:.0}", rod.heaviness())];
        let mut ends = Vec::new();
        for (kind, name) in KINDS {
            let errors: Vec<(f64, f64)> =
                counts.par_iter().map(|&n| (n as f64, error(&rod, &exact, kind, n))).collect();
            let from = (8.0 * case.turns).max(80.0);
            let fitted = slope(errors.iter().filter(|e| e.0 >= from));
            slopes.push(fitted);
            cells.push(format!("{fitted:.3}"));
            ends.push(errors[errors.len() - 1].1);
            plot.add(name, Mark::Both, errors);
        }
        let [a, b] = [counts[0] as f64, counts[counts.len() - 1] as f64];
        let last = 1.6 * ends[0].max(ends[1]);
        plot.add("slope −2", Mark::Dashed, [(a, last * (b / a).powi(2)), (b, last)]).colour =
            Some(6);
        cells.push(format!("{:.2}", ends[0] / ends[1]));
        table.row(cells);
        finding.plot(plot);
    }
    finding.table(table);
    finding.check(
        "smallest order of convergence",
        smallest(slopes.iter().copied()),
        Limit::AtLeast(1.9),
    );
    finding.check("largest order of convergence", largest(slopes), Limit::AtMost(2.2));
    Ok(())
}

/// Minus the slope of a straight line through logarithms.
fn slope<'a>(points: impl Iterator<Item = &'a (f64, f64)>) -> f64 {
    let logs: Vec<(f64, f64)> = points.map(|p| (p.0.ln(), p.1.ln())).collect();
    let n = logs.len() as f64;
    let mean = logs.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let covariance: f64 = logs.iter().map(|p| (p.0 - mean.0) * (p.1 - mean.1)).sum();
    let variance: f64 = logs.iter().map(|p| (p.0 - mean.0).powi(2)).sum();
    -covariance / variance
}

/// The table of N by curl.
fn needed(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let turns: &[f64] =
        effort.pick(&[0.0, 1.0, 4.0], &[0.0, 0.5, 1.0, 1.5, 2.0, 4.0, 8.0, 12.0, 16.0]);
    let counts = counts(effort.pick(320.0, 1280.0));
    let limits = [1e-2, 1e-3];
    let mut table = Table::new(
        "Elements that keep every point of 15 cm of hair (a/b = 1.5) within 1 % and 0.1 % of the length",
        &[
            "turns",
            "curl radius",
            "helices, 1 %",
            "jointed, 1 %",
            "helices, 0.1 %",
            "jointed, 0.1 %",
        ],
    );
    let mut most = 0.0_f64;
    for &turns in turns {
        let case = hair("", turns, 1.5)?;
        let rod = Rod::new(case.spec.clone())?;
        let exact = Hanging::new(&case.spec).solve()?;
        let errors = KINDS.map(|(kind, _)| {
            counts.par_iter().map(|&n| error(&rod, &exact, kind, n)).collect::<Vec<f64>>()
        });
        let natural = rod.natural().at(0.0);
        let radius = natural.x / natural.length_squared();
        let radius =
            if turns == 0.0 { "straight".into() } else { format!("{:.1} mm", 1e3 * radius) };
        let mut cells = vec![format!("{turns}"), radius];
        for limit in limits {
            for errors in &errors {
                // For this and all larger counts.
                let bad = errors.iter().rposition(|e| !(*e <= limit));
                let first = bad.map_or(0, |i| i + 1);
                cells.push(counts.get(first).map_or_else(|| "more".into(), usize::to_string));
            }
            let least = |k: usize| {
                let bad = errors[k].iter().rposition(|e| !(*e <= limit));
                counts.get(bad.map_or(0, |i| i + 1)).map_or(f64::NAN, |&n| n as f64)
            };
            if limit == 1e-2 && turns >= 4.0 {
                most = larger(most, least(1) / turns);
            }
        }
        table.row(cells);
    }
    finding.table(table);
    finding.check(
        "jointed elements per turn for a curl of 4 turns and more within 1 % of the length (maximum)",
        most,
        Limit::AtMost(8.0),
    );
    Ok(())
}

/// Checks that the error of the whole line is within a requested accuracy.
fn requests(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let mut worst = 0.0_f64;
    let mut table = Table::new(
        "Largest error of the whole line over the length, with its estimate and its elements",
        &["hair", "1e-3 requested", "1e-4", "1e-5", "1e-6"],
    );
    let turns: &[f64] = effort.pick(&[0.0, 4.0], &[0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0]);
    for &turns in turns {
        let case = hair("", turns, 1.5)?;
        let rod = Rod::new(case.spec.clone())?;
        let exact = Hanging::new(&case.spec).solve()?;
        let mut cells = vec![format!("{turns} turns")];
        for request in [1e-3, 1e-4, 1e-5, 1e-6] {
            let found = equilibrium(&rod, &[], &to_accuracy(&rod, request));
            let error = exact.distance(line(&found));
            let estimate = found.error_estimate.unwrap_or(f64::NAN) / rod.length();
            worst = larger(worst, error / request);
            cells.push(format!("{error:.0e} ({estimate:.0e}; {})", found.elements));
        }
        table.row(cells);
    }
    finding.table(table);
    finding.check("largest error over the requested accuracy", worst, Limit::AtMost(1.0));
    Ok(())
}
