//! The checkpoint of a picture that is being traced.

use std::path::{Path, PathBuf};

use frisure::files::{self, ReadError, WriteError, write_atomically};
use frisure::render::trace::{ACCUMULATOR_MAGIC, Accumulator, Tracer};

use super::{first_bytes, foreign, with_suffix};
use crate::error::Error;

/// Largest checkpoint that is read (bytes).
const LARGEST: u64 = 8 << 30;

/// The file of the samples of an unfinished picture, `hair.png.part` for `hair.png`.
#[derive(Clone, Debug)]
pub struct PictureCheckpoint {
    path: PathBuf,
}

/// What a checkpoint of a picture has.
#[derive(Debug)]
pub struct ResumedPicture {
    /// The samples of this picture; none if there are none.
    pub accumulator: Option<Accumulator>,
    /// The new name of a checkpoint of another picture.
    pub moved_to: Option<PathBuf>,
}

impl PictureCheckpoint {
    /// The checkpoint of the picture at a path.
    #[must_use]
    pub fn of(picture: &Path) -> Self {
        Self { path: with_suffix(picture, ".part") }
    }

    /// The path of the file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Checks that the file is a checkpoint or missing.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub fn check(&self) -> Result<(), Error> {
        match first_bytes(&self.path) {
            Ok(None) => Ok(()),
            Ok(Some(bytes)) if bytes == ACCUMULATOR_MAGIC => Ok(()),
            _ => Err(foreign(
                &self.path,
                "it is no unfinished picture of this version",
                "the picture so far is kept under that name; move the file away",
            )),
        }
    }

    /// Reads the samples of the tracer's picture. A checkpoint of another picture is hours of work, too: it is renamed.
    ///
    /// # Errors
    /// [`Error`], for a file that cannot be read or renamed.
    pub(crate) fn resume(&self, tracer: &Tracer) -> Result<ResumedPicture, Error> {
        let bytes = match files::read_bytes(&self.path, LARGEST, "an unfinished picture") {
            Ok(bytes) => bytes,
            Err(ReadError::Missing { .. }) => {
                return Ok(ResumedPicture { accumulator: None, moved_to: None });
            }
            Err(error) => return Err(error.into()),
        };
        let found = Accumulator::from_bytes(&bytes).ok();
        let accumulator = found.filter(|accumulator| tracer.can_resume(accumulator));
        let mut moved_to = None;
        if accumulator.is_none() {
            let old = with_suffix(&self.path, ".old");
            std::fs::rename(&self.path, &old).map_err(|e| Error::failed(&e, ""))?;
            moved_to = Some(old);
        }
        Ok(ResumedPicture { accumulator, moved_to })
    }

    /// Writes the samples.
    ///
    /// # Errors
    /// [`WriteError`].
    pub(crate) fn save(&self, accumulator: &Accumulator) -> Result<(), WriteError> {
        write_atomically(&self.path, |out| out.write_all(&accumulator.to_bytes()))
    }

    /// Removes the file: the picture is finished.
    pub(crate) fn remove(&self) {
        // A checkpoint that cannot be removed does no harm.
        let _ = std::fs::remove_file(&self.path);
    }
}
