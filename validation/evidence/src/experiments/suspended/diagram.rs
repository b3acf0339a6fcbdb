//! The diagram of shapes.

use rayon::prelude::*;

use super::hung::{B, Hung, Phase};
use crate::experiment::check;
use crate::experiments::buckling::hanging_curl;
use crate::experiments::plane::{first, hook_leaves, reference_leaves};
use crate::numbers::number;
use crate::plot::{Mark, Plot, Scale};
use crate::{Effort, Finding, Limit, Progress, Stopped};

/// The shape of each hair.
pub(super) fn add(
    finding: &mut Finding,
    effort: Effort,
    progress: &dyn Progress,
) -> Result<(), Stopped> {
    let (columns, rows) = effort.pick((8, 8), (25, 25));
    let (heaviest, tightest) = effort.pick((1000.0, 40.0), (3000.0, 60.0));
    let at = |i: usize, n: usize, low: f64, high: f64| {
        low * (high / low).powf(i as f64 / (n - 1) as f64)
    };
    let mut hairs = Vec::new();
    for i in 0..columns {
        check(progress, "suspended", 0.2 + 0.6 * i as f64 / columns as f64)?;
        let gamma = at(i, columns, 3.0, heaviest);
        let column =
            (0..rows).into_par_iter().map(|j| Hung::new(gamma, at(j, rows, 2.5, tightest)));
        hairs.extend(column.collect::<Result<Vec<_>, _>>()?);
    }
    let borders = borders(effort)?;
    let mut plot = Plot::new(
        "Shapes of a suspended curly hair",
        "Γ = ρSgL³/EI",
        "natural curvature κL",
        [Scale::Log, Scale::Log],
    );
    plot.size = [640.0, 480.0];
    for (i, (phase, name)) in [
        (Phase::Planar, "planar"),
        (Phase::Local, "helix near the tip"),
        (Phase::Global, "helix all along"),
    ]
    .into_iter()
    .enumerate()
    {
        let these = hairs.iter().filter(|h| h.phase() == phase).map(|h| (h.gamma, h.kappa));
        plot.add(name, Mark::Points, these).colour = Some(i);
    }
    let [coils, hooks] = &borders;
    plot.add("out of the plane (boundary-value problem)", Mark::Line, coils.clone()).colour =
        Some(6);
    plot.add("", Mark::Line, hooks.clone()).colour = Some(6);
    let border = [40.0, 1500.0, 3000.0].map(|g: f64| (g, (g / B).sqrt()));
    plot.add("Γ = (EI/GJ)(κL)²", Mark::Dashed, border).colour = Some(3);
    finding.plot(plot);
    check_criteria(finding, &hairs)
}

/// The two borders of the plane, as points (Γ, κL): that of curls as the weight grows, and that of hooks as the
/// curvature grows.
fn borders(effort: Effort) -> Result<[Vec<(f64, f64)>; 2], Stopped> {
    let kappas: Vec<f64> = effort
        .pick(vec![7.0, 12.0, 40.0], vec![6.6, 7.0, 8.0, 10.0, 13.0, 17.0, 24.0, 34.0, 46.0, 60.0]);
    let coils = kappas.par_iter().map(|&kappa| {
        let found = first(1.0, 1.15, (3000.0, 5), |g| reference_leaves(&hanging_curl(g, kappa)))?;
        Ok(found.map(|gamma| (gamma, kappa)))
    });
    let coils: Vec<Option<(f64, f64)>> = coils.collect::<Result<_, Stopped>>()?;
    let gammas: Vec<f64> = effort
        .pick(vec![40.0, 300.0, 1000.0], vec![25.0, 40.0, 70.0, 150.0, 400.0, 1000.0, 3000.0]);
    let hooks = gammas.par_iter().map(|&gamma| {
        let found = first(2.0, 1.1, (60.0, 5), |k| hook_leaves(&hanging_curl(gamma, k)))?;
        Ok(found.map(|kappa| (gamma, kappa)))
    });
    let hooks: Vec<Option<(f64, f64)>> = hooks.collect::<Result<_, Stopped>>()?;
    Ok([coils.into_iter().flatten().collect(), hooks.into_iter().flatten().collect()])
}

/// Whether a hair has left the plane by the boundary-value problem: neither of its planar shapes is stable. A branch
/// that has ended has none.
fn expected(hair: &Hung) -> bool {
    let bar = hanging_curl(hair.gamma, hair.kappa);
    hook_leaves(&bar).unwrap_or(true) && reference_leaves(&bar).unwrap_or(true)
}

fn check_criteria(finding: &mut Finding, hairs: &[Hung]) -> Result<(), Stopped> {
    let share = |part: usize, of: usize| part as f64 / of as f64;
    let stable = hairs.iter().filter(|h| h.stable).count();
    finding.check(
        "share of the diagram's hairs that are stable",
        share(stable, hairs.len()),
        Limit::AtLeast(1.0),
    );
    let wrong: Vec<&Hung> = hairs.par_iter().filter(|h| h.leaves() != expected(h)).collect();
    for hair in &wrong {
        let (gamma, kappa) = (number(hair.gamma), number(hair.kappa));
        let is = if hair.leaves() { "out of" } else { "in" };
        finding.text(format!(
            "Against the boundary-value problem, Γ = {gamma}, κL = {kappa} is {is} the plane."
        ));
    }
    finding.check(
        format!(
            "share of {} hairs, all of the diagram, in or out of the plane as Morse's index predicts",
            hairs.len()
        ),
        1.0 - share(wrong.len(), hairs.len()),
        Limit::AtLeast(1.0),
    );
    let tension = |h: &Hung| h.gamma / (B * h.kappa * h.kappa);
    let helices: Vec<&Hung> =
        hairs.iter().filter(|h| h.leaves() && !(0.5..2.0).contains(&tension(h))).collect();
    let placed = helices.iter().filter(|h| (h.phase() == Phase::Global) == (tension(h) < 1.0));
    finding.check(
        format!(
            "share of {} helices, off Γ = (EI/GJ)(κL)² by a factor of 2, that are near the tip or all along as it predicts",
            helices.len()
        ),
        share(placed.count(), helices.len()),
        Limit::AtLeast(1.0),
    );
    Ok(())
}
