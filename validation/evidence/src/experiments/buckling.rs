//! Loads at which a shape gives way.

use frisure::rod::minimise::Problem;
use frisure::rod::{Chain, ElementKind, equilibrium};
use glam::DVec3;
use rayon::prelude::*;

use super::plane::{
    bisect, first, frisure_leaves, frisure_threshold, hook_leaves, reference_leaves,
};
use crate::plot::{Mark, Plot, Scale};
use crate::reference::{greenhill, prandtl_michell};
use crate::rods::{Bar, LENGTH, to_accuracy};
use crate::{Effort, Experiment, Finding, Limit, Monitor, Stopped, Table};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "buckling",
    title: "Buckling: upright, sideways, out of the plane",
    question: "Does hair give way where it must: upright under its own weight, a flat hair sideways, a \
        naturally curved hair out of its plane?",
    method: "Three loads at which a symmetric shape loses its stability. Greenhill's (1881), of a column under \
        its own weight, is 9/4 of the square of the first zero of the Bessel function of order −1/3. A flat \
        cantilever that is loaded edgewise turns over sideways; for a very flat one Prandtl and Michell \
        (1899) have qL³/√(EI·GJ) = 6 times the first zero of the Bessel function of order −1/6; for other \
        sections the load is where Morse's index of the shape in the plane, by the boundary-value problem, \
        turns from 0 to 1. The third is the bend–twist test of simulators of Romero et al. (2021), after \
        Miller et al. (2014): a naturally curved hair that hangs from a vertical clamp leaves the plane of its \
        curl where its curvature is too large for its weight. We know both papers by their subject, not by \
        tables, so that the threshold is again that of the boundary-value problem. frisure's loads are \
        found by bisection (of the sign of the smallest eigenvalue; of whether the equilibrium is in the \
        plane), with N and 2N elements, and extrapolated.",
    run,
};

fn run(effort: Effort, monitor: &dyn Monitor) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    upright(&mut finding)?;
    super::check(monitor, "buckling", 0.15)?;
    sideways(&mut finding, effort)?;
    super::check(monitor, "buckling", 0.5)?;
    out_of_the_plane(&mut finding, effort)?;
    Ok(finding)
}

fn upright(finding: &mut Finding) -> Result<(), Stopped> {
    let load = |kind: ElementKind, count: usize| {
        bisect(5.0, 20.0, 40, |gamma| {
            let rod = Bar { gamma, tangent: DVec3::Z, ..Bar::STRAIGHT }.rod()?;
            let chain = Chain::uniform(&rod, kind, count);
            Ok(Problem::new(&chain, &[]).min_eigenvalue(&chain.natural_shape()) < 0.0)
        })
    };
    let exact = greenhill();
    let mut table = Table::new(
        "Load ρSgL³/EI at which an upright hair gives way",
        &["elements", "helices", "jointed"],
    );
    let kinds = [ElementKind::Helix, ElementKind::Jointed];
    let mut last = [[0.0; 2]; 2];
    for count in [1, 2, 5, 15, 60, 120] {
        let loads = [load(kinds[0], count)?, load(kinds[1], count)?];
        last = [last[1], loads];
        table.row([count.to_string(), format!("{:.6}", loads[0]), format!("{:.6}", loads[1])]);
    }
    let [coarse, fine] = last;
    let limit = [0, 1].map(|k| (4.0 * fine[k] - coarse[k]) / 3.0);
    table.row(["60 and 120, extrapolated".to_owned(), shown(limit[0]), shown(limit[1])]);
    table.row(["Greenhill".to_owned(), shown(exact), shown(exact)]);
    finding.table(table);
    let error = limit.iter().map(|l| (l / exact - 1.0).abs()).fold(0.0, f64::max);
    finding.judge("relative error of Greenhill's load", error, Limit::AtMost(1e-7));
    fall(finding, exact)
}

fn shown(load: f64) -> String {
    format!("{load:.8}")
}

