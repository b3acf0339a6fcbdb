//! One head: computed, and measured.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use frisure::files::Files;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{
    Cancelled, Hairstyle, Monitor, StrandOptions, StyleOptions, guide_strands, settling_report,
    strands, style, volume,
};
use frisure::scene::batch::{Batch, Sample, Value};
use frisure::scene::edit::EditError;
use frisure::scene::{Scene, SceneError};
use frisure_stylist::carry;

use crate::heads::Heads;

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

/// Why a head was not computed.
enum Stop {
    Cancelled,
    Refused(String),
}

impl From<Cancelled> for Stop {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<SceneError> for Stop {
    fn from(error: SceneError) -> Self {
        Self::Refused(match error {
            SceneError::Fault(fault) => {
                let place = format!("line {}: {}", fault.line, fault.message());
                if fault.hint.is_empty() { place } else { format!("{place} ({})", fault.hint) }
            }
            error => error.to_string(),
        })
    }
}

impl From<Option<SceneError>> for Stop {
    fn from(error: Option<SceneError>) -> Self {
        error.map_or(Self::Cancelled, Self::from)
    }
}

/// Passes on that the work is to stop, and no progress: that of one head of many tells nobody anything.
struct Quietly<'a>(&'a dyn Monitor);

impl Monitor for Quietly<'_> {
    fn progress(&self, _stage: &'static str, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// Makes the head that the hair of a number grows on, before all threads need it at once.
pub(crate) fn prepare(batch: &Batch, heads: &Heads, index: usize) {
    if let Ok(text) = batch.sample(index).text
        && let Ok(scene) = Scene::parse("scene", text, batch.folder())
    {
        // What is wrong with it is told by every row.
        let _ = heads.of(&scene);
    }
}

/// Computes the head of a number.
pub(crate) fn row(
    batch: &Batch,
    heads: &Heads,
    index: usize,
    monitor: &dyn Monitor,
) -> Result<Row, Cancelled> {
    let Sample { index, seed, values, text } = batch.sample(index);
    let (scene, measured) = match text {
        Ok(text) => {
            let work = || measured(batch, heads, &text, &Quietly(monitor));
            let done = catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|e| Err(broken(&*e)));
            (Some(text), done)
        }
        Err(EditError::Scene(error)) => (None, Err(error.into())),
        Err(error) => (None, Err(Stop::Refused(error.to_string()))),
    };
    let outcome = match measured {
        Ok(measured) => Ok(measured),
        Err(Stop::Refused(why)) => Err(why),
        Err(Stop::Cancelled) => return Err(Cancelled),
    };
    Ok(Row { index, seed, values, scene, outcome })
}

/// An error of ours, which must not take the batch with it.
fn broken(panic: &(dyn Any + Send)) -> Stop {
    let message = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let message = message.or_else(|| panic.downcast_ref::<String>().cloned());
    Stop::Refused(format!("internal error: {}", message.unwrap_or_default()))
}

fn measured(
    batch: &Batch,
    heads: &Heads,
    text: &str,
    monitor: &dyn Monitor,
) -> Result<Measured, Stop> {
    let scene = Scene::parse("scene", text, batch.folder())?;
    let spec = scene.hairstyle_spec()?;
    let head = heads.of(&scene)?;
    let (start, _) = carry::beginning(&scene, &spec, &head, &Files::default(), monitor)?;
    let styled = styled(&scene, &head, start, monitor)?;
    numbers(batch, &styled, &head, monitor)
}

/// The hair after every step of its scene.
fn styled(
    scene: &Scene,
    head: &Head,
    start: Hairstyle,
    monitor: &dyn Monitor,
) -> Result<Hairstyle, Stop> {
    scene.steps().iter().enumerate().try_fold(start, |hair, (index, operation)| {
        let after = style(&hair, head, operation, StyleOptions::default(), monitor);
        after.map_err(|error| carry::not_done(index, &error, scene).into())
    })
}

fn numbers(
    batch: &Batch,
    hairstyle: &Hairstyle,
    head: &Head,
    monitor: &dyn Monitor,
) -> Result<Measured, Stop> {
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
        volume: batch.volume().then(|| space(hairstyle, head, monitor)).transpose()?,
        points: points.max(2),
        lines: lines.points().iter().flat_map(|p| [p.x, p.y, p.z]).collect(),
    })
}

/// The space that the hair takes, by some of its hairs.
fn space(hairstyle: &Hairstyle, head: &Head, monitor: &dyn Monitor) -> Result<[f64; 2], Cancelled> {
    let stride = hairstyle.drawn().div_ceil(HAIRS).max(1);
    let options = StrandOptions { stride, ..StrandOptions::default() };
    let some = strands(hairstyle, head, options, monitor)?.strands;
    let found = volume(&some, head, hairstyle.grown());
    Ok([found.region, found.hair])
}
