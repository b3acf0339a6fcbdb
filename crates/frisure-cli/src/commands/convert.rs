//! `frisure convert`: a groom from one format to others.

use std::path::Path;

use frisure::formats::groom::Groom;
use frisure::progress::Progress;
use frisure_engine::Error;

use super::read_groom;
use crate::args::{Axes, Convert};
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, grooms, interrupt, outputs};

/// Reads the groom and writes it where the arguments say.
pub(crate) fn run(arguments: Convert, quiet: bool) -> Result<ExitStatus, Error> {
    let Convert { groom: path, outputs: asked, writing, from_unit, from_up } = arguments;
    let from = Axes { unit: from_unit, up: from_up };
    grooms::check(&asked, writing)?;
    let names: Vec<&Path> = asked.iter().map(AsRef::as_ref).collect();
    outputs::prepare(&names, &[&path])?;
    let progress = Bar::new(quiet);
    let worker = progress.clone();
    let read = interrupt::compute(move || {
        worker.report("reading", 0.0);
        read_groom(&path, from, "`--from-unit` and `--from-up` say what it has")
    });
    let result = read.and_then(|groom: Groom| {
        progress.report("writing", 0.0);
        let counts = (groom.hairs.len(), groom.guides.len());
        Ok((counts, grooms::write(groom, &asked, writing)?))
    });
    progress.finish();
    let ((hairs, guides), written) = result?;
    if !quiet {
        let lines: String = written.iter().map(|line| format!("wrote {line}\n")).collect();
        console::print(&format!("read {hairs} hairs, {guides} guides\n{lines}"))?;
    }
    Ok(ExitStatus::Success)
}
