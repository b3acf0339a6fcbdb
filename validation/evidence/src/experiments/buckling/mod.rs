//! Loads at which a shape loses its stability.

mod hanging;
mod sideways;

use frisure::rod::minimise::Problem;
use frisure::rod::{Chain, ElementKind, equilibrium};
use glam::DVec3;
use rayon::prelude::*;

use super::plane::bisect;
use crate::experiment::check;
use crate::extremes::{largest, smallest};
use crate::plot::{Mark, Plot, Scale};
use crate::reference::greenhill;
use crate::rods::{Bar, LENGTH, to_accuracy};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Table};

pub(super) use hanging::hanging_curl;

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "buckling",
    title: "Buckling: upright, sideways, out of the plane",
    question: "Does hair buckle at the correct loads: upright under its own weight, a flat hair sideways, a \
        naturally curved hair out of its plane?",
    method: "The experiment has three loads at which a symmetric shape loses its stability. Greenhill's (1881), of a column under \
        its own weight, is 9/4 of the square of the first zero of the Bessel function of order −1/3. A flat \
        cantilever that is loaded edgewise buckles sideways; for a very flat one Prandtl and Michell \
        (1899) have qL³/√(EI·GJ) = 6 times the first zero of the Bessel function of order −1/6; for other \
        sections the load is that at which Morse's index of the shape in the plane, by the boundary-value problem, \
        changes from 0 to 1. The third is the bend–twist test of simulators of Romero et al. (2021), after \
        Miller et al. (2014): a naturally curved hair that hangs from a vertical clamp leaves the plane of its \
        curl if its curvature is too large for its weight. The tables of both papers were not \
        available, so the threshold is again that of the boundary-value problem. frisure's loads are \
        found by bisection (of the sign of the smallest eigenvalue; of whether the equilibrium is in the \
        plane), with N and 2N elements, and extrapolated.\n\n\
        The second and the third depend on the ratio of the stiffnesses in twist and bending, GJ/EI (EI about the softer axis), and \
        so on the shear modulus G over E. They are computed for two values: 1/3, of an incompressible isotropic material \
        (GJ/EI = 2/3 of a round hair), and 0.9/3.9 = 0.231, that of the hair types here (GJ/EI = 0.462).",
    run,
};

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    upright(&mut finding)?;
    check(progress, "buckling", 0.15)?;
    sideways::add(&mut finding, effort)?;
    check(progress, "buckling", 0.5)?;
    hanging::add(&mut finding, effort)?;
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
        "Load ρSgL³/EI at which an upright hair buckles",
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
    let error = largest(limit.iter().map(|l| (l / exact - 1.0).abs()));
    finding.check("relative error of Greenhill's load", error, Limit::AtMost(1e-7));
    fall(finding, exact)
}

fn shown(load: f64) -> String {
    format!("{load:.8}")
}

/// The equilibrium of a hair with an exactly upright root.
fn fall(finding: &mut Finding, exact: f64) -> Result<(), Stopped> {
    let mut plot = Plot::new(
        "A hair with an exactly upright root",
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
    finding.check(format!("{lean}, below the load (most)"), largest(below), Limit::AtMost(1e-6));
    finding.check(
        format!("{lean}, above it by 2 % and more (least)"),
        smallest(above),
        Limit::AtLeast(0.1),
    );
    Ok(())
}
