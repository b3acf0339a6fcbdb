//! Standard output and standard error.

use std::io::{self, ErrorKind, Write};

use crate::failure::Failure;

/// Writes text to standard output. A reader that has gone away (`frisure presets | head -1`) has
/// what it wanted.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::failed(&error)),
        _ => Ok(()),
    }
}

/// A line on standard error of how far work is.
pub(crate) fn tell(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Tells on standard error what a person should know, though nothing failed.
pub(crate) fn note(text: &str) {
    let _ = writeln!(io::stderr().lock(), "note: {text}");
}

/// Shows why a command failed. If standard error is closed there is nobody to tell.
pub(crate) fn complain(failure: &Failure) {
    // Removes colours where they are not wanted: in files, with NO_COLOR.
    let mut err = anstream::stderr().lock();
    let _ = match failure {
        Failure::Failed(report) | Failure::Wrong(report) => writeln!(err, "{}", report.render()),
        Failure::Interrupted => writeln!(err, "interrupted"),
        Failure::Paused(what) => writeln!(err, "interrupted: {what}"),
    };
}