/// What becomes of a hair that was planted exactly upright.
fn fall(finding: &mut Finding, exact: f64) -> Result<(), Stopped> {
    let mut plot = Plot::new(
        "A hair planted exactly upright",
        "Γ = ρSgL³/EI",
        "tip over the length",
        [Scale::Linear; 2],
    );
    let gammas: Vec<f64> = (0..=60).map(|i| 6.0 + 0.2 * f64::from(i)).collect();
    let tips = gammas
        .par_iter()
        .map(|&gamma| {
            let rod = Bar { gamma, tangent: DVec3::Z, ..Bar::STRAIGHT }.rod()?;
            Ok(equilibrium(&rod, &[], &to_accuracy(&rod, 1e-4)).tip() / LENGTH)
        })
        .collect::<Result<Vec<DVec3>, Stopped>>()?;
    let both = || gammas.iter().zip(&tips);
    plot.add("sideways", Mark::Line, both().map(|(g, t)| (*g, t.truncate().length())));
    plot.add("height", Mark::Line, both().map(|(g, t)| (*g, t.z)));
    plot.add("Greenhill", Mark::Dashed, [(exact, -0.3), (exact, 1.0)]).colour = Some(6);
    finding.plot(plot);
    let below = both().filter(|(g, _)| **g < exact).map(|(_, t)| t.truncate().length());
    let above = both().filter(|(g, _)| **g > exact).map(|(_, t)| t.truncate().length());
    let lean = "tip of an upright hair sideways, over the length";
    finding.judge(
        format!("{lean}, below the load (most)"),
        below.fold(0.0, f64::max),
        Limit::AtMost(1e-6),
    );
    finding.judge(
        format!("{lean}, above it by 2 % and more (least)"),
        above.fold(1.0, f64::min),
        Limit::AtLeast(0.1),
    );
    Ok(())
}

fn sideways(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let ratios: &[f64] =
        effort.pick(&[2.0, 5.0, 100.0], &[1.5, 1.75, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0]);
    let loads = ratios.par_iter().map(|&ratio| edgewise(ratio)).collect::<Result<Vec<_>, _>>()?;
    let mut table = Table::new(
        "Load qL³/√(EI·GJ) at which a hair of axis ratio a/b, loaded edgewise, turns over",
        &["a/b", "reference", "frisure", "relative difference", "Γ = qL³/EI"],
    );
    let mut worst = 0.0_f64;
    for (ratio, loads) in ratios.iter().zip(&loads) {
        let Some([reference, frisure, gamma]) = loads else {
            let none = || "none up to Γ = 2000".to_owned();
            table.row([format!("{ratio}"), none(), none(), String::new(), String::new()]);
            continue;
        };
        let difference = frisure / reference - 1.0;
        // A number that is none must not get lost in a maximum.
        worst = if difference.is_nan() { f64::NAN } else { worst.max(difference.abs()) };
        let row = [reference, frisure].map(|x| format!("{x:.6}"));
        let [a, b] = row;
        table.row([format!("{ratio}"), a, b, format!("{difference:.1e}"), format!("{gamma:.3}")]);
    }
    let limit = prandtl_michell();
    let none = String::new;
    table.row(["∞ (Prandtl, Michell)".to_owned(), format!("{limit:.6}"), none(), none(), none()]);
    finding.table(table);
    finding.judge(
        "largest relative difference of the sideways load from the boundary-value problem's",
        worst,
        Limit::AtMost(1e-4),
    );
    let flat = loads.last().copied().flatten().map_or(f64::NAN, |l| l[1] / limit - 1.0);
    finding.judge(
        "relative difference of it at a/b = 100 from Prandtl and Michell",
        flat.abs(),
        Limit::AtMost(1e-3),
    );
    Ok(())
}

/// The reference's and frisure's load in units of √(EI·GJ)/L³, and the reference's in those of EI/L³; none if
/// the rod never turns over.
fn edgewise(ratio: f64) -> Result<Option<[f64; 3]>, Stopped> {
    let bar = |gamma: f64| Bar { gamma, ratio, d1: DVec3::Z, ..Bar::STRAIGHT };
    let twist = bar(1.0).rod()?.stiffness();
    let unit = (twist.z / twist.x).sqrt();
    let leaves = |gamma: f64| reference_leaves(&bar(gamma));
    let Some(reference) = first(2.0, 1.15, (2000.0, 27), leaves)? else {
        // frisure must not turn over either; a load at which it does has nothing to agree with.
        let loads = (1..=20).map(|k| 2000_f64.powf(f64::from(k) / 20.0));
        for gamma in loads {
            if frisure_leaves(&bar(gamma), DVec3::Y, 60)? {
                return Ok(Some([f64::INFINITY, gamma / unit, f64::INFINITY]));
            }
        }
        return Ok(None);
    };
    let frisure = frisure_threshold(reference, DVec3::Y, 60, bar)?;
    Ok(Some([reference / unit, frisure / unit, reference]))
}

