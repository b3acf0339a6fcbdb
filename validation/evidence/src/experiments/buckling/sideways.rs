//! A flat hair that is loaded edgewise and buckles sideways.

use glam::DVec3;
use rayon::prelude::*;

use crate::experiments::plane::{first, frisure_leaves, frisure_threshold, reference_leaves};
use crate::extremes::largest;
use crate::numbers::small;
use crate::reference::prandtl_michell;
use crate::rods::{Bar, HAIR_SHEAR, INCOMPRESSIBLE};
use crate::{Effort, Finding, Limit, Stopped, Table};

/// Largest Γ of the search.
const HEAVIEST: f64 = 2000.0;

/// Ratio of successive loads of the search.
const STEP: f64 = 1.15;

/// A hair that is loaded edgewise.
#[derive(Clone, Copy)]
struct Edge {
    /// Axis ratio.
    ratio: f64,
    /// G/E.
    shear: f64,
}

/// Loads at which a hair buckles sideways.
#[derive(Clone, Copy)]
struct Loads {
    /// In units of √(EI·GJ)/L³.
    reference: f64,
    frisure: f64,
    /// The reference's in units of EI/L³.
    gamma: f64,
}

/// The cases; the flattest with G/E = 1/3 last.
fn edges(effort: Effort) -> Vec<Edge> {
    let with = |shear: f64, ratios: &[f64]| {
        ratios.iter().map(|&ratio| Edge { ratio, shear }).collect::<Vec<_>>()
    };
    let hair = with(HAIR_SHEAR, effort.pick(&[1.5], &[1.25, 1.5, 1.75, 2.0, 3.0, 10.0]));
    let all: &[f64] =
        effort.pick(&[2.0, 5.0, 100.0], &[1.5, 1.75, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0]);
    [hair, with(INCOMPRESSIBLE, all)].concat()
}

pub(super) fn add(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let edges = edges(effort);
    let loads = edges.par_iter().map(Edge::turns_over).collect::<Result<Vec<_>, _>>()?;
    let mut table = Table::new(
        "Load qL³/√(EI·GJ) at which a hair of axis ratio a/b, loaded edgewise, buckles sideways",
        &["a/b", "G/E", "GJ/EI", "reference", "frisure", "relative difference", "Γ = qL³/EI"],
    );
    for (edge, loads) in edges.iter().zip(&loads) {
        table.row(edge.row(*loads)?);
    }
    let limit = prandtl_michell();
    let (flat, none) = ("∞ (Prandtl, Michell)".to_owned(), String::new);
    table.row([flat, none(), none(), format!("{limit:.6}"), none(), none(), none()]);
    finding.table(table);
    finding.text(format!(
        "\"None\" means that neither code found a load from Γ = 2 to {HEAVIEST} in steps of 15 %. Whether a hair of an axis ratio \
         buckles depends on GJ/EI: the smaller its stiffness in twist, the rounder the hair that still buckles.",
    ));
    finding.check(
        "largest relative difference of the sideways load from the boundary-value problem's, both shear moduli",
        largest(loads.iter().flatten().map(|l| (l.frisure / l.reference - 1.0).abs())),
        Limit::AtMost(1e-4),
    );
    let flat = loads.last().copied().flatten().map_or(f64::NAN, |l| l.frisure / limit - 1.0);
    finding.check(
        "relative difference of it at a/b = 100 from Prandtl and Michell",
        flat.abs(),
        Limit::AtMost(1e-3),
    );
    Ok(())
}

impl Edge {
    fn bar(self, gamma: f64) -> Bar {
        Bar { gamma, ratio: self.ratio, shear: self.shear, d1: DVec3::Z, ..Bar::STRAIGHT }
    }

    /// GJ/EI.
    fn twist(self) -> Result<f64, Stopped> {
        let stiffness = self.bar(1.0).rod()?.stiffness();
        Ok(stiffness.z / stiffness.x)
    }

    /// `None` if it never buckles.
    fn turns_over(&self) -> Result<Option<Loads>, Stopped> {
        let unit = self.twist()?.sqrt();
        let leaves = |gamma: f64| reference_leaves(&self.bar(gamma));
        let Some(gamma) = first(2.0, STEP, (HEAVIEST, 27), leaves)? else {
            // frisure must not buckle either: a load of frisure alone is a disagreement.
            let steps = (HEAVIEST / 2.0).log(STEP) as i32;
            for gamma in (0..=steps).map(|k| 2.0 * STEP.powi(k)) {
                if frisure_leaves(&self.bar(gamma), DVec3::Y, 60)? {
                    let (reference, frisure) = (f64::INFINITY, gamma / unit);
                    return Ok(Some(Loads { reference, frisure, gamma: reference }));
                }
            }
            return Ok(None);
        };
        // A hair that has nearly bent down before it buckles needs more elements.
        let count = if gamma < 40.0 { 60 } else { 400 };
        let frisure = frisure_threshold(gamma, DVec3::Y, count, |gamma| self.bar(gamma))?;
        Ok(Some(Loads { reference: gamma / unit, frisure: frisure / unit, gamma }))
    }

    fn row(self, loads: Option<Loads>) -> Result<[String; 7], Stopped> {
        let [ratio, shear] = [format!("{}", self.ratio), format!("{:.3}", self.shear)];
        let twist = format!("{:.3}", self.twist()?);
        let none = || format!("none up to Γ = {HEAVIEST}");
        let rest = loads.map_or_else(
            || [none(), none(), String::new(), String::new()],
            |l| {
                let [a, b] = [l.reference, l.frisure].map(|x| format!("{x:.6}"));
                [a, b, small(l.frisure / l.reference - 1.0), format!("{:.3}", l.gamma)]
            },
        );
        let [a, b, c, d] = rest;
        Ok([ratio, shear, twist, a, b, c, d])
    }
}
