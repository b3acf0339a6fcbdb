//! Figure 6 of the paper: hair that grows, and the linear beam.

use frisure::rod::potential::FieldPotential;
use frisure::rod::{
    Equilibrium, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant,
    equilibrium,
};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::sphere::Sphere;
use crate::experiment::check;
use crate::extremes::{larger, largest};
use crate::plot::{Mark, Plot, Scale};
use crate::reference::{Hanging, anjyo, greenhill};
use crate::rods::{line, to_accuracy};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Table};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "growth",
    title: "Figure 6: hair that grows, and the linear beam of Anjyo et al.",
    question: "Does hair that grows stand straight at first, bend under its own weight beyond a threshold length, \
        and then fall, where a linear beam still points outwards?",
    method: "Straight hair of 80 µm (E = 3.9 GPa, ν = 0.3, so that G/E = 0.385 and GJ/EI = 0.77; 1.3 g/cm³) grows from 1 to 25 cm, from roots at 0 to 89.9° over \
        the horizontal. The threshold of an upright hair is Greenhill's length (7.8373 EI/ρSg)^⅓; shapes are \
        compared with the boundary-value problem. The linear beam after Anjyo, Usami and Kurihara (1992), as the \
        paper describes it: a chain of rigid segments, each rotated, along the direction across the root, by the angle that the \
        formula of the cantilever for small deflections gives for the moment of the weight on the hair as it grew. \
        It is our reconstruction from that description and from memory of the original.",
    run,
};

fn spec(length: f64, rise: f64) -> Result<RodSpec, Stopped> {
    let tangent = DVec3::new(rise.cos(), 0.0, rise.sin());
    Ok(RodSpec {
        length,
        section: Section::circular(40e-6)?,
        material: Material::isotropic(3.9e9, 0.3, 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::STRAIGHT,
        root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::Y)?,
        load: Load::down(9.81),
    })
}

fn rest(spec: &RodSpec) -> Result<Equilibrium, Stopped> {
    let rod = Rod::new(spec.clone())?;
    Ok(equilibrium(&rod, &[], &to_accuracy(&rod, 1e-5)))
}

/// Length (m) at which an upright hair of the experiment buckles.
fn threshold() -> Result<f64, Stopped> {
    let rod = Rod::new(spec(1.0, 0.0)?)?;
    Ok((greenhill() / rod.heaviness()).cbrt())
}

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    heads(&mut finding)?;
    check(progress, "growth", 0.3)?;
    tips(&mut finding, effort)?;
    check(progress, "growth", 0.7)?;
    exact(&mut finding)?;
    Ok(finding)
}

/// Radius of the head (m).
const HEAD: f64 = 0.09;

/// Both models from the same roots, on a head that is a sphere.
fn heads(finding: &mut Finding) -> Result<(), Stopped> {
    let stages = [0.03, threshold()?, 0.12, 0.20];
    for (title, beam) in [("The linear beam of Anjyo et al.", true), ("Rods", false)] {
        let mut plot = Plot::new(
            &format!("{title}: hair of 3, {:.1}, 12 and 20 cm", 100.0 * stages[1]),
            "cm (each stage shifted)",
            "cm",
            [Scale::Linear; 2],
        );
        plot.equal = true;
        plot.size = [760.0, 330.0];
        for (stage, length) in stages.into_iter().enumerate() {
            let middle = 38.0 * stage as f64;
            let angles = (0..=72).map(|k| f64::from(5 * k).to_radians());
            let circle = angles.map(|angle| DVec2::from_angle(angle) * (100.0 * HEAD));
            plot.add("", Mark::Line, circle.map(|p| (middle + p.x, p.y))).colour = Some(6);
            for k in 0..=12 {
                let rise = f64::from(15 * k).to_radians();
                let (mirror, up) =
                    if k <= 6 { (1.0, rise) } else { (-1.0, std::f64::consts::PI - rise) };
                let points = if beam { beam_line(length, up)? } else { on_the_head(length, up)? };
                let root = DVec2::from_angle(up) * HEAD;
                let shown = points.into_iter().map(|p| {
                    let p = (root + p) * 100.0;
                    (middle + mirror * p.x, p.y)
                });
                plot.add("", Mark::Line, shown).colour = Some(usize::from(beam));
            }
        }
        finding.plot(plot);
    }
    finding.text(
        "Rods lie on the head; the beam has no contact with it. Rods stand, then bend, then hang; the linear beam \
         bends hair with a horizontal root, but the steeper the root the longer is the hair that points outwards, and at the \
         crown it stands at any length.",
    );
    Ok(())
}

/// Points (m) in the plane of the hair.
fn rod_line(length: f64, rise: f64) -> Result<Vec<DVec2>, Stopped> {
    let found = rest(&spec(length, rise)?)?;
    Ok(found.centre_line(81).iter().map(|p| DVec2::new(p.truncate().length(), p.z)).collect())
}

