//! `frisure batch`: many heads of one scene as Parquet.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure::progress::Progress;
use frisure::scene::SceneError;
use frisure::scene::batch::Views;
use frisure::scene::edit::EditError;
use frisure_batch::{Batch as Heads, Row, Run, Sample, Shard, Value};
use frisure_engine::Error;
use frisure_engine::report::status;

use crate::args::Batch;
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, interrupt, outputs};

/// Rows of a list that are printed at once; chosen.
const LISTED: usize = 256;

/// Computes a shard of a batch, lists it, or prints the scene of one head.
pub(crate) fn run(arguments: &Batch, quiet: bool) -> Result<ExitStatus, Error> {
    let heads = Heads::read(&arguments.spec)?;
    if let Some(index) = arguments.scene {
        return one_scene(arguments, &heads, index);
    }
    if arguments.list {
        return list(&heads, arguments.shard);
    }
    let Some(folder) = &arguments.output else {
        let hint = "`-o DIR` names the folder; `--list` prints the heads without computing them";
        return Err(Error::invalid("there is no folder to write to", hint));
    };
    compute(heads, folder, arguments.shard, quiet)
}

/// Computes and writes the missing parts of a shard.
fn compute(heads: Heads, folder: &Path, shard: Shard, quiet: bool) -> Result<ExitStatus, Error> {
    let all = heads.heads();
    let run = Run::new(heads, folder, shard)?;
    let missing = run.missing()?;
    let own = run.parts().map(|part| part.heads).sum::<usize>();
    let to_do = missing.iter().map(|part| part.heads).sum::<usize>();
    let before = own - to_do;
    if !quiet {
        console::say(&header(run.batch().views(), shard, own, all, before))?;
    }
    let progress = Bar::new(quiet);
    let done = AtomicUsize::new(0);
    let each = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.report("heads", done as f64 / to_do as f64);
    };
    progress.report("heads", 0.0);
    let mut totals = Totals::default();
    for (place, part) in missing.iter().enumerate() {
        interrupt::set_resume(Some(format!(
            "{} of {own} heads are in `{}`; the same command resumes",
            before + totals.heads,
            folder.display()
        )));
        let rows = run.compute(*part, &progress, &each)?;
        let path = interrupt::writing(|| run.write(*part, &rows))?;
        totals.add(&rows);
        let (parts, failed) = (missing.len(), failures(&rows));
        let line = format!("{} of {parts}: {}{failed}\n", place + 1, console::shown(&path));
        progress.suspend(|| if quiet { Ok(()) } else { console::say(&line) })?;
    }
    drop(progress);
    if !quiet {
        console::say(&totals.summary(own))?;
    }
    Ok(ExitStatus::Success)
}

/// A line about the work before it begins.
fn header(views: Option<&Views>, shard: Shard, own: usize, all: usize, before: usize) -> String {
    let mut out = match shard {
        Shard::WHOLE => format!("{all} heads"),
        shard => format!("shard {shard}: {own} of {all} heads"),
    };
    if let Some(Views { cameras, width, height, .. }) = views {
        let _ = write!(out, " with {} views of {width} × {height} pixels each", cameras.len());
    }
    if before > 0 {
        let _ = write!(out, ", {before} of which are there already");
    }
    out.push('\n');
    out
}

/// Counts of the heads of this run.
#[derive(Default)]
struct Totals {
    heads: usize,
    failed: usize,
    /// How many heads have each status of their guides, but for those at rest.
    statuses: BTreeMap<&'static str, usize>,
    /// The first head that failed, and why.
    first: Option<String>,
}

impl Totals {
    fn add(&mut self, rows: &[Row]) {
        self.heads += rows.len();
        for row in rows {
            match &row.outcome {
                Ok(measured) => {
                    let status = status(&measured.metrics.settling);
                    *self.statuses.entry(status).or_default() += usize::from(status != "at rest");
                }
                Err(why) => {
                    self.failed += 1;
                    self.first.get_or_insert_with(|| format!("head {}: {why}", row.index));
                }
            }
        }
    }

