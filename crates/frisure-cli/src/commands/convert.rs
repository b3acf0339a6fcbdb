//! `frisure convert`: a groom from one format to others.

use frisure::progress::Progress;
use frisure_engine::Error;

use super::read_groom;
use crate::args::Convert;
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, grooms, outputs};

/// Reads the groom and writes it where the arguments say.
pub(crate) fn run(arguments: &Convert, quiet: bool) -> Result<ExitStatus, Error> {
    let Convert { groom: path, outputs: paths, writing, read } = arguments;
    grooms::check(paths, *writing)?;
    outputs::prepare(&paths.iter().map(AsRef::as_ref).collect::<Vec<_>>(), &[path])?;
    let progress = Bar::new(quiet);
    progress.report("reading", 0.0);
    let groom = read_groom(path, read.axes(), "set `--from-unit` and `--from-up`")?;
    progress.report("writing", 0.0);
    let found = format!("read {} hairs, {} guides\n", groom.hairs.len(), groom.guides.len());
    let written = grooms::write(groom, paths, *writing)?;
    drop(progress);
    if !quiet {
        let lines: String = written.iter().map(|line| format!("wrote {line}\n")).collect();
        console::print(&(found + &lines))?;
    }
    Ok(ExitStatus::Success)
}
