//! The checkpoint of a picture that is being traced.

use std::path::{Path, PathBuf};

use frisure::files::{self, ReadError};
use frisure::render::trace::{ACCUMULATOR_MAGIC, Accumulator, Tracer};

use super::{first_bytes, foreign, with_suffix};
use crate::error::Error;

/// Largest checkpoint that is read (bytes).
const LARGEST: u64 = 8 << 30;

/// The file of the samples of an unfinished picture: `hair.png.part` for `hair.png`.
#[must_use]
pub fn path_for(picture: &Path) -> PathBuf {
    with_suffix(picture, ".part")
}

/// Checks that a file is a checkpoint or missing.
///
/// # Errors
/// [`Error::Invalid`].
pub fn check(path: &Path) -> Result<(), Error> {
    match first_bytes(path) {
        Ok(None) => Ok(()),
        Ok(Some(bytes)) if bytes == ACCUMULATOR_MAGIC => Ok(()),
        _ => Err(foreign(
            path,
            "it is no unfinished picture of this version",
            "the picture so far is kept under that name; move the file away",
        )),
    }
}

/// Reads the samples of the tracer's picture, if there are some. A checkpoint of another picture is hours of work, too: it
/// is renamed, to the path that is returned.
pub(crate) fn resume(
    path: &Path,
    tracer: &Tracer,
) -> Result<(Option<Accumulator>, Option<PathBuf>), Error> {
    let bytes = match files::read_bytes(path, LARGEST, "an unfinished picture") {
        Ok(bytes) => bytes,
        Err(ReadError::Missing { .. }) => return Ok((None, None)),
        Err(error) => return Err(error.into()),
    };
    let found = Accumulator::from_bytes(&bytes).ok();
    if let Some(found) = found.filter(|accumulator| tracer.can_resume(accumulator)) {
        return Ok((Some(found), None));
    }
    let old = unused(path);
    std::fs::rename(path, &old).map_err(|e| Error::failed(&e, ""))?;
    Ok((None, Some(old)))
}

/// The path with `.old`, or `.old2` and so on, that nothing has yet.
fn unused(path: &Path) -> PathBuf {
    let numbered = (2..u32::MAX).map(|number| format!(".old{number}"));
    let mut paths =
        std::iter::once(".old".to_owned()).chain(numbered).map(|suffix| with_suffix(path, &suffix));
    // A link to nothing would be replaced, too.
    let free = paths.find(|path| path.symlink_metadata().is_err());
    free.expect("a folder has fewer files")
}
