//! One head of a batch: computed and measured.

use std::sync::Arc;

use frisure::files::Files;
use frisure::hairstyle::{StrandOptions, guide_strands, volume};
use frisure::progress::{Cancelled, Progress, Silent};
use frisure::scene::batch::{Batch, Sample};
use frisure::scene::edit::EditError;
use frisure::scene::{Scene, SceneError};
use frisure_engine::{Error, HeadCache, LoadedScene, Quality, Runner, catch_panic};

use crate::row::{Measured, Row};
use crate::view;

/// Most hairs that are drawn to measure the space of all; chosen.
const HAIRS: usize = 10_000;

/// The message of an error in a row: with the line of the scene and the hint.
fn message(error: &Error) -> String {
    match error {
        Error::Scene(SceneError::Invalid(found)) => {
            let place = format!("line {}: {}", found.line, found.message());
            if found.hint.is_empty() { place } else { format!("{place} ({})", found.hint) }
        }
        error => error.to_string(),
    }
}

/// Loads the head of a row into the cache, before all threads need it at once.
pub(crate) fn load_head(batch: &Batch, heads: &HeadCache, index: usize) {
    if let Ok(text) = batch.sample(index).text
        && let Ok(scene) = Scene::parse("scene", text, batch.folder())
    {
        // Every row reports what is wrong with it.
        let _ = heads.load(&scene, &Files::default());
    }
}

/// Computes the row at an index.
pub(crate) fn row(
    batch: &Batch,
    heads: &Arc<HeadCache>,
    index: usize,
    progress: &dyn Progress,
) -> Result<Row, Cancelled> {
    let Sample { index, seed, values, text } = batch.sample(index);
    let (scene, measured) = match text {
        Ok(text) => {
            let measured = catch_panic(|| measured(batch, heads, index, &text, &Silent(progress)));
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
    heads: &Arc<HeadCache>,
    index: usize,
    text: &str,
    progress: &dyn Progress,
) -> Result<Measured, Error> {
    let scene = Arc::new(Scene::parse("scene", text, batch.folder())?);
    let steps = scene.steps().len();
    // So many heads are computed at the same time.
    let mut runner = Runner::new(heads.clone()).among(rayon::current_num_threads());
    let loaded = runner.load(&scene, steps, Quality::Exact, progress)?;
    let points = batch.points().unwrap_or(loaded.hairstyle.spec().wisps.points);
    let lines = guide_strands(&loaded.hairstyle, points);
    Ok(Measured {
        metrics: loaded.metrics(),
        volume: batch.volume().then(|| space(&loaded, progress)).transpose()?,
        points: points.max(2),
        lines: lines.points().iter().flat_map(|p| [p.x, p.y, p.z]).collect(),
        views: view::views(batch, index, &loaded, progress)?,
    })
}

/// The space that the hair takes, by some of its hairs.
fn space(loaded: &LoadedScene, progress: &dyn Progress) -> Result<[f64; 2], Error> {
    let stride = loaded.hairstyle.drawn().div_ceil(HAIRS).max(1);
    let options = StrandOptions { stride, ..StrandOptions::default() };
    let some = loaded.draw(options, progress)?.strands;
    let found = volume(&some, &loaded.head, loaded.hairstyle.grown());
    Ok([found.region, found.hair])
}
