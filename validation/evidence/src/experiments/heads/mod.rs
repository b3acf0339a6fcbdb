//! Figures 1, 4, 5 and 7 of the paper: whole heads.

mod collisions;
mod scenes;
mod sentences;
mod styled;

use std::sync::OnceLock;

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{guide_strands, settling_report};
use frisure::strands::Strands;

use crate::experiment::check;
use crate::extremes::{larger, smallest};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped, Table};
use scenes::{Hair, strip};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "heads",
    title: "Figures 1, 4, 5 and 7: wisps and heads",
    question: "Do whole heads show the effects of the paper: a head of ringlets from about a hundred wisps, volume from \
        collisions, a fringe that springs up when it is cut wet and dried, and straight, curly and frizzy hair?",
    method: "The heads are the scenes of the repository (`scenes/`), on its mannequin, drawn by the quick renderer. The \
        experiment measures the number of guides in equilibrium; the depth of hair in the head; the volume of the region that hair occupies, air included; \
        heights of tips. There is no independent reference for a head; the criteria are the paper's own sentences, which the first table \
        quotes. Three of them are weaker than they seem. That wet hair takes less space follows mostly from an \
        input: wetting multiplies the thickness of a wisp by 0.6, which is the paper's number. The density of straight, curly and frizzy \
        hair also depends on settings of the scenes, such as the thickness of wisps. And hair dried without a \
        cut returns to the last bit by construction: in this model a shape follows from the properties of a hair, not from its \
        history, while real hair keeps the set from water. The pictures have no criteria.",
    run,
};

/// The mannequin, made once because its distance field takes seconds.
pub(super) fn mannequin() -> &'static Head {
    static HEAD: OnceLock<Head> = OnceLock::new();
    HEAD.get_or_init(Head::mannequin)
}

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    progress.report("heads", 0.0);
    let head = mannequin();
    finding.table(sentences::table());
    figure_1(&mut finding, head, effort, progress)?;
    collisions::on_a_sphere(&mut finding)?;
    collisions::on_heads(&mut finding, head, effort, progress)?;
    styled::cut_wet(&mut finding, head, effort, progress)?;
    figure_7(&mut finding, head, effort, progress)?;
    Ok(finding)
}

/// Figure 1: a hair, its wisp, the head.
fn figure_1(
    finding: &mut Finding,
    head: &Head,
    effort: Effort,
    progress: &dyn Progress,
) -> Result<(), Stopped> {
    let hair = Hair::of(
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/ringlets.toml")),
        &[],
        head,
        effort,
        progress,
    )?;
    let strands = hair.strands(head, progress)?;
    // The wisp whose tip hangs lowest.
    let rest = hair.hairstyle.equilibria();
    let lowest = (0..rest.len()).min_by(|&a, &b| rest[a].tip().z.total_cmp(&rest[b].tip().z));
    let chosen = lowest.unwrap_or(0);
    let mut one = Strands::new();
    let guides = guide_strands(&hair.hairstyle, 200);
    one.push(guides.strand(chosen).points, guides.strand(chosen).radii);
    let wisp = scenes::wisp(&strands, chosen as u32);
    let pictures = [
        hair.picture(&one, &wisp, None, Some(9.0), progress)?,
        hair.picture(&wisp, &wisp, None, Some(2.5), progress)?,
        hair.picture(&strands, &strands, Some(head), None, progress)?,
    ];
    finding.picture(strip(
        "figure-1",
        "Figure 1: a hair, the wisp around it, and a head of such wisps.",
        &pictures,
    )?);
    let report = settling_report(&hair.hairstyle, head);
    finding.text(format!(
        "The head has {} wisps and {} drawn hairs; its guides have {} elements in total.",
        report.guides,
        strands.len(),
        report.elements
    ));
    finding.check(
        "share of the guides of figure 1 in a minimum",
        report.stable as f64 / report.guides as f64,
        Limit::AtLeast(1.0),
    );
    Ok(())
}

/// Compares the descent and the density of hair from straight to frizzy.
fn check_order(finding: &mut Finding, drops: &[f64], fills: &[f64]) {
    let falls = |x: &[f64]| x.windows(2).all(|p| p[1] < p[0]);
    finding.check(
        "hair hangs less and less from straight to curly to frizzy (1 if so)",
        f64::from(u8::from(falls(drops))),
        Limit::AtLeast(1.0),
    );
    finding.check(
        "hair is looser and looser packed from straight to curly to frizzy (1 if so)",
        f64::from(u8::from(falls(fills))),
        Limit::AtLeast(1.0),
    );
}

/// Figure 7: straight, curly, frizzy.
fn figure_7(
    finding: &mut Finding,
    head: &Head,
    effort: Effort,
    progress: &dyn Progress,
) -> Result<(), Stopped> {
    let scenes = [
        ("straight", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/straight.toml"))),
        ("curly", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/curly.toml"))),
        ("frizzy", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/frizzy.toml"))),
    ];
    let mut table = Table::new(
        "Straight, curly and frizzy heads",
        &[
            "hair",
            "guides",
            "in a minimum",
            "length (cm)",
            "tip below root over length",
            "volume (l)",
            "hair in it",
            "deepest guide (mm)",
        ],
    );
    let (mut pictures, mut fills, mut drops) = (Vec::new(), Vec::new(), Vec::new());
    let (mut stable, mut deepest) = (1.0_f64, 0.0_f64);
    for (k, (name, text)) in scenes.into_iter().enumerate() {
        check(progress, "heads", 0.75 + 0.08 * k as f64)?;
        let hair = Hair::of(text, &[], head, effort, progress)?;
        let strands = hair.strands(head, progress)?;
        let volume = hair.volume(&strands, head);
        let report = settling_report(&hair.hairstyle, head);
        let rest = hair.hairstyle.equilibria();
        let n = rest.len() as f64;
        let drop = rest
            .iter()
            .map(|e| (e.rod.root().position().z - e.tip().z) / e.rod.length())
            .sum::<f64>()
            / n;
        let length = rest.iter().map(|e| e.rod.length()).sum::<f64>() / n;
        table.row([
            name.to_owned(),
            report.guides.to_string(),
            report.stable.to_string(),
            format!("{:.1}", 100.0 * length),
            format!("{drop:.3}"),
            format!("{:.2}", 1e3 * volume.region),
            format!("{:.1} %", 100.0 * volume.hair / volume.region),
            format!("{:.3}", 1e3 * report.penetration),
        ]);
        fills.push(volume.hair / volume.region);
        drops.push(drop);
        stable = smallest([stable, report.stable as f64 / report.guides as f64]);
        deepest = larger(deepest, report.penetration);
        pictures.push(hair.picture(&strands, &strands, Some(head), None, progress)?);
    }
    finding.picture(strip("figure-7", "Figure 7: straight, curly and frizzy hair.", &pictures)?);
    finding.table(table);
    check_order(finding, &drops, &fills);
    finding.check(
        "smallest share of the guides of figure 7 in a minimum",
        stable,
        Limit::AtLeast(0.99),
    );
    finding.check(
        "largest depth of a guide of figure 7 in the head (mm)",
        1e3 * deepest,
        Limit::AtMost(0.5),
    );
    Ok(())
}
