//! Checkpoints: files from which interrupted work resumes.

mod hairs;
pub mod picture;

pub use hairs::HairCheckpoint;

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// A path with a text after its name: `a.png` and `.part` are `a.png.part`.
fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(suffix);
    path.with_file_name(name)
}

/// The first bytes of a file, at most 8; none if there is no file.
fn first_bytes(path: &Path) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    // A named pipe would wait for a writer.
    if std::fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(io::Error::other("not a file"));
    }
    match File::open(path).and_then(|file| file.take(8).read_to_end(&mut bytes)) {
        Ok(_) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// The error of a file that has the name of a checkpoint and is none; `what` says what it is not.
fn foreign(path: &Path, what: &str, hint: &str) -> Error {
    Error::invalid(format!("`{}` is in the way: {what}", path.display()), hint)
}
