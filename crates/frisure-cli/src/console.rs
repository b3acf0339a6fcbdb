//! Standard output and standard error.

use std::io::{self, ErrorKind, Write};
use std::path::Path;

use frisure::scene::escaped;
use frisure_engine::Error;
use serde::Serialize;

use crate::diagnostics::render;
use crate::interrupt;

/// Writes a text for a person to standard output: nothing in it commands the terminal, whatever names the user has given.
pub(crate) fn say(text: &str) -> Result<(), Error> {
    print(&plain(text))
}

/// The name of a file as a line of text has it.
pub(crate) fn shown(path: &Path) -> String {
    escaped(&path.display().to_string(), |_| false)
}

/// Lines of text, without other control characters.
fn plain(text: &str) -> String {
    escaped(text, |c| c == '\n')
}

/// Writes a document, every byte of it, to standard output. A closed pipe (`frisure presets | head -1`) is no error.
pub(crate) fn print(text: &str) -> Result<(), Error> {
    print_to(io::stdout().lock(), text)
}

/// The same of a text with colours, without them where they are not wanted: in files, with `NO_COLOR`.
pub(crate) fn print_coloured(text: &str) -> Result<(), Error> {
    print_to(anstream::stdout().lock(), text)
}

fn print_to(mut out: impl Write, text: &str) -> Result<(), Error> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let hint = "what the command wrote to files is there; let standard output go elsewhere";
            Err(Error::Failed {
                problem: format!("cannot write to standard output: {error}"),
                hint: hint.into(),
            })
        }
        _ => Ok(()),
    }
}

/// Indented JSON with a line break at the end.
pub(crate) fn json(value: &impl Serialize) -> Result<String, Error> {
    let json = serde_json::to_string_pretty(value).map_err(|e| Error::failed(&e, ""))?;
    Ok(format!("{json}\n"))
}

/// Writes a line about progress to standard error.
#[cfg(feature = "validate")]
pub(crate) fn progress_line(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Writes to standard error what a person should know, though nothing failed.
pub(crate) fn note(text: &str) {
    let _ = writeln!(io::stderr().lock(), "note: {}", plain(text));
}

/// Writes lines of warnings to standard error, where there are any.
pub(crate) fn warn(lines: &str) {
    let _ = write!(io::stderr().lock(), "{lines}");
}

/// Writes why a command failed to standard error, if that is open.
pub(crate) fn show_error(error: &Error) {
    // Removes colours where they are not wanted: in files, with NO_COLOR.
    let mut err = anstream::stderr().lock();
    let _ = match error {
        Error::Cancelled(_) => match interrupt::resume() {
            Some(how) => writeln!(err, "interrupted: {}", plain(&how)),
            None => writeln!(err, "interrupted"),
        },
        error => writeln!(err, "{}", render(error)),
    };
}