/// Points (m) of a rod in contact with the head, in the plane of the hair.
fn on_the_head(length: f64, rise: f64) -> Result<Vec<DVec2>, Stopped> {
    let rod = Rod::new(spec(length, rise)?)?;
    let root = DVec3::new(rise.cos(), 0.0, rise.sin()) * (HEAD + 1e-4);
    let head = Sphere { middle: -root, radius: HEAD, stiffness: 2000.0 };
    let found = equilibrium(&rod, &[&FieldPotential::new(&head, 4)], &to_accuracy(&rod, 1e-3));
    Ok(found.centre_line(161).iter().map(|p| DVec2::new(p.truncate().length(), p.z)).collect())
}

fn beam_line(length: f64, rise: f64) -> Result<Vec<DVec2>, Stopped> {
    let gamma = Rod::new(spec(length, rise)?)?.heaviness();
    Ok(anjyo(gamma, rise, 80).into_iter().map(|p| p * length).collect())
}

/// Height of the tip as the hair grows.
fn tips(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let count = effort.pick(50, 240);
    let lengths: Vec<f64> =
        (0..=count).map(|i| 0.01 + 0.24 * f64::from(i) / f64::from(count)).collect();
    let mut plot = Plot::new(
        "Height of the tip over the root as hair grows",
        "length (cm)",
        "height over length",
        [Scale::Linear; 2],
    );
    let rises = [0.0_f64, 45.0, 80.0, 89.9];
    let mut ends = Vec::new();
    for (i, rise) in rises.into_iter().enumerate() {
        let up = rise.to_radians();
        let height = |line: Vec<DVec2>, l: f64| line[line.len() - 1].y / l;
        let rods: Vec<f64> = lengths
            .par_iter()
            .map(|&l| Ok(height(rod_line(l, up)?, l)))
            .collect::<Result<_, Stopped>>()?;
        let mut beams = Vec::new();
        for &l in &lengths {
            beams.push(height(beam_line(l, up)?, l));
        }
        ends.push((rods[rods.len() - 1], beams[beams.len() - 1]));
        let cm = || lengths.iter().map(|l| 100.0 * l);
        let name = format!("rod, {rise}°");
        plot.add(&name, Mark::Line, cm().zip(rods)).colour = Some(i);
        let name = format!("linear beam, {rise}°");
        plot.add(&name, Mark::Dashed, cm().zip(beams)).colour = Some(i);
    }
    finding.plot(plot);
    let mut table = Table::new(
        "Height of the tip over the length, 25 cm of hair",
        &["root", "rod", "linear beam"],
    );
    for (rise, (rod, beam)) in rises.iter().zip(&ends) {
        table.row([format!("{rise}°"), format!("{rod:.3}"), format!("{beam:.3}")]);
    }
    finding.table(table);
    let highest = largest(ends.iter().map(|e| e.0));
    finding.check(
        "height of the tip of the highest rod over its length, 25 cm of hair from any root",
        highest,
        Limit::AtMost(-0.6),
    );
    finding.text(format!(
        "The linear beam's tip is {:.3} of its length above the steepest root, 25 cm of hair, as the paper says of Anjyo's \
         model. This is our reconstruction of that model, from memory, and no criterion depends on it.",
        ends[3].1
    ));
    Ok(())
}

/// Compares the threshold with Greenhill's and the shapes with the boundary-value problem.
fn exact(finding: &mut Finding) -> Result<(), Stopped> {
    let expected = threshold()?;
    // The length in metres at which an upright hair first leans.
    let (mut low, mut high) = (0.5 * expected, 2.0 * expected);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        let found = rest(&spec(middle, std::f64::consts::FRAC_PI_2)?)?;
        if found.tip().truncate().length() > 1e-3 * middle { high = middle } else { low = middle }
    }
    finding.text(format!(
        "An upright hair stands up to {:.3} cm; by Greenhill's formula up to {:.3} cm.",
        100.0 * low,
        100.0 * expected
    ));
    finding.check(
        "relative difference of the threshold length from Greenhill's",
        (low / expected - 1.0).abs(),
        Limit::AtMost(1e-4),
    );
    let mut worst = 0.0_f64;
    for rise in [0.0_f64, 30.0, 60.0, 80.0, 89.0] {
        for length in [0.03, 0.06, 0.12, 0.25] {
            let spec = spec(length, rise.to_radians())?;
            let reference = Hanging::new(&spec).solve()?;
            worst = larger(worst, reference.distance(line(&rest(&spec)?)));
        }
    }
    finding.check(
        "largest distance of lines from the boundary-value problem's over the length, 20 hairs, 1e-5 requested",
        worst,
        Limit::AtMost(1e-5),
    );
    Ok(())
}
