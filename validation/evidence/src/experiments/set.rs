//! A water set in air of rising humidity, beside a measured one.

use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::{Humidity, Operation, Release, Roll, Selection};
use frisure::hairstyle::{
    Body, Curl, Guide, HairContact, Hairs, Hairstyle, HairstyleSpec, PredictOptions, StyleOptions,
    predict, preset, style,
};
use frisure::progress::Progress;

use crate::experiment::check;
use crate::extremes::largest;
use crate::finding::{Finding, Limit, Table};
use crate::plot::{Mark, Plot, Scale};
use crate::{Effort, Experiment, Stopped};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "set",
    title: "What a water set keeps",
    question: "How much of the curvature of a roller does hair keep that was dried on it, and how does its curl fall in damp air?",
    method: "Straight hair of 20 cm is wetted, wound on a roller of 1 cm radius, dried in air of 20 % relative humidity, released, \
             and left in ever damper air. Bending set is its natural curvature over that of the roller, B(t)/B(0); curl \
             retention is (L − l)/(L − l₀), with the height l of the hanging curl, l₀ that at the release, and the length L.\n\n\
             Measured, read in a page of TRI Princeton's *Practical Modern Hair Science*: a helical coil of hair, set from water and dried overnight at \
             20 %, then hung at 40 %, had a bending set of about 58 % after 30 minutes and of about 52 % after eight hours. \
             Retention in damper air has been published too, but no table of it was at hand: there the law (a set loses the share \
             that hair swells on its way from room air to water) is compared with nothing, and only its ends are known: nothing is left in water.",
    run,
};

/// Radius of the roller (m).
const ROLLER: f64 = 0.01;

/// What was measured at 40 %: after half an hour, and after eight.
const MEASURED: [f64; 2] = [0.58, 0.52];

fn straight_hair() -> Result<HairstyleSpec, Stopped> {
    let preset = preset("caucasian-straight");
    let mut spec = preset.ok_or_else(|| Stopped::Other("no such preset".to_owned()))?.spec();
    spec.curl = Curl::STRAIGHT;
    (spec.length.mean, spec.length.variation_between) = (0.20, 0.0);
    (spec.wisps.count, spec.wisps.hairs) = (8, Hairs::Count(8));
    (spec.contact.body, spec.contact.hair) = (Body::None, HairContact::None);
    Ok(spec)
}

/// Mean natural curvature of hairs over that of the roller.
fn bending_set(hair: &Hairstyle) -> f64 {
    let of = |g: &Guide| {
        let at = |k| g.rod.natural().at(g.rod.length() * f64::from(k) / 50.0).truncate().length();
        (5..=45).map(at).sum::<f64>() / 41.0
    };
    // The roller's helix: r/(r² + c²), c its pitch over 2π.
    let pitch = Roll::default().pitch / std::f64::consts::TAU;
    let roller = ROLLER / (ROLLER * ROLLER + pitch * pitch);
    hair.guides().iter().map(of).sum::<f64>() / (hair.guides().len() as f64 * roller)
}

/// Mean height (m) of hanging hairs.
fn height(hair: &Hairstyle) -> f64 {
    let drop = |(guide, rest): (&Guide, &frisure::rod::Equilibrium)| {
        (guide.root.position - rest.tip()).dot(glam::DVec3::Z)
    };
    let sum: f64 = hair.guides().iter().zip(hair.equilibria()).map(drop).sum();
    sum / hair.guides().len() as f64
}

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    let head = Head::mannequin();
    let done = |hair: &Hairstyle, operation: Operation| {
        check(progress, EXPERIMENT.name, 0.1)?;
        style(hair, &head, &operation, StyleOptions::default(), progress)
            .map_err(|e| Stopped::Other(e.to_string()))
    };
    let air = |relative: f64| Operation::Humidity(Humidity { relative });
    let start = predict(&straight_hair()?, &head, PredictOptions::default(), progress)?;
    let steps = [
        air(0.2),
        Operation::Wet(Default::default()),
        Operation::Roll(Roll { radius: ROLLER, ..Roll::default() }),
        Operation::Dry(Default::default()),
        Operation::Release(Release { selection: Selection::Everything }),
    ];
    let mut hair = start;
    for step in steps {
        hair = done(&hair, step)?;
    }
    let (length, first) = (0.20, height(&hair));
    let humidities: &[f64] =
        effort.pick(&[0.4, 0.9, 1.0], &[0.2, 0.4, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 1.0]);
    let mut table = Table::new(
        "A set in ever damper air",
        &["relative humidity", "bending set", "height of the curl (mm)", "curl retention"],
    );
    let (mut sets, mut retained) = (Vec::new(), Vec::new());
    for &relative in humidities {
        hair = done(&hair, air(relative))?;
        let (set, height) = (bending_set(&hair), height(&hair));
        let retention = (length - height) / (length - first);
        table.row([
            format!("{:.0} %", 100.0 * relative),
            format!("{set:.3}"),
            format!("{:.1}", 1e3 * height),
            format!("{retention:.3}"),
        ]);
        sets.push((relative, set));
        retained.push((relative, retention));
    }
    finding.table(table);
    let mut plot = Plot::new(
        "A water set in ever damper air",
        "relative humidity",
        "share that is left",
        [Scale::Linear; 2],
    );
    plot.add("bending set", Mark::Both, sets.iter().copied());
    plot.add("curl retention", Mark::Both, retained.iter().copied());
    plot.add("bending set, measured", Mark::Points, MEASURED.map(|set| (0.4, set)));
    finding.plot(plot);
    let at_40 = sets.iter().find(|(relative, _)| *relative == 0.4).map_or(f64::NAN, |s| s.1);
    finding.check(
        "bending set at 40 %: distance from the measured range of 0.52 to 0.58",
        (at_40 - MEASURED[0]).max(MEASURED[1] - at_40).max(0.0),
        Limit::AtMost(0.03),
    );
    let rises = |values: &[(f64, f64)]| largest(values.windows(2).map(|p| p[1].1 - p[0].1));
    finding.check("largest rise of the set in damper air", rises(&sets), Limit::AtMost(1e-9));
    // Curls get a little higher as hair softens: only the fall counts beyond that.
    finding.check("largest rise of the retention", rises(&retained), Limit::AtMost(0.0));
    finding.check("set left in saturated air", sets[sets.len() - 1].1, Limit::AtMost(1e-6));
    Ok(finding)
}
