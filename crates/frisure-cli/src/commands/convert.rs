//! `frisure convert`: a groom from one format to others.

use frisure::formats::groom::{Groom, Program};
use frisure::progress::Progress;
use frisure_engine::Error;
use glam::Vec3;

use super::read_groom;
use crate::args::{Convert, Writing};
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
    warn(&groom, *writing);
    let found = format!("read {} hairs, {} guides\n", groom.hairs.len(), groom.guides.len());
    let written = grooms::write(groom, paths, *writing)?;
    drop(progress);
    if !quiet {
        let lines: String = written.iter().map(|line| format!("wrote {line}\n")).collect();
        console::say(&(found + &lines))?;
    }
    Ok(ExitStatus::Success)
}

/// Tells what the programs that open the files will not take as hair.
fn warn(groom: &Groom, writing: Writing) {
    let strands = groom.strands();
    let is_point = |points: &[Vec3]| points.iter().all(|p| *p == points[0]);
    let missing = strands.iter().filter(|strand| is_point(strand.points)).count();
    // Of fewer hairs only such are chosen as cover something.
    let fewer = writing.hairs.is_some_and(|hairs| hairs < groom.hairs.len());
    if missing > 0 && !fewer {
        let all = strands.len();
        console::note(&format!(
            "{missing} of {all} hairs have no length; they are written as they are"
        ));
    }
    let unbound = writing.program.filter(|program| program.binds && groom.head.is_none());
    if let Some(Program { name, .. }) = unbound {
        console::note(&format!(
            "there is no head in it: the roots have no place on one, and `{name}` cannot bind them. `frisure transfer` puts hair on a head"
        ));
    }
}
