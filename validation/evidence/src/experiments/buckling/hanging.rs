//! A curl that hangs from a vertical clamp and leaves its plane.

use glam::DVec3;
use rayon::prelude::*;

use crate::experiments::plane::{first, frisure_threshold, hook_leaves, reference_leaves};
use crate::extremes::largest;
use crate::numbers::small;
use crate::rods::{Bar, HAIR_SHEAR, INCOMPRESSIBLE};
use crate::{Effort, Finding, Limit, Stopped, Table};

/// G/E, and a weight or a curvature.
type Case = (f64, f64);

/// Weights and curvatures of rods of an incompressible material.
const GAMMAS: [f64; 5] = [50.0, 100.0, 300.0, 1000.0, 3000.0];
const KAPPAS: [f64; 6] = [7.0, 8.0, 12.0, 16.0, 30.0, 50.0];

fn cases(incompressible: &[f64], hair: &[f64]) -> Vec<Case> {
    let with = |shear: f64, all: &[f64]| all.iter().map(|&x| (shear, x)).collect::<Vec<_>>();
    [with(INCOMPRESSIBLE, incompressible), with(HAIR_SHEAR, hair)].concat()
}

pub(super) fn add(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let gammas =
        cases(effort.pick(&[60.0, 300.0], &GAMMAS), effort.pick(&[300.0], &[100.0, 300.0, 3000.0]));
    let hooks = gammas.par_iter().map(|&case| hook(case)).collect::<Result<Vec<_>, _>>()?;
    let kappas = cases(effort.pick(&[8.0, 16.0], &KAPPAS), effort.pick(&[], &[8.0, 16.0, 50.0]));
    let coils = kappas.par_iter().map(|&case| coil(case)).collect::<Result<Vec<_>, _>>()?;
    add_table(finding, &ThresholdTable { cases: &gammas, found: &hooks, ..HOOKS });
    add_table(finding, &ThresholdTable { cases: &kappas, found: &coils, ..COILS });
    finding.check(
        "largest relative difference of the two thresholds from the boundary-value problem's",
        largest(hooks.iter().chain(&coils).map(|[r, f]| (f / r - 1.0).abs())),
        Limit::AtMost(1e-4),
    );
    finding.text(
        "Between the two thresholds the hair is out of its plane. In the first table κ(EI/ρSg)^⅓ tends to a \
         constant for each GJ/EI: only the lowest part of a heavy hair determines the threshold, and its length has no \
         effect.",
    );
    Ok(())
}

/// A table of thresholds.
struct ThresholdTable<'a> {
    title: &'a str,
    at: &'a str,
    scaled: &'a str,
    scale: fn(f64, f64) -> f64,
    cases: &'a [Case],
    found: &'a [[f64; 2]],
}

const HOOKS: ThresholdTable<'static> = ThresholdTable {
    title: "Natural curvature κL beyond which the hook at the end of a hanging hair leaves its plane",
    at: "Γ = ρSgL³/EI",
    scaled: "κ(EI/ρSg)^⅓",
    scale: |gamma, kappa| kappa / gamma.cbrt(),
    cases: &[],
    found: &[],
};

const COILS: ThresholdTable<'static> = ThresholdTable {
    title: "Weight Γ = ρSgL³/EI beyond which a hanging planar curl leaves its plane",
    at: "κL",
    scaled: "Γ/(κL)²",
    scale: |kappa, gamma| gamma / kappa.powi(2),
    cases: &[],
    found: &[],
};

fn add_table(finding: &mut Finding, thresholds: &ThresholdTable<'_>) {
    let head =
        [thresholds.at, "GJ/EI", "reference", "frisure", "relative difference", thresholds.scaled];
    let mut table = Table::new(thresholds.title, &head);
    for (&(shear, at), &[reference, frisure]) in thresholds.cases.iter().zip(thresholds.found) {
        table.row([
            format!("{at}"),
            // J = 2I for a round section.
            format!("{:.3}", 2.0 * shear),
            format!("{reference:.6}"),
            format!("{frisure:.6}"),
            small(frisure / reference - 1.0),
            format!("{:.4}", (thresholds.scale)(at, reference)),
        ]);
    }
    finding.table(table);
}

/// The reference's and frisure's threshold of curvature at a weight.
fn hook((shear, gamma): Case) -> Result<[f64; 2], Stopped> {
    let bar = |kappa: f64| Bar { shear, ..hanging_curl(gamma, kappa) };
    let found = first(2.0, 1.1, (60.0, 27), |kappa| hook_leaves(&bar(kappa)))?;
    let reference =
        found.ok_or_else(|| Stopped::Other(format!("no hook of Γ = {gamma} leaves its plane")))?;
    Ok([reference, frisure_threshold(reference, DVec3::Y, 120, bar)?])
}

/// The reference's and frisure's threshold of weight at a curvature.
fn coil((shear, kappa): Case) -> Result<[f64; 2], Stopped> {
    let bar = |gamma: f64| Bar { shear, ..hanging_curl(gamma, kappa) };
    let found = first(1.0, 1.15, (3000.0, 27), |gamma| reference_leaves(&bar(gamma)))?;
    let reference =
        found.ok_or_else(|| Stopped::Other(format!("no curl of κL = {kappa} leaves its plane")))?;
    let count = (8.0 * kappa).max(160.0) as usize;
    Ok([reference, frisure_threshold(reference, DVec3::Y, count, bar)?])
}

/// A round hair that hangs from a vertical clamp, its natural shape a circle of κL in the plane y = 0; G/E = 1/3.
pub(in crate::experiments) fn hanging_curl(gamma: f64, kappa: f64) -> Bar {
    let natural = DVec3::new(kappa, 0.0, 0.0);
    Bar { gamma, natural, tangent: DVec3::NEG_Z, d1: DVec3::Y, ..Bar::STRAIGHT }
}
