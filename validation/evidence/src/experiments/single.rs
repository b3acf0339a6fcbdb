//! Figure 3 of the paper: six hairs, and whether ellipticity makes curls regular.

use frisure::rod::{
    Equilibrium, Material, NaturalStrain, Rod, RodSpec, Root, Section, Stability, TorsionConstant,
    equilibrium,
};
use glam::DVec3;
use rayon::prelude::*;

use super::curls::{curvatures, turns, variation};
use crate::plot::{Mark, Plot, Scale};
use crate::rods::to_accuracy;
use crate::{Effort, Experiment, Finding, Limit, Monitor, Stopped, Table};

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
        Saint-Venant's, which is exact). Irregularity is the standard deviation over the mean of the curvature along \
        the centre line, and of the descents per arc length of one turn after the other.",
    run,
};

fn spec(length: f64, eccentricity: f64, natural: NaturalStrain) -> Result<RodSpec, Stopped> {
    Ok(RodSpec {
        length,
        section: Section::from_mean_radius(40e-6, eccentricity)?,
        material: Material::isotropic(3.9e9, 0.3, 1300.0)?,
        torsion: TorsionConstant::Polar,
        natural,
        root: Root::from_tangent(DVec3::ZERO, DVec3::new(1.0, 0.0, 0.4), DVec3::Y)?,
        gravity: 9.81,
    })
}

fn rest(spec: &RodSpec) -> Result<Equilibrium, Stopped> {
    let rod = Rod::new(spec.clone())?;
    Ok(equilibrium(&rod, &[], &to_accuracy(&rod, 1e-4)))
}

