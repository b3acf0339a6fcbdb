//! One head: computed, and measured.

use frisure::files::Files;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{
    Hairstyle, StrandOptions, StyleOptions, guide_strands, settling_report, strands, style, volume,
};
use frisure::progress::{Cancelled, Progress, Silent};
use frisure::scene::batch::{Batch, Sample, Value};
use frisure::scene::edit::EditError;
use frisure::scene::{Scene, SceneError};
use frisure_engine::{Error, HeadCache, LoadedHead, catch_panic, initial_hairstyle};

/// Hairs that are drawn at most to measure the space that all take.
const HAIRS: usize = 10_000;

/// A head of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its number in the batch.
    pub index: usize,
    /// What drives the randomness of its scene.
    pub seed: u64,
    /// What it has of each of [`Batch::parameters`]; SI units.
    pub values: Vec<Value>,
    /// The text of its scene, if there is one.
    pub scene: Option<String>,
    /// What was computed, or why nothing was.
    pub outcome: Result<Measured, String>,
}

/// What was computed of a head; SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Guides, and how many of them are at rest, on a saddle, and have not converged.
    pub guides: [usize; 4],
    /// Mean length of the guides along the fibre (m).
    pub length: f64,
    /// Mean height of roots over tips, each over the length of its guide: 1 hangs straight down.
    pub drop: f64,
    /// Deepest that a guide is inside the head (m).
    pub penetration: f64,
    /// Elastic energy, that of gravity and that of contact, of all guides (J).
    pub energy: [f64; 3],
    /// Mass of all hair that grows on the head, with the water in it (kg).
    pub mass: f64,
    /// Space that the hair takes, air included, and that of the fibres themselves (m³), if it was measured.
    pub volume: Option<[f64; 2]>,
    /// Points of each guide.
    pub points: usize,
    /// The points of all guides from root to tip, evenly spaced: x, y, z (m).
    pub lines: Vec<f32>,
}

/// The message of an error in a row: with the line of the scene and the hint.
fn message(error: &Error) -> String {
    match error {
        Error::Scene(SceneError::Fault(fault)) => {
            let place = format!("line {}: {}", fault.line, fault.message());
            if fault.hint.is_empty() { place } else { format!("{place} ({})", fault.hint) }
        }
        error => error.to_string(),
    }
}

/// Makes the head that the hair of a number grows on, before all threads need it at once.
pub(crate) fn prepare(batch: &Batch, heads: &HeadCache, index: usize) {
    if let Ok(text) = batch.sample(index).text
        && let Ok(scene) = Scene::parse("scene", text, batch.folder())
    {
        // What is wrong with it is told by every row.
        let _ = heads.load(&scene, &Files::default());
    }
}

/// Computes the head of a number.
pub(crate) fn row(
    batch: &Batch,
    heads: &HeadCache,
    index: usize,
    progress: &dyn Progress,
) -> Result<Row, Cancelled> {
    let Sample { index, seed, values, text } = batch.sample(index);
    let (scene, measured) = match text {
        Ok(text) => {
            let measured = catch_panic(|| measured(batch, heads, &text, &Silent(progress)));
            (Some(text), measured)
        }
        Err(EditError::Scene(error)) => (None, Err(error.into())),
        Err(error) => (None, Err(Error::because(&error, ""))),
    };
    let outcome = match measured {
        Ok(measured) => Ok(measured),
        Err(Error::Cancelled(cancelled)) => return Err(cancelled),
        Err(error) => Err(message(&error)),
    };
    Ok(Row { index, seed, values, scene, outcome })
}

fn measured(
    batch: &Batch,
    heads: &HeadCache,
    text: &str,
    progress: &dyn Progress,
) -> Result<Measured, Error> {
    let scene = Scene::parse("scene", text, batch.folder())?;
    let spec = scene.hairstyle_spec()?;
    let files = Files::default();
    let LoadedHead { head, .. } = heads.load(&scene, &files)?;
    let (start, _) = initial_hairstyle(&scene, &spec, &head, &files, progress)?;
    let styled = styled(&scene, &head, start, progress)?;
    Ok(numbers(batch, &styled, &head, progress)?)
}

/// The hair after every step of its scene.
fn styled(
    scene: &Scene,
    head: &Head,
    start: Hairstyle,
    progress: &dyn Progress,
) -> Result<Hairstyle, Error> {
    scene.steps().iter().enumerate().try_fold(start, |hair, (index, operation)| {
        let after = style(&hair, head, operation, StyleOptions::default(), progress);
        after.map_err(|error| Error::of_step(index, &error, scene))
    })
}

fn numbers(
    batch: &Batch,
    hairstyle: &Hairstyle,
    head: &Head,
    progress: &dyn Progress,
) -> Result<Measured, Cancelled> {
    let report = settling_report(hairstyle, head);
    let mean = |of: &dyn Fn(usize) -> f64| {
        let count = hairstyle.guides().len();
        (0..count).map(of).sum::<f64>() / count.max(1) as f64
    };
    let length = |i: usize| hairstyle.guides()[i].rod.length();
    let fall = |i: usize| {
        let rest = &hairstyle.equilibria()[i];
        (rest.rod.root().position().z - rest.tip().z) / length(i)
    };
    let points = batch.points().unwrap_or(hairstyle.spec().wisps.points);
    let lines = guide_strands(hairstyle, points);
    Ok(Measured {
        guides: [report.guides, report.stable, report.saddles, report.not_converged],
        length: mean(&length),
        drop: mean(&fall),
        penetration: report.penetration,
        energy: [report.energy.elastic, report.energy.gravity, report.energy.external],
        mass: hairstyle.mass(),
        volume: batch.volume().then(|| space(hairstyle, head, progress)).transpose()?,
        points: points.max(2),
        lines: lines.points().iter().flat_map(|p| [p.x, p.y, p.z]).collect(),
    })
}

/// The space that the hair takes, by some of its hairs.
fn space(
    hairstyle: &Hairstyle,
    head: &Head,
    progress: &dyn Progress,
) -> Result<[f64; 2], Cancelled> {
    let stride = hairstyle.drawn().div_ceil(HAIRS).max(1);
    let options = StrandOptions { stride, ..StrandOptions::default() };
    let some = strands(hairstyle, head, options, progress)?.strands;
    let found = volume(&some, head, hairstyle.grown());
    Ok([found.region, found.hair])
}
