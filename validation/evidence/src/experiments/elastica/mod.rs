//! The elastica and the heavy cantilever.

mod column;
mod master;

use frisure::rod::{ElementKind, Options, equilibrium};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::experiment::check;
use crate::extremes::largest;
use crate::numbers::number;
use crate::plot::{Mark, Plot, Scale};
use crate::reference::Hanging;
use crate::rods::{Bar, elements, to_accuracy};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Table};
use master::MASTER;

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "elastica",
    title: "The elastica and the heavy cantilever",
    question: "Does a straight hair bend as Euler's elastica does, under its own weight and under a load at \
        its tip, from a millimetre of stubble to hair that reaches the floor?",
    method: "A straight rod clamped horizontally bends under its own weight along one master curve of \
        Γ = ρSgL³/EI. The curve is known to ten digits from Γ = 0.01 to 100 000 by shooting from the tip, \
        computed independently of frisure, and compared with the boundary-value problem here; its ends are Γ/8 (the linear beam) and √(Γ/2) (a thread with a stiff \
        root) for drop over reach. The experiment compares the tips of rods with it, at a requested accuracy \
        and with the fixed numbers of elements of the paper.\n\n\
        A column that is clamped at its foot and carries a weight at its tip, without a weight of its own, \
        is Euler's own problem. Beyond P = π²EI/4L² its shape is known by complete elliptic integrals: \
        PL²/EI = K(k)², height 2E/K − 1, sideways 2k/K, with k = sin(α/2) and α the angle of the tip.",
    run,
};

/// The requested accuracy, over the length.
const REQUEST: f64 = 1e-6;

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    progress.report("elastica", 0.0);
    let rows: Vec<Row> = MASTER.par_iter().map(Row::of).collect::<Result<_, Stopped>>()?;
    checked(&mut finding, effort)?;
    curve(&mut finding, &rows);
    errors(&mut finding, &rows);
    check(progress, "elastica", 0.7)?;
    column::add(&mut finding)?;
    Ok(finding)
}

/// Fixed numbers of elements.
const COUNTS: [usize; 3] = [15, 30, 60];

/// One heaviness.
struct Row {
    gamma: f64,
    exact: DVec2,
    found: DVec2,
    error: f64,
    estimate: f64,
    elements: usize,
    fixed: [f64; 3],
}

impl Row {
    fn of(&[gamma, reach, drop]: &[f64; 3]) -> Result<Self, Stopped> {
        let rod = Bar { gamma, ..Bar::STRAIGHT }.rod()?;
        let exact = DVec2::new(reach, -drop);
        let tip = |options: &Options| {
            let found = equilibrium(&rod, &[], options);
            let tip = found.tip() / rod.length();
            // A displacement out of the plane counts as an error.
            let error = tip.distance(DVec3::new(reach, 0.0, -drop));
            (found, DVec2::new(tip.x, tip.z), error)
        };
        let (found, at, error) = tip(&to_accuracy(&rod, REQUEST));
        let fixed = COUNTS.map(|n| tip(&elements(n, ElementKind::Helix)).2);
        let estimate = found.error_estimate.unwrap_or(f64::NAN) / rod.length();
        let elements = found.elements;
        Ok(Self { gamma, exact, found: at, error, estimate, elements, fixed })
    }
}

/// The table of the master curve against the boundary-value problem.
fn checked(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let some: Vec<&[f64; 3]> = MASTER.iter().step_by(effort.pick(8, 1)).collect();
    let off = |&&[gamma, reach, drop]: &&[f64; 3]| -> Result<f64, Stopped> {
        let spec = Bar { gamma, ..Bar::STRAIGHT }.spec()?;
        let tip = Hanging::new(&spec).solve()?.tip() / spec.length;
        Ok(tip.distance(DVec3::new(reach, 0.0, -drop)))
    };
    let off: Vec<f64> = some.par_iter().map(off).collect::<Result<_, Stopped>>()?;
    finding.check(
        format!(
            "largest distance of {} rows of the master curve from the boundary-value problem, over the length",
            some.len()
        ),
        largest(off),
        Limit::AtMost(1e-9),
    );
    Ok(())
}

fn curve(finding: &mut Finding, rows: &[Row]) {
    let mut plot = Plot::new(
        "Master curve of the heavy cantilever",
        "Γ = ρSgL³/EI",
        "over the length",
        [Scale::Log, Scale::Linear],
    );
    plot.add("drop, reference", Mark::Line, rows.iter().map(|r| (r.gamma, -r.exact.y)));
    plot.add("reach, reference", Mark::Line, rows.iter().map(|r| (r.gamma, r.exact.x)));
    let some = || rows.iter().step_by(4);
    plot.add("drop, frisure", Mark::Points, some().map(|r| (r.gamma, -r.found.y))).colour = Some(0);
    plot.add("reach, frisure", Mark::Points, some().map(|r| (r.gamma, r.found.x))).colour = Some(1);
    let light = rows.iter().filter(|r| r.gamma < 4.0);
    plot.add("Γ/8", Mark::Dashed, light.map(|r| (r.gamma, r.gamma / 8.0)));
    finding.plot(plot);
}

fn errors(finding: &mut Finding, rows: &[Row]) {
    let mut plot = Plot::new(
        "Error of the tip",
        "Γ = ρSgL³/EI",
        "error over the length",
        [Scale::Log, Scale::Log],
    );
    for (k, count) in COUNTS.iter().enumerate() {
        let name = format!("{count} helix elements");
        plot.add(&name, Mark::Line, rows.iter().map(|r| (r.gamma, r.fixed[k])));
    }
    plot.add("1e-6 requested", Mark::Line, rows.iter().map(|r| (r.gamma, r.error)));
    plot.add("its estimate", Mark::Dashed, rows.iter().map(|r| (r.gamma, r.estimate))).colour =
        Some(3);
    finding.plot(plot);

    let mut table = Table::new(
        "Error of the tip over the length",
        &["Γ", "15 elements", "30", "60", "1e-6 requested", "its elements"],
    );
    for row in rows.iter().step_by(8) {
        let shown = |x: f64| format!("{x:.1e}");
        let mut cells = vec![number(row.gamma)];
        cells.extend(row.fixed.map(shown));
        cells.extend([shown(row.error), row.elements.to_string()]);
        table.row(cells);
    }
    finding.table(table);

    let most = |of: fn(&Row) -> f64| largest(rows.iter().map(of));
    let over = |r: &Row| r.error / (r.estimate + 1e-10);
    finding.check(
        "largest error of the tip over the length, Γ from 0.01 to 100 000, 1e-6 requested",
        most(|r| r.error),
        Limit::AtMost(REQUEST),
    );
    finding.check(
        "largest error over its estimate (with 1e-10 of the length for rounding)",
        most(over),
        Limit::AtMost(1.0),
    );
    let hair = largest(rows.iter().filter(|r| r.gamma < 110.0).map(|r| r.fixed[0]));
    finding.check(
        "largest error of the paper's 15 elements over the length, Γ up to 100",
        hair,
        Limit::AtMost(5e-3),
    );
    finding.text(
        "15 cm of hair has Γ around 50. Beyond Γ = 1000, as for a metre of hair, the whole bend is within \
         L/√Γ of the root, which 15 equal elements do not resolve: their error is then a per cent and more of \
         the length. With a requested accuracy, the error is below it over all seven decades.",
    );
}
