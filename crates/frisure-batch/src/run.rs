//! The run of one shard into a folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure::files::{WriteError, check_destination, write_atomically};
use frisure::progress::{Cancelled, Progress};
use frisure::scene::batch::Batch;
use frisure_engine::{Error, HeadCache};
use rayon::prelude::*;

use crate::head;
use crate::parquet::{self, PartMetadata};
use crate::part::VIEWS;
use crate::row::Row;
use crate::{Part, Shard};

/// Why a run fails.
#[derive(Debug, thiserror::Error)]
pub enum BatchError {
    /// [`Progress::is_cancelled`] returned true; parts that were written stay.
    #[error("cancelled")]
    Cancelled,
    /// The folder has parts of another batch.
    #[error("`{}` belongs to another batch", path.display())]
    Other {
        /// The part.
        path: PathBuf,
    },
    /// A file with the name of a part is no part.
    #[error("`{}` is no part of a batch: {problem}", path.display())]
    NoPart {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// The folder has heads that are not in the batch.
    #[error("`{}` begins with head {first}; the batch has {heads}", path.display())]
    Beyond {
        /// The part.
        path: PathBuf,
        /// Its first head.
        first: usize,
        /// Number of heads of the batch.
        heads: usize,
    },
    /// The folder cannot be read or created.
    #[error("cannot use the folder `{}`", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A part cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A part cannot be encoded.
    #[error("heads cannot be encoded: {0}")]
    Encode(String),
}

impl BatchError {
    /// What to do; may be empty.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Other { .. } => {
                "the batch, its scene, a file that it reads or the version of frisure is not the one that it was \
                 made with: write to another folder, or take the old parts away"
            }
            Self::NoPart { .. } => "take it away; it is then made again",
            Self::Beyond { .. } => {
                "the folder is of a longer batch: write to another folder, or take the part away"
            }
            _ => "",
        }
    }
}

impl From<BatchError> for Error {
    fn from(error: BatchError) -> Self {
        match &error {
            BatchError::Cancelled => Self::Cancelled(Cancelled),
            BatchError::Other { .. } | BatchError::NoPart { .. } | BatchError::Beyond { .. } => {
                Self::because(&error, error.hint())
            }
            error => Self::failed(error, ""),
        }
    }
}

/// Counts of a finished run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Done {
    /// Heads of the shard.
    pub heads: usize,
    /// Those that earlier runs wrote.
    pub before: usize,
    /// Those of this run that failed.
    pub failed: usize,
}

/// Computes one shard of a batch into a folder.
#[derive(Debug)]
pub struct Run {
    batch: Batch,
    folder: PathBuf,
    shard: Shard,
    heads: Arc<HeadCache>,
}

impl Run {
    /// A run into a folder, which is created if it is missing. Files in it stay.
    ///
    /// # Errors
    /// [`BatchError`], if the folder cannot be used or has other content.
    pub fn new(batch: Batch, folder: &Path, shard: Shard) -> Result<Self, BatchError> {
        let fail = |source| BatchError::Folder { path: folder.into(), source };
        fs::create_dir_all(folder).map_err(fail)?;
        let run = Self { batch, folder: folder.into(), shard, heads: Arc::default() };
        let mut known: Option<(usize, PathBuf)> = None;
        for entry in fs::read_dir(folder).map_err(fail)? {
            let entry = entry.map_err(fail)?;
            let first = entry.file_name().to_str().and_then(Part::first_of);
            let Some(first) = first else { continue };
            if first >= run.batch.heads() {
                let heads = run.batch.heads();
                return Err(BatchError::Beyond { path: entry.path(), first, heads });
            }
            // Folders list their files in any order.
            if known.as_ref().is_none_or(|(least, _)| first < *least) {
                known = Some((first, entry.path()));
            }
        }
        if let Some((_, path)) = known {
            run.check(&path)?;
        }
        if run.batch.views().is_some() {
            fs::create_dir_all(folder.join(VIEWS)).map_err(fail)?;
        }
        if let Some(part) = run.parts().next() {
            check_destination(&run.path(part))?;
            run.views_path(part).map_or(Ok(()), |path| check_destination(&path))?;
        }
        Ok(run)
    }

