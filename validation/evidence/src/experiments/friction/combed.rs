//! What a combed head keeps when the comb lets go.

use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::{Comb, Direction, Operation};
use frisure::hairstyle::{
    Comb as Way, HairContact, Hairs, Hairstyle, HairstyleSpec, PredictOptions, StyleOptions,
    predict, preset, style,
};
use frisure::progress::Progress;
use frisure::rod::Equilibrium;

use crate::experiment::check;
use crate::extremes::{largest, smallest};
use crate::plot::{Mark, Plot, Scale};
use crate::{Effort, Finding, Limit, Stopped, Table};

/// Name of the experiment.
const NAME: &str = "friction";

/// Median over guides of how much of the way that the comb moved their tips is left.
fn kept(before: &Hairstyle, held: &Hairstyle, after: &Hairstyle) -> f64 {
    let tips = |h: &Hairstyle| h.equilibria().iter().map(Equilibrium::tip).collect::<Vec<_>>();
    let (before, held, after) = (tips(before), tips(held), tips(after));
    // Less than 5 mm is no way.
    let moved = (0..before.len()).filter(|&i| held[i].distance(before[i]) > 5e-3);
    let mut kept: Vec<f64> = moved
        .map(|i| {
            let way = held[i] - before[i];
            (after[i] - before[i]).dot(way) / way.length_squared()
        })
        .collect();
    kept.sort_by(f64::total_cmp);
    kept.get(kept.len() / 2).copied().unwrap_or(f64::NAN)
}

/// A head of straight hair on which a comb is tried.
fn described(wisps: usize, seed: u64) -> Result<HairstyleSpec, Stopped> {
    let preset = preset("caucasian-straight");
    let mut spec = preset.ok_or_else(|| Stopped::Other("no such preset".to_owned()))?.spec();
    spec.seed = seed;
    spec.wisps.count = wisps;
    spec.wisps.hairs = Hairs::Count(wisps);
    Ok(spec)
}

/// What a head keeps of the way of a comb.
fn combed_head(head: &Head, spec: &HairstyleSpec, progress: &dyn Progress) -> Result<f64, Stopped> {
    let other = |why: &dyn std::fmt::Display| Stopped::Other(why.to_string());
    let before = predict(spec, head, PredictOptions::default(), progress)?;
    let combed = |hold| {
        let towards = Direction::Named(Way::Back);
        let comb = Operation::Comb(Comb { towards, strength: 4.0, hold, ..Comb::default() });
        style(&before, head, &comb, StyleOptions::default(), progress).map_err(|e| other(&e))
    };
    Ok(kept(&before, &combed(true)?, &combed(false)?))
}

/// Adds what heads keep of a comb by friction on skin and between wisps.
pub(super) fn add(
    finding: &mut Finding,
    effort: Effort,
    progress: &dyn Progress,
) -> Result<(), Stopped> {
    let head = Head::mannequin();
    let mut found = Vec::new();
    let coefficients: &[f64] = effort.pick(&[0.0, 0.4], &[0.0, 0.1, 0.2, 0.4, 0.6]);
    // Which wisp comes to lie on which is chance: what one head keeps differs by some hundredths from what another does.
    let seeds: u64 = effort.pick(1, 6);
    for (k, &coefficient) in coefficients.iter().enumerate() {
        let mut kept = 0.0;
        for seed in 1..=seeds {
            let done = (k as f64 + (seed - 1) as f64 / seeds as f64) / coefficients.len() as f64;
            check(progress, NAME, 0.6 + 0.3 * done)?;
            let mut spec = described(40, seed)?;
            spec.contact.hair = HairContact::Wisps;
            (spec.contact.friction, spec.contact.skin_friction) = (coefficient, coefficient);
            kept += combed_head(&head, &spec, progress)? / seeds as f64;
        }
        found.push((coefficient, kept));
    }
    let mut table =
        Table::new("What a combed head keeps", &["μ", "share of the comb's way that is left"]);
    for (coefficient, kept) in &found {
        table.row([format!("{coefficient}"), format!("{:.1} %", 100.0 * kept)]);
    }
    finding.table(table);
    let mut plot = Plot::new(
        "Share of the way of a comb that 40 wisps of straight hair keep",
        "coefficient of friction",
        "share",
        [Scale::Linear; 2],
    );
    plot.add("", Mark::Both, found.iter().copied());
    finding.plot(plot);
    let rises = found.windows(2).map(|pair| pair[0].1 - pair[1].1);
    finding.check(
        "combed: share that is left without friction",
        found[0].1.abs(),
        // Of one head more by chance than of six.
        Limit::AtMost(effort.pick(0.1, 0.06)),
    );
    finding.check(
        "combed: largest fall of that share from one coefficient to the next",
        largest(rises),
        Limit::AtMost(0.0),
    );
    Ok(())
}

/// Adds what short hair keeps of a comb by friction inside wisps alone.
pub(super) fn add_locks(
    finding: &mut Finding,
    effort: Effort,
    progress: &dyn Progress,
) -> Result<(), Stopped> {
    let head = Head::mannequin();
    let coefficients: &[f64] = effort.pick(&[0.0, 0.4], &[0.0, 0.1, 0.2, 0.4, 0.6]);
    let (wisps, seeds) = effort.pick((40, 1), (150, 3));
    let mut table = Table::new(
        "What a combed head of short hair keeps by friction inside wisps alone",
        &["μ inside wisps", "share of the comb's way that is left"],
    );
    let mut found = Vec::new();
    for &coefficient in coefficients {
        check(progress, NAME, 0.9)?;
        let mut kept = 0.0;
        for seed in 1..=seeds {
            let mut spec = described(wisps, seed)?;
            spec.length.mean = 0.06;
            spec.contact.hair = HairContact::Layers;
            spec.contact.lock_friction = coefficient;
            kept += combed_head(&head, &spec, progress)? / seeds as f64;
        }
        table.row([format!("{coefficient}"), format!("{:.1} %", 100.0 * kept)]);
        found.push(kept);
    }
    finding.table(table);
    finding.check(
        "combed: share that is left without friction inside wisps",
        found[0].abs(),
        Limit::AtMost(1e-3),
    );
    finding.check(
        "combed: least rise of that share from one coefficient to the next",
        smallest(found.windows(2).map(|pair| pair[1] - pair[0])),
        Limit::AtLeast(0.0),
    );
    Ok(())
}
