//! Figure 3 of the paper: six hairs, and whether ellipticity makes curls regular.

mod claim;
mod control;
mod hairs;

use frisure::rod::{NaturalStrain, Stability};
use glam::DVec3;

use super::curls::turns;
use crate::experiment::check;
use crate::plot::{Mark, Plot, Scale};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Table};
use hairs::{rest, spec, stiff};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "single",
    title: "Figure 3: single hairs, and the claim on ellipticity",
    question: "Do single hairs look as in figure 3 of the paper, and is it true that curls become more regular \
        along the hair as the eccentricity ε grows at constant mean radius?",
    method: "Hairs of 80 µm with the paper's ρ = 1.3 g/cm³ and ν = 0.3, E = 3.9 GPa (the digit is damaged in \
        our copy): (a) straight under gravity, (b) with its material frames, (c) with natural curvature, (d) \
        with natural twist and little curvature, wound on itself, (e) very curly and round, (f) very curly \
        and elliptical, curled about the soft axis of its section and, f′, about the stiff one. They leave the root sideways and a little up.\n\n\
        The claim is measured on five hanging curls of 15 to 40 cm, for ε from 0 to 0.9, curled about the soft axis of the \
        section and about the stiff one, with each of two torsion constants (the paper's J = I₁ + I₂, and \
        Saint-Venant's, which is exact). G/E is 1/2(1 + ν) = 0.385, as the paper's ν has it. Irregularity is the standard \
        deviation over the mean of the curvature along the centre line, and of the descents per arc length of one turn \
        after the other. The clamp bends the uppermost tenth of a hair for any section, so the report has the curvature \
        without it and with it; descents are of all turns.\n\n\
        ε is √(1 − (b/a)²), the usual definition: the paper's 0.2 is then an axis ratio of 1.02. If the paper meant one \
        minus a ratio of axes, its 0.2 is an axis ratio of 1.25, which is ε = 0.6 here. The report has both.",
    run,
};

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    six(&mut finding)?;
    check(progress, "single", 0.2)?;
    claim::add(&mut finding, effort)?;
    check(progress, "single", 0.8)?;
    control::add(&mut finding)?;
    Ok(finding)
}

fn six(finding: &mut Finding) -> Result<(), Stopped> {
    let curl = NaturalStrain::helix;
    let hairs = [
        ("a straight", spec(0.16, 0.0, NaturalStrain::STRAIGHT)?),
        ("b its frames", spec(0.16, 0.0, NaturalStrain::STRAIGHT)?),
        ("c curved", spec(0.16, 0.0, NaturalStrain::Uniform(DVec3::new(45.0, 0.0, 0.0)))?),
        ("d twisted", spec(0.20, 0.0, NaturalStrain::Uniform(DVec3::new(120.0, 0.0, 170.0)))?),
        ("e curly, ε = 0", spec(0.22, 0.0, curl(0.006, 0.007)?)?),
        ("f ε = 0.9, soft axis", spec(0.22, 0.9, curl(0.006, 0.007)?)?),
        ("f′ ε = 0.9, stiff axis", stiff(spec(0.22, 0.9, curl(0.006, 0.007)?)?)?),
    ];
    let mut plot = Plot::new(
        "Figure 3: hairs in equilibrium",
        "cm (each hair shifted)",
        "height over the root (cm)",
        [Scale::Linear; 2],
    );
    plot.equal = true;
    plot.size = [960.0, 430.0];
    let mut table = Table::new(
        "The hairs",
        &[
            "hair",
            "length (cm)",
            "tip below the root (cm)",
            "turns",
            "stable",
            "error estimate (mm)",
        ],
    );
    let mut stable = 0;
    for (i, (name, spec)) in hairs.iter().enumerate() {
        let found = rest(spec)?;
        let points = found.sample(1500);
        let at = 5.0 * i as f64;
        let line = points.iter().map(|(p, _)| (at + 100.0 * p.x, 100.0 * p.z));
        plot.add(name, Mark::Line, line).colour = Some(i);
        if i == 1 {
            frames(&mut plot, &points, at);
        }
        let over: Vec<DVec3> = points.iter().map(|(p, _)| *p / spec.length).collect();
        let is = found.certificate.stability == Stability::Stable;
        stable += usize::from(is);
        table.row([
            (*name).to_owned(),
            format!("{:.0}", 100.0 * spec.length),
            format!("{:.2}", -100.0 * found.tip().z),
            turns(&over).len().to_string(),
            if is { "yes".into() } else { "no".into() },
            found.error_estimate.map_or_else(String::new, |e| format!("{:.4}", 1e3 * e)),
        ]);
    }
    finding.plot(plot);
    finding.text(
        "The picture shows one of b's two directors: the other points at the viewer. e, f and f′ look alike, although ε is \
         0.9, so the claim has to be measured.",
    );
    finding.table(table);
    finding.check(
        "of seven hairs, those in a stable equilibrium",
        stable as f64,
        Limit::AtLeast(7.0),
    );
    Ok(())
}

/// Material frames along a hair: d1 and d2 as short strokes.
fn frames(plot: &mut Plot, points: &[(DVec3, glam::DMat3)], at: f64) {
    for (p, frame) in points.iter().step_by(120) {
        for (director, colour) in [(frame.x_axis, 3), (frame.y_axis, 5)] {
            let end = *p + director * 0.007;
            let stroke = [(at + 100.0 * p.x, 100.0 * p.z), (at + 100.0 * end.x, 100.0 * end.z)];
            plot.add("", Mark::Line, stroke).colour = Some(colour);
        }
    }
}