    /// The batch.
    #[must_use]
    pub fn batch(&self) -> &Batch {
        &self.batch
    }

    /// The names of the columns of every part.
    #[must_use]
    pub fn columns(&self) -> Vec<String> {
        parquet::column_names(&self.batch)
    }

    /// The parts of the shard.
    pub fn parts(&self) -> impl Iterator<Item = Part> {
        let shard = self.shard;
        let all = Part::all(self.batch.heads(), self.batch.rows());
        all.filter(move |part| shard.has(part.number))
    }

    /// The path of a part.
    #[must_use]
    pub fn path(&self, part: Part) -> PathBuf {
        self.folder.join(part.name())
    }

    /// The path of the views of a part, if the batch has any.
    #[must_use]
    pub fn views_path(&self, part: Part) -> Option<PathBuf> {
        self.batch.views().map(|_| self.folder.join(VIEWS).join(part.views_name()))
    }

    /// The parts of the shard that are missing.
    ///
    /// # Errors
    /// [`BatchError`], if one of the others is of another batch.
    pub fn missing(&self) -> Result<Vec<Part>, BatchError> {
        let mut missing = Vec::new();
        for part in self.parts() {
            // The last part of an earlier, shorter batch has too few heads.
            let has_all = |path: &Path| -> Result<bool, BatchError> {
                Ok(path.exists() && self.check(path)? == part.heads)
            };
            let views = self.views_path(part).map_or(Ok(true), |path| has_all(&path))?;
            let whole = has_all(&self.path(part))? && views;
            if !whole {
                missing.push(part);
            }
        }
        Ok(missing)
    }

    /// Checks that a file is a part of this batch; returns the number of its heads.
    fn check(&self, path: &Path) -> Result<usize, BatchError> {
        let found = parquet::read_metadata(path);
        let no_part = |problem: String| BatchError::NoPart { path: path.into(), problem };
        let PartMetadata { digest, heads } = found.map_err(no_part)?;
        if digest == self.batch.digest() {
            Ok(heads)
        } else {
            Err(BatchError::Other { path: path.into() })
        }
    }

    /// Computes the heads of a part, on all threads. `each` is called after each of them.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn compute(
        &self,
        part: Part,
        progress: &dyn Progress,
        each: &(dyn Fn() + Sync),
    ) -> Result<Vec<Row>, Cancelled> {
        head::load_head(&self.batch, &self.heads, part.first);
        let one = |index: usize| {
            if progress.is_cancelled() {
                return Err(Cancelled);
            }
            let row = head::row(&self.batch, &self.heads, index, progress);
            each();
            row
        };
        // One at a time, since heads differ in cost.
        part.range().into_par_iter().with_max_len(1).map(one).collect()
    }

    /// Writes a part atomically, after its views if the batch has any; returns its path.
    ///
    /// # Errors
    /// [`BatchError`].
    pub fn write(&self, part: Part, rows: &[Row]) -> Result<PathBuf, BatchError> {
        if let (Some(path), Some(views)) = (self.views_path(part), self.batch.views()) {
            let bytes = parquet::join_views(&self.batch, views, rows);
            let bytes = bytes.map_err(BatchError::Encode)?;
            write_atomically(&path, |out| out.write_all(&bytes))?;
        }
        let path = self.path(part);
        let bytes = parquet::encode(&self.batch, rows).map_err(BatchError::Encode)?;
        write_atomically(&path, |out| out.write_all(&bytes))?;
        Ok(path)
    }

    /// Computes and writes all missing parts.
    ///
    /// # Errors
    /// [`BatchError`].
    pub fn all(&self, progress: &dyn Progress) -> Result<Done, BatchError> {
        let missing = self.missing()?;
        let heads: usize = self.parts().map(|part| part.heads).sum();
        let to_do: usize = missing.iter().map(|part| part.heads).sum();
        let done = AtomicUsize::new(0);
        let each = || {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.report("heads", done as f64 / to_do as f64);
        };
        let mut failed = 0;
        for part in missing {
            let rows = self.compute(part, progress, &each).map_err(|_| BatchError::Cancelled)?;
            failed += rows.iter().filter(|row| row.outcome.is_err()).count();
            self.write(part, &rows)?;
        }
        Ok(Done { heads, before: heads - to_do, failed })
    }
}