    fn summary(&self, own: usize) -> String {
        let Self { heads, failed, statuses, first } = self;
        let mut out = format!("{own} heads are there, {heads} of them new");
        for (status, heads) in statuses.iter().filter(|(_, heads)| **heads > 0) {
            let _ = write!(out, "; {heads} have guides that {}", in_words(status));
        }
        if let Some(first) = first {
            let _ = write!(out, "; {failed} failed, the first as {first}");
        }
        out.push('\n');
        out
    }
}

/// The status of guides as part of a sentence.
fn in_words(status: &str) -> &'static str {
    match status {
        "not converged" => "did not converge",
        "on a saddle" => "are on a saddle",
        "undecided" => "are perhaps on a saddle",
        "inside the head" => "are inside the head",
        _ => "miss the accuracy",
    }
}

fn failures(rows: &[Row]) -> String {
    match rows.iter().filter(|row| row.outcome.is_err()).count() {
        0 => String::new(),
        failed => format!(" ({failed} of {} failed)", rows.len()),
    }
}

/// Prints the parameters of the heads of a shard as comma-separated values.
fn list(heads: &Heads, shard: Shard) -> Result<ExitStatus, Error> {
    let mut out = String::from("index,seed");
    let seeds: Vec<bool> = heads.parameters().map(|(key, _)| key == "seed").collect();
    for (key, _) in heads.parameters().filter(|(key, _)| *key != "seed") {
        let _ = write!(out, ",{}", cell(key));
    }
    // The cameras' names, the same for every head.
    let cameras: Vec<&str> = heads
        .views()
        .map_or(&[][..], |views| &views.cameras)
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    let cameras = heads.views().map(|_| cell(&cameras.join(" ")));
    if cameras.is_some() {
        out.push_str(",views");
    }
    out.push('\n');
    let rows = heads.rows();
    let own = (0..heads.heads()).filter(|index| shard.has(index / rows));
    for (place, index) in own.enumerate() {
        let Sample { seed, values, .. } = heads.sample(index);
        let _ = write!(out, "{index},{seed}");
        for (value, _) in values.iter().zip(&seeds).filter(|(_, is_seed)| !**is_seed) {
            let _ = match value {
                Value::Number(x) => write!(out, ",{x}"),
                Value::Whole(i) => write!(out, ",{i}"),
                Value::Flag(flag) => write!(out, ",{flag}"),
                Value::Text(text) => write!(out, ",{}", cell(text)),
            };
        }
        if let Some(cameras) = &cameras {
            let _ = write!(out, ",{cameras}");
        }
        out.push('\n');
        if place % LISTED == LISTED - 1 {
            interrupt::check()?;
            console::print(&out)?;
            out.clear();
        }
    }
    console::print(&out)?;
    Ok(ExitStatus::Success)
}

/// A text as a comma-separated value.
fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Writes the scene of one head.
fn one_scene(arguments: &Batch, heads: &Heads, index: usize) -> Result<ExitStatus, Error> {
    if index >= heads.heads() {
        let message = format!("there is no head {index}; the batch has {}", heads.heads());
        let hint = format!("heads are numbered from 0 to {}", heads.heads() - 1);
        return Err(Error::invalid(message, &hint));
    }
    let text = heads.scene_elsewhere(index).map_err(|error| match error {
        EditError::Scene(SceneError::Invalid(found)) => SceneError::Invalid(found).into(),
        error => Error::because(&error, ""),
    })?;
    let Some(path) = arguments.output.as_deref().filter(|path| *path != Path::new("-")) else {
        console::print(&text)?;
        return Ok(ExitStatus::Success);
    };
    let mut inputs = heads.inputs();
    inputs.push(&arguments.spec);
    outputs::prepare(&[path], &inputs)?;
    outputs::write_text(path, &text)?;
    Ok(ExitStatus::Success)
}
