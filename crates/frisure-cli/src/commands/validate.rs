//! `frisure validate`: experiments, and the report of what they found.

use std::fmt::Write;

use frisure_evidence::report::Book;
use frisure_evidence::{EXPERIMENTS, Effort, Experiment, Finding, Monitor, Stopped};

use crate::args::Validate;
use crate::failure::{Done, Failure};
use crate::progress::Progress;
use crate::{console, interrupt, outputs};

/// Runs the experiments and writes the report, also where a verdict fails.
pub(crate) fn run(arguments: Validate, quiet: bool) -> Result<Done, Failure> {
    if arguments.list {
        console::print(&list())?;
        return Ok(Done::Well);
    }
    let Validate { experiments: names, full, output, .. } = arguments;
    let files = ["index.html", "report.md"].map(|name| output.join(name));
    outputs::prepare(&[&files[0], &files[1]], &[])?;
    let effort = if full { Effort::Full } else { Effort::Quick };
    let chosen: Vec<&'static Experiment> = EXPERIMENTS
        .iter()
        .copied()
        .filter(|e| names.is_empty() || names.iter().any(|name| name == e.name))
        .collect();
    let progress = Progress::new(quiet);
    let watch = Watch(progress.clone());
    let found = interrupt::computing(move || all(&chosen, effort, &watch));
    progress.finish();
    let book = Book { effort, chapters: found? };
    let written = book.write(&output).map_err(|e| Failure::failed(&e))?;
    if !quiet {
        console::print(&summary(&book, &written[0].display().to_string()))?;
    }
    Ok(if book.holds() { Done::Well } else { Done::NotHeld })
}

/// Shows progress, and stops at Ctrl-C.
struct Watch(Progress);

impl Monitor for Watch {
    fn progress(&self, stage: &'static str, fraction: f64) {
        self.0.show(stage, fraction);
    }

    fn cancelled(&self) -> bool {
        interrupt::interrupted()
    }
}

type Chapters = Vec<(&'static Experiment, Finding)>;

fn all(
    chosen: &[&'static Experiment],
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Chapters, Failure> {
    let one = |&experiment: &&'static Experiment| {
        interrupt::check()?;
        monitor.progress(experiment.name, 0.0);
        let finding = (experiment.run)(effort, monitor).map_err(|error| match error {
            Stopped::Cancelled(_) => Failure::Interrupted,
            error => Failure::failed(&error),
        })?;
        Ok((experiment, finding))
    };
    chosen.iter().map(one).collect()
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
fn summary(book: &Book<'_>, page: &str) -> String {
    let mut out = String::new();
    for (experiment, finding) in &book.chapters {
        let held = finding.criteria.iter().filter(|c| c.holds()).count();
        let _ = writeln!(
            out,
            "{:<14} {held} of {} criteria hold",
            experiment.name,
            finding.criteria.len()
        );
        for failed in finding.criteria.iter().filter(|c| !c.holds()) {
            let _ = writeln!(out, "  FAILS: {}: {:.4e}", failed.what, failed.measured);
        }
    }
    let _ = writeln!(out, "wrote {page}");
    out
}