fn out_of_the_plane(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let gammas: &[f64] = effort.pick(&[60.0, 300.0], &[50.0, 100.0, 300.0, 1000.0, 3000.0]);
    let hooks = gammas.par_iter().map(|&g| hook(g)).collect::<Result<Vec<_>, _>>()?;
    let kappas: &[f64] = effort.pick(&[8.0, 16.0], &[7.0, 8.0, 12.0, 16.0, 30.0, 50.0]);
    let coils = kappas.par_iter().map(|&k| coil(k)).collect::<Result<Vec<_>, _>>()?;

    let mut table = Table::new(
        "Natural curvature κL beyond which the hook at the end of a hanging hair leaves its plane",
        &["Γ = ρSgL³/EI", "reference", "frisure", "relative difference", "κ(EI/ρSg)^⅓"],
    );
    for (gamma, &[reference, frisure]) in gammas.iter().zip(&hooks) {
        let scaled = format!("{:.4}", reference / gamma.cbrt());
        table.row(compared(*gamma, reference, frisure).into_iter().chain([scaled]));
    }
    finding.table(table);
    let mut table = Table::new(
        "Weight Γ = ρSgL³/EI beyond which a hanging planar curl leaves its plane",
        &["κL", "reference", "frisure", "relative difference", "Γ/(κL)²"],
    );
    for (kappa, &[reference, frisure]) in kappas.iter().zip(&coils) {
        let scaled = format!("{:.4}", reference / kappa.powi(2));
        table.row(compared(*kappa, reference, frisure).into_iter().chain([scaled]));
    }
    finding.table(table);
    let differences = hooks.iter().chain(&coils).map(|[r, f]| (f / r - 1.0).abs());
    finding.judge(
        "largest relative difference of the two thresholds from the boundary-value problem's",
        // A number that is none must not get lost in a maximum.
        differences.fold(0.0, |m: f64, d| if d.is_nan() { d } else { m.max(d) }),
        Limit::AtMost(1e-4),
    );
    finding.text(
        "Between the two thresholds the hair is out of its plane. In the first table κ(EI/ρSg)^⅓ tends to a          constant: it is the lowest part of a heavy hair alone that decides, and its length does not matter.",
    );
    Ok(())
}

fn compared(at: f64, reference: f64, frisure: f64) -> [String; 4] {
    let difference = frisure / reference - 1.0;
    [
        format!("{at}"),
        format!("{reference:.6}"),
        format!("{frisure:.6}"),
        format!("{difference:.1e}"),
    ]
}

/// The reference's and frisure's threshold of curvature at a weight.
fn hook(gamma: f64) -> Result<[f64; 2], Stopped> {
    let bar = |kappa: f64| hanging_curl(gamma, kappa);
    let found = first(2.0, 1.1, (60.0, 27), |kappa| hook_leaves(&bar(kappa)))?;
    let reference =
        found.ok_or_else(|| Stopped::Other(format!("no hook of Γ = {gamma} leaves its plane")))?;
    Ok([reference, frisure_threshold(reference, DVec3::Y, 120, bar)?])
}

/// The reference's and frisure's threshold of weight at a curvature.
fn coil(kappa: f64) -> Result<[f64; 2], Stopped> {
    let bar = |gamma: f64| hanging_curl(gamma, kappa);
    let found = first(1.0, 1.15, (3000.0, 27), |gamma| reference_leaves(&bar(gamma)))?;
    let reference =
        found.ok_or_else(|| Stopped::Other(format!("no curl of κL = {kappa} leaves its plane")))?;
    let count = (8.0 * kappa).max(160.0) as usize;
    Ok([reference, frisure_threshold(reference, DVec3::Y, count, bar)?])
}

/// A round hair that hangs from a vertical clamp, its natural shape a circle of κL in the plane y = 0.
pub(super) fn hanging_curl(gamma: f64, kappa: f64) -> Bar {
    let natural = DVec3::new(kappa, 0.0, 0.0);
    Bar { gamma, natural, tangent: DVec3::NEG_Z, d1: DVec3::Y, ..Bar::STRAIGHT }
}
