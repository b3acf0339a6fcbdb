//! Figure 5: wet, cut, dry.

use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::{Dry, Operation};
use frisure::hairstyle::{
    Hairstyle, StrandOptions, StyleOptions, selected, settling_report, strands, style, volume,
};
use frisure::strands::Strands;

use super::scenes::{Hair, failed, strip};
use crate::experiment::check;
use crate::extremes::largest;
use crate::{Effort, Finding, Limit, Progress, Stopped, Table};

/// Mean height of the tips of some wisps (m).
fn tips(hairstyle: &Hairstyle, chosen: &[bool]) -> f64 {
    let rest = hairstyle.equilibria().iter().zip(chosen).filter(|(_, chosen)| **chosen);
    let heights: Vec<f64> = rest.map(|(guide, _)| guide.tip().z).collect();
    heights.iter().sum::<f64>() / heights.len() as f64
}

/// Largest distance between the tips of two states of the same wisps (m).
fn moved(a: &Hairstyle, b: &Hairstyle) -> f64 {
    let pairs = a.equilibria().iter().zip(b.equilibria());
    largest(pairs.map(|(a, b)| a.tip().distance(b.tip())))
}

pub(super) fn cut_wet(
    finding: &mut Finding,
    head: &Head,
    effort: Effort,
    progress: &dyn Progress,
) -> Result<(), Stopped> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/fringe-cut.toml"));
    let hair = Hair::of(text, &[], head, effort, progress)?;
    let mut states = vec![hair.hairstyle.clone()];
    let mut fringe = Vec::new();
    for (k, operation) in hair.scene.steps().iter().enumerate() {
        check(progress, "heads", 0.55 + 0.05 * k as f64)?;
        let before = &states[states.len() - 1];
        if let (Operation::Cut(_), Some(selection)) = (operation, operation.selection()) {
            fringe = selected(before, head, selection).map_err(|e| failed(progress, e))?;
        }
        let after = style(before, head, operation, StyleOptions::default(), progress)
            .map_err(|e| failed(progress, e))?;
        states.push(after);
    }
    let names = ["dry", "wet", "cut", "dry again"];
    let mut table = Table::new(
        "Wetted, its fringe cut, dried",
        &["state", "tips of the fringe, over the first (mm)", "volume (l)", "guides in a minimum"],
    );
    let start = tips(&states[0], &fringe);
    let (mut pictures, mut heights, mut volumes) = (Vec::new(), Vec::new(), Vec::new());
    let drawn = states
        .iter()
        .map(|state| Ok(strands(state, head, StrandOptions::default(), progress)?.strands));
    let drawn: Vec<Strands> = drawn.collect::<Result<_, Stopped>>()?;
    for (name, (state, strands)) in names.into_iter().zip(states.iter().zip(&drawn)) {
        let litres = 1e3 * volume(strands, head, state.grown()).region;
        let report = settling_report(state, head);
        let height = 1e3 * (tips(state, &fringe) - start);
        table.row([
            name.to_owned(),
            format!("{height:+.1}"),
            format!("{litres:.2}"),
            format!("{} of {}", report.stable, report.guides),
        ]);
        heights.push(height);
        volumes.push(litres);
        // Wet hair extends farthest.
        let hair = Hair { scene: hair.scene.clone(), hairstyle: state.clone() };
        pictures.push(hair.picture(strands, &drawn[1], Some(head), None, progress)?);
    }
    finding.picture(strip(
        "figure-5",
        "Figure 5: dry, wet, its fringe cut while wet, dry again.",
        &pictures,
    )?);
    finding.table(table);
    let dried = Operation::Dry(Dry::default());
    let back = style(&states[1], head, &dried, StyleOptions::default(), progress)
        .map_err(|e| failed(progress, e))?;
    finding.check(
        "drop of the fringe when it is wetted (mm)",
        heights[0] - heights[1],
        Limit::AtLeast(10.0),
    );
    finding.check(
        "rise of the cut fringe when it is dried (mm)",
        heights[3] - heights[2],
        Limit::AtLeast(10.0),
    );
    finding.check("volume wet over dry", volumes[1] / volumes[0], Limit::AtMost(0.95));
    finding.check(
        "largest displacement of a tip, wetted and dried without a cut (mm): by construction",
        1e3 * moved(&states[0], &back),
        Limit::AtMost(0.0),
    );
    Ok(())
}
