//! Figure 4: a hair on a sphere, and heads with and without collisions.

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{penetration, settling_report};
use frisure::rod::potential::FieldPotential;
use frisure::rod::{
    Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, Stability, TorsionConstant,
    equilibrium,
};
use glam::DVec3;

use super::scenes::{Hair, strip};
use crate::experiment::check;
use crate::experiments::sphere::Sphere;
use crate::extremes::largest;
use crate::plot::{Mark, Plot, Scale};
use crate::rods::to_accuracy;
use crate::{Effort, Finding, Limit, Progress, Stopped, Table};

/// A curly hair on a sphere, with and without contact.
pub(super) fn on_a_sphere(finding: &mut Finding) -> Result<(), Stopped> {
    let sphere = Sphere { middle: DVec3::ZERO, radius: 0.08, stiffness: 2000.0 };
    let up = DVec3::new(0.15, 0.0, 0.99).normalize();
    let rod = Rod::new(RodSpec {
        length: 0.28,
        section: Section::from_diameter(72e-6, 1.5)?,
        material: Material::new(3.9e9, 0.9e9, 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.010, 0.024)?,
        root: Root::from_tangent(
            up * (sphere.radius + 1e-4),
            DVec3::new(0.8, -0.1, 0.5),
            DVec3::Y,
        )?,
        load: Load::down(9.81),
    })?;
    let mut plot = Plot::new("Figure 4: a curly hair and a sphere", "cm", "cm", [Scale::Linear; 2]);
    plot.equal = true;
    plot.size = [560.0, 460.0];
    let round = (0..=90).map(|k| {
        let angle = f64::from(k) * 4.0_f64.to_radians();
        (100.0 * sphere.radius * angle.cos(), 100.0 * sphere.radius * angle.sin())
    });
    plot.add("", Mark::Line, round).colour = Some(6);
    let field = FieldPotential::new(&sphere, 4);
    let mut depths = [0.0; 2];
    let mut stable = true;
    for (k, (name, contact)) in [("through it", false), ("on it", true)].into_iter().enumerate() {
        let options = to_accuracy(&rod, 1e-3);
        let found = match contact {
            true => equilibrium(&rod, &[&field], &options),
            false => equilibrium(&rod, &[], &options),
        };
        stable &= found.certificate.stability == Stability::Stable;
        let line = found.centre_line(2000);
        depths[k] =
            largest(line.iter().map(|p| sphere.radius - p.length())).clamp(0.0, f64::INFINITY);
        plot.add(name, Mark::Line, line.iter().map(|p| (100.0 * p.x, 100.0 * p.z))).colour =
            Some(1 - k);
    }
    finding.plot(plot);
    finding.text(format!(
        "Without contact the depth of the hair in the sphere is {:.1} mm, with contact {:.4} mm.",
        1e3 * depths[0],
        1e3 * depths[1]
    ));
    finding.check("depth of a curly hair in a sphere (mm)", 1e3 * depths[1], Limit::AtMost(0.1));
    finding.check(
        "both hairs in a minimum (1 if so)",
        f64::from(u8::from(stable)),
        Limit::AtLeast(1.0),
    );
    Ok(())
}

/// A head without collisions, with the head alone, and with everything.
pub(super) fn on_heads(
    finding: &mut Finding,
    head: &Head,
    effort: Effort,
    progress: &dyn Progress,
) -> Result<(), Stopped> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/collisions.toml"));
    let ways: [(&str, &[(&str, &str)]); 4] = [
        ("none", &[("contact.body", "\"none\""), ("contact.hair", "\"none\"")]),
        ("head", &[("contact.hair", "\"none\"")]),
        ("head and wisps", &[]),
        ("head and layers (the paper's)", &[("contact.hair", "\"layers\"")]),
    ];
    let mut table = Table::new(
        "Collisions",
        &[
            "collisions",
            "volume (l)",
            "deepest guide (mm)",
            "deepest drawn hair (mm)",
            "guides in a minimum",
        ],
    );
    let (mut pictures, mut volumes, mut deepest) = (Vec::new(), Vec::new(), Vec::new());
    for (k, (name, changes)) in ways.into_iter().take(effort.pick(3, 4)).enumerate() {
        check(progress, "heads", 0.2 + 0.08 * k as f64)?;
        let hair = Hair::of(text, changes, head, effort, progress)?;
        let strands = hair.strands(head, progress)?;
        let litres = 1e3 * hair.volume(&strands, head).region;
        let report = settling_report(&hair.hairstyle, head);
        let depth = 1e3 * penetration(&strands, head);
        table.row([
            name.to_owned(),
            format!("{litres:.2}"),
            format!("{:.2}", 1e3 * report.penetration),
            format!("{depth:.2}"),
            format!("{} of {}", report.stable, report.guides),
        ]);
        volumes.push(litres);
        deepest.push(1e3 * report.penetration);
        if k < 3 {
            pictures.push(hair.picture(&strands, &strands, Some(head), None, progress)?);
        }
    }
    finding.picture(strip(
        "figure-4",
        "Figure 4: no collisions at all, collisions with the head, and with the head and between wisps.",
        &pictures,
    )?);
    finding.table(table);
    finding.check(
        "volume with all collisions over that with those with the head alone",
        volumes[2] / volumes[1],
        Limit::AtLeast(1.1),
    );
    finding.check(
        "largest depth of a guide in the head with all collisions (mm)",
        deepest[2],
        Limit::AtMost(0.5),
    );
    finding.check(
        "largest depth of a guide in the head with none (mm)",
        deepest[0],
        Limit::AtLeast(5.0),
    );
    Ok(())
}
