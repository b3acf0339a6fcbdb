//! `frisure hair`: one hair, its energies and its stability certificate.

use std::fmt::Write;
use std::ops::RangeInclusive;

use frisure::rod::{AccuracyStatus, Equilibrium, Resolution, Stability, equilibrium};
use frisure_engine::report::EnergyReport;
use frisure_engine::{Error, memory};
use serde::Serialize;

use super::read_scene;
use crate::args::Hair;
use crate::console;
use crate::diagnostics::ExitStatus;

/// Mean diameters (m) beyond which a unit was probably mistaken. Chosen: rods of a hundred times the size of a hair are computed to compare.
const DIAMETERS: RangeInclusive<f64> = 1e-6..=5e-3;

/// The JSON report; SI units.
#[derive(Debug, Serialize)]
struct Report {
    /// Length (m).
    length: f64,
    /// Number of elements.
    elements: usize,
    /// Tip relative to the root (m).
    tip: [f64; 3],
    energy: EnergyReport,
    /// Relative gradient of the energy.
    gradient_norm: f64,
    /// Smallest eigenvalue of the second variation relative to the elastic one.
    min_eigenvalue: Option<f64>,
    /// Its error, estimated.
    eigenvalue_error: Option<f64>,
    /// Whether it is a minimum.
    stable: bool,
    /// `stable`, `unstable`, `undecided` or `not converged`.
    stability: &'static str,
    iterations: usize,
    /// Largest distance of the centre line from the exact one (m), estimated.
    error_estimate: Option<f64>,
    /// The requested accuracy (m); none where a number of elements was given.
    requested_accuracy: Option<f64>,
    /// Whether it is met.
    accuracy_met: Option<bool>,
    /// The centre line relative to the root (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<Vec<[f64; 3]>>,
}

/// Computes and prints the hair of a scene.
pub(crate) fn run(arguments: &Hair) -> Result<ExitStatus, Error> {
    let scene = read_scene(&arguments.scene)?;
    let hair = scene.single_hair()?;
    memory::check_points(arguments.points.unwrap_or(0) as f64, memory::PRINTED_POINT)?;
    let rest = equilibrium(&hair.rod, &[], &hair.options);
    let requested = match hair.options.resolution {
        Resolution::Accuracy(accuracy) => Some(accuracy),
        Resolution::Elements(_) => None,
    };
    let report = report(&rest, requested, arguments.points);
    let text = match arguments.json {
        true => console::json(&report)?,
        false => table(&report, rest.certificate.stability),
    };
    console::print(&text)?;
    let diameter = 2.0 * hair.rod.spec().section.mean_radius();
    if !DIAMETERS.contains(&diameter) {
        console::note(&format!(
            "a mean diameter of {diameter:.3e} m is not that of a hair; hair of the scalp has 40 to 120 um"
        ));
    }
    if !scene.steps().is_empty() || !scene.regions().is_empty() {
        console::note("steps and regions of the scene are for a head: the hair is as it grows");
    }
    let given = matches!(hair.options.resolution, Resolution::Elements(_));
    if given && rest.certificate.stability == Stability::Undecided {
        console::note(
            "so many elements do not tell whether it is stable; write more of them, or `accuracy` in `[equilibrium]` instead",
        );
    }
    Ok(match (rest.certificate.stability, rest.certificate.accuracy) {
        // On a saddle a hair is not at rest.
        (Stability::NotConverged | Stability::Saddle, _) => ExitStatus::NotConverged,
        (Stability::Undecided, _) | (_, AccuracyStatus::Missed) => ExitStatus::Uncertain,
        (_, AccuracyStatus::Met | AccuracyStatus::NotRequested) => ExitStatus::Success,
    })
}

fn report(rest: &Equilibrium, requested: Option<f64>, points: Option<usize>) -> Report {
    let certificate = &rest.certificate;
    let line = |n| rest.centre_line(n).into_iter().map(Into::into).collect();
    Report {
        length: rest.rod.length(),
        elements: rest.elements,
        tip: rest.tip().to_array(),
        energy: EnergyReport::from(rest.energy),
        gradient_norm: certificate.gradient_norm,
        min_eigenvalue: certificate.min_eigenvalue,
        eigenvalue_error: certificate.eigenvalue_error,
        stable: certificate.stability == Stability::Stable,
        stability: match certificate.stability {
            Stability::Stable => "stable",
            Stability::Saddle => "unstable",
            Stability::Undecided => "undecided",
            Stability::NotConverged => "not converged",
        },
        iterations: certificate.iterations,
        error_estimate: rest.error_estimate,
        requested_accuracy: requested,
        accuracy_met: requested.map(|_| certificate.accuracy == AccuracyStatus::Met),
        points: points.map(line),
    }
}

/// The smallest eigenvalue, with digits as its error has them.
fn eigenvalue(report: &Report) -> String {
    match (report.min_eigenvalue, report.eigenvalue_error) {
        (Some(least), Some(error)) if least.abs() < 1e-3 => {
            format!("{least:.1e}, within {error:.0e} (1 without load)")
        }
        (Some(least), _) => format!("{least:.4} (1 without load)"),
        (None, _) => "not known".into(),
    }
}

/// The report for people.
fn table(report: &Report, stability: Stability) -> String {
    let mut out = String::new();
    let mut row = |name: &str, value: String| {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{name:<16} {value}");
    };
    let optional = |x: Option<f64>, show: fn(f64) -> String| x.map_or("not known".into(), show);
    let [x, y, z] = report.tip.map(|c| 100.0 * c);
    let energy = &report.energy;
    row("length", format!("{:.2} cm", 100.0 * report.length));
    row("elements", report.elements.to_string());
    row("tip", format!("{x:.3}, {y:.3}, {z:.3} cm from the root"));
    row("elastic energy", format!("{:.6e} J", energy.elastic));
    row("weight", format!("{:.6e} J", energy.gravity));
    if energy.contact != 0.0 {
        row("contact", format!("{:.6e} J", energy.contact));
    }
    row("total energy", format!("{:.6e} J", energy.total));
    let verdict = match stability {
        Stability::Stable => "stable equilibrium",
        Stability::Saddle => "unstable equilibrium",
        Stability::Undecided => "equilibrium, UNDECIDED whether stable,",
        Stability::NotConverged => "NOT CONVERGED",
    };
    row("result", format!("{verdict} after {} iterations", report.iterations));
    row("gradient", format!("{:.1e} of the moments at work", report.gradient_norm));
    row("eigenvalue", eigenvalue(report));
    row("accuracy", optional(report.error_estimate, |x| format!("{:.1e} mm", 1e3 * x)));
    if let (Some(requested), Some(met)) = (report.requested_accuracy, report.accuracy_met) {
        let verdict = if met { "met" } else { "MISSED" };
        row("requested", format!("{:.1e} mm: {verdict}", 1e3 * requested));
    }
    for [x, y, z] in report.points.iter().flatten().map(|p| p.map(|c| 100.0 * c)) {
        let _ = writeln!(out, "{x:>12.5} {y:>12.5} {z:>12.5} cm");
    }
    out
}