fn run(effort: Effort, monitor: &dyn Monitor) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    six(&mut finding)?;
    super::check(monitor, "single", 0.2)?;
    claim(&mut finding, effort)?;
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
        "Figure 3: hairs at rest",
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
    finding.table(table);
    finding.judge(
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

/// Radius and pitch of the natural curl and length of the hairs that the claim is tried on (m).
const CURLS: [(f64, f64, f64); 5] = [
    (0.003, 0.003, 0.15),
    (0.004, 0.009, 0.25),
    (0.006, 0.007, 0.22),
    (0.008, 0.020, 0.30),
    (0.010, 0.024, 0.40),
];

/// What is irregular.
const MEASURES: [&str; 2] = ["curvature", "descent of turns"];

/// Which axis the curl is about, and the torsion constant.
const WAYS: [(bool, TorsionConstant, &str); 4] = [
    (true, TorsionConstant::SaintVenant, "soft axis, Saint-Venant"),
    (true, TorsionConstant::Polar, "soft axis, I₁ + I₂"),
    (false, TorsionConstant::SaintVenant, "stiff axis, Saint-Venant"),
    (false, TorsionConstant::Polar, "stiff axis, I₁ + I₂"),
];

/// Eccentricities of the tables.
const SHOWN: [f64; 5] = [0.0, 0.2, 0.5, 0.75, 0.9];

/// A hanging curl of the claim.
fn curl(
    k: usize,
    (soft, torsion, _): (bool, TorsionConstant, &str),
    e: f64,
) -> Result<RodSpec, Stopped> {
    let (radius, pitch, length) = CURLS[k];
    let u = NaturalStrain::helix(radius, pitch)?.at(0.0);
    let spec = RodSpec { torsion, ..spec(length, e, NaturalStrain::Uniform(u))? };
    if soft { Ok(spec) } else { stiff(spec) }
}

/// The same curl in the same place, about the other axis of its section.
fn stiff(spec: RodSpec) -> Result<RodSpec, Stopped> {
    let u = spec.natural.at(0.0);
    let frame = spec.root.frame();
    let root = Root::new(DVec3::ZERO, -frame.y_axis, frame.x_axis, frame.z_axis)?;
    let natural = NaturalStrain::Uniform(DVec3::new(0.0, u.x, u.z));
    Ok(RodSpec { natural, root, ..spec })
}

/// Irregularities of a hair, as [`MEASURES`] has them.
fn irregular(spec: &RodSpec) -> Result<[f64; 2], Stopped> {
    let found = rest(spec)?;
    let line: Vec<DVec3> = found.centre_line(2001).iter().map(|p| *p / spec.length).collect();
    let curvature = curvatures(&line);
    let descents: Vec<f64> = turns(&line).iter().map(|t| t.descent).collect();
    // The clamp bends the first tenth, whatever the section.
    Ok([variation(&curvature[200..]), variation(&descents)])
}

fn claim(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let steps = effort.pick(6, 36);
    let all: Vec<f64> = (0..=steps).map(|i| 0.9 * f64::from(i) / f64::from(steps)).collect();
    let mut table = Table::new(
        "Irregularity over that at ε = 0: mean over five curls (and how many of them are more regular)",
        &["what varies", "curl about", "ε = 0.2", "0.5", "0.75", "0.9"],
    );
    let mut small = 0.0_f64;
    let mut more = [0; 2];
    for (m, measure) in MEASURES.into_iter().enumerate() {
        let mut plot = Plot::new(
            &format!("Irregularity: {measure}"),
            "eccentricity ε",
            "over that of ε = 0",
            [Scale::Linear, Scale::Linear],
        );
        plot.size = [520.0, 320.0];
        for (w, way) in WAYS.into_iter().enumerate() {
            let relative = |e: f64| -> Result<Vec<f64>, Stopped> {
                let one = |k: usize| {
                    Ok(irregular(&curl(k, way, e)?)?[m] / irregular(&curl(k, way, 0.0)?)?[m])
                };
                (0..CURLS.len()).map(one).collect()
            };
            let mean = |r: &[f64]| r.iter().sum::<f64>() / r.len() as f64;
            let curve: Vec<(f64, f64)> = all
                .par_iter()
                .map(|&e| Ok((e, mean(&relative(e)?))))
                .collect::<Result<_, Stopped>>()?;
            let mark = if w % 2 == 0 { Mark::Line } else { Mark::Dashed };
            plot.add(way.2, mark, curve).colour = Some(w / 2);
            let mut cells = vec![measure.to_owned(), way.2.to_owned()];
            for e in &SHOWN[1..] {
                let relative = relative(*e)?;
                let regular = relative.iter().filter(|r| **r < 1.0).count();
                cells.push(format!("{:.3} ({regular})", mean(&relative)));
                if m == 0 && *e == 0.2 {
                    small = relative.iter().fold(small, |s, r| s.max((r - 1.0).abs()));
                }
                if m == 0 && *e == 0.75 {
                    more[w / 2] += regular;
                }
            }
            table.row(cells);
        }
        finding.plot(plot);
    }
    finding.table(table);
    finding.text(
        "The claim is true of the curvature of a curl about the stiff axis of its section, and false of one about \
         the soft axis, for every ε, every curl and both torsion constants tried. The reason is the stiffness that \
         works against the weight: at constant mean radius it is EI(1 − ε²)^(−½) about the one axis and \
         EI(1 − ε²)^(½) about the other. Nothing in the paper says which it means; our hair curls about its soft \
         axis, as a strip does. In the paper's own range, ε up to 0.2, either effect is a few per cent, which \
         nobody sees. The turns descend more evenly too about the stiff axis and less so about \
         the soft one, in the mean of the five curls, but not each of them.",
    );
    finding.judge(
        "of 10 series about the stiff axis, those whose curvature is more regular at ε = 0.75 than at 0",
        more[1] as f64,
        Limit::AtLeast(10.0),
    );
    finding.judge(
        "of 10 series about the soft axis, those of which the same is true",
        more[0] as f64,
        Limit::AtMost(0.0),
    );
    finding.judge(
        "largest relative change of that irregularity within the paper's range, from ε = 0 to 0.2",
        small,
        Limit::AtMost(0.05),
    );
    Ok(())
}
