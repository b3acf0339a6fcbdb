//! `frisure validate`: runs experiments and writes their report.

use std::fmt::Write;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::Instant;

use frisure_engine::Error;
use frisure_evidence::report::{Book, in_the_way};
use frisure_evidence::{EXPERIMENTS, Effort, Experiment, Finding, Progress, Stopped};

use crate::args::Validate;
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, interrupt, outputs};

/// Runs the experiments and writes the report, also where a criterion fails.
pub(crate) fn run(arguments: &Validate, quiet: bool) -> Result<ExitStatus, Error> {
    if arguments.list {
        console::say(&list())?;
        return Ok(ExitStatus::Success);
    }
    let Validate { experiments: names, full, output, .. } = arguments;
    let effort = if *full { Effort::Full } else { Effort::Quick };
    let chosen: Vec<&'static Experiment> = EXPERIMENTS
        .iter()
        .copied()
        .filter(|e| names.is_empty() || names.iter().any(|name| name == e.name))
        .collect();
    prepare(output, &chosen)?;
    let progress = Bar::new(quiet);
    let lines = !quiet && !std::io::stderr().is_terminal();
    let chapters = Runs { progress: &progress, lines, count: chosen.len() }.all(&chosen, effort)?;
    drop(progress);
    let book = Book { effort, chapters };
    let written = interrupt::writing(|| book.write(output));
    if !quiet {
        // Even if the report cannot be written, the result of minutes of work is printed.
        console::say(&summary(&book))?;
    }
    let page = written.map_err(|e| Error::failed(&e, ""))?;
    if !quiet {
        console::say(&format!("wrote {}\n", console::shown(&page)))?;
    }
    Ok(if book.holds() { ExitStatus::Success } else { ExitStatus::CriterionFailed })
}

/// Checks that the report can be written: its two files, and files with the names of its pictures.
fn prepare(folder: &Path, chosen: &[&Experiment]) -> Result<(), Error> {
    if folder.exists() && !folder.is_dir() {
        let message = format!("`{}` is not a folder", folder.display());
        return Err(Error::invalid(message, "name a folder"));
    }
    let mut files = vec![folder.join("index.html"), folder.join("report.md")];
    files.extend(in_the_way(folder, chosen));
    let files: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
    outputs::prepare(&files, &[])
}

/// Runs experiments and shows their progress.
struct Runs<'a> {
    progress: &'a Bar,
    /// Whether to print a line for each finished experiment, where there is no bar.
    lines: bool,
    count: usize,
}

/// Shows the progress of an experiment, and stops at Ctrl-C.
struct ExperimentProgress<'a> {
    progress: &'a Bar,
    name: &'static str,
    /// The stage in the bar, such as `2 of 11 buckling`.
    shown: String,
}

impl Progress for ExperimentProgress<'_> {
    fn report(&self, stage: &str, fraction: f64) {
        // Functions that the experiment calls report stages of their own.
        if stage == self.name {
            self.progress.report(&self.shown, fraction);
        }
    }

    fn is_cancelled(&self) -> bool {
        interrupt::interrupted()
    }
}

type Chapter = (&'static Experiment, Finding);

impl Runs<'_> {
    fn all(&self, chosen: &[&'static Experiment], effort: Effort) -> Result<Vec<Chapter>, Error> {
        chosen.iter().enumerate().map(|(i, &e)| Ok((e, self.one(i + 1, e, effort)?))).collect()
    }

    /// The finding of an experiment, or that it failed.
    fn one(
        &self,
        number: usize,
        experiment: &'static Experiment,
        effort: Effort,
    ) -> Result<Finding, Error> {
        interrupt::check()?;
        let name = experiment.name;
        let shown = format!("{number} of {} {name}", self.count);
        let progress = ExperimentProgress { progress: self.progress, name, shown };
        progress.report(name, 0.0);
        let start = Instant::now();
        let finding = match (experiment.run)(effort, &progress) {
            Err(Stopped::Cancelled(cancelled)) => return Err(cancelled.into()),
            Err(error) => Finding::failed(&error),
            Ok(finding) => finding,
        };
        if self.lines {
            let seconds = start.elapsed().as_secs_f64();
            console::progress_line(&format!(
                "{}: {} ({seconds:.1} s)",
                progress.shown,
                finding.verdict()
            ));
        }
        Ok(finding)
    }
}

fn list() -> String {
    let mut out = String::new();
    for experiment in EXPERIMENTS {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{:<14} {}", experiment.name, experiment.question);
    }
    out
}

/// A line for each experiment, and one for each verdict that fails.
fn summary(book: &Book<'_>) -> String {
    let mut out = String::new();
    for (experiment, finding) in &book.chapters {
        let _ = writeln!(out, "{:<14} {}", experiment.name, finding.verdict());
        for failed in finding.criteria.iter().filter(|c| !c.holds()) {
            let _ = writeln!(out, "  FAILS: {}: {:.4e}", failed.what, failed.measured);
        }
    }
    out
}
