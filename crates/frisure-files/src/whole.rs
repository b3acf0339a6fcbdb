//! Whole files, read with a limit and written all or not at all.

use std::collections::BTreeMap;
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;

use crate::pipe;
use crate::replace::{System, replace};

/// Why a file could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// There is no such file.
    #[error("there is no file `{}`", path.display())]
    Missing {
        /// The path given.
        path: PathBuf,
    },
    /// It is a directory.
    #[error("`{}` is a directory, not a file", path.display())]
    Directory {
        /// The path given.
        path: PathBuf,
    },
    /// It is larger than such a file can sensibly be.
    #[error("`{}` is larger than {limit} bytes, too large for {what}", path.display())]
    TooLarge {
        /// The path given.
        path: PathBuf,
        /// Largest size accepted (bytes).
        limit: u64,
        /// What was expected, such as `a scene`.
        what: &'static str,
    },
    /// It is not text.
    #[error("`{}` is not UTF-8 text (byte {offset} of line {line})", path.display())]
    NotText {
        /// The path given.
        path: PathBuf,
        /// Line of the first bad byte, from 1.
        line: usize,
        /// Bad byte within that line, from 1.
        offset: usize,
    },
    /// The system refused.
    #[error("cannot read `{}`", path.display())]
    Io {
        /// The path given.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

impl ReadError {
    /// The path given.
    #[must_use]
    pub fn path(&self) -> &PathBuf {
        match self {
            Self::Missing { path }
            | Self::Directory { path }
            | Self::TooLarge { path, .. }
            | Self::NotText { path, .. }
            | Self::Io { path, .. } => path,
        }
    }
}

/// Why a file could not be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The folder that should hold it does not exist.
    #[error("there is no folder `{}` to write `{}` in", folder.display(), path.display())]
    NoFolder {
        /// The file given.
        path: PathBuf,
        /// Its folder.
        folder: PathBuf,
    },
    /// The destination is a directory.
    #[error("`{}` is a directory; name a file", path.display())]
    Directory {
        /// The path given.
        path: PathBuf,
    },
    /// The destination exists and is write-protected.
    #[error("`{}` is read-only", path.display())]
    ReadOnly {
        /// The path given.
        path: PathBuf,
    },
    /// The system refused.
    #[error("cannot write `{}`", path.display())]
    Io {
        /// The path given.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

/// A source of files: bytes that the caller provides, as a page in a browser does, before files of the
/// system. The default has only the latter.
///
/// ```
/// use frisure_files::Files;
///
/// let mut files = Files::default();
/// files.provide("head.obj", *b"v 0 0 0");
/// assert_eq!(files.read_bytes("head.obj".as_ref(), 1 << 20, "a mesh")?, b"v 0 0 0");
/// # Ok::<(), frisure_files::ReadError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Files {
    provided: BTreeMap<PathBuf, Provided>,
    /// How many were provided so far.
    count: u64,
}

/// A file that the caller provided.
#[derive(Clone, Debug)]
struct Provided {
    bytes: Arc<[u8]>,
    /// Its ordinal number among the files provided.
    number: u64,
}

/// Identifies one state of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Its size (bytes).
    size: u64,
    /// When it was written, or the ordinal number of a file provided.
    mark: u128,
}

impl Files {
    /// Provides a file, in place of one with the same path.
    pub fn provide(&mut self, path: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) {
        self.count += 1;
        let provided = Provided { bytes: bytes.into(), number: self.count };
        self.provided.insert(path.into(), provided);
    }

    /// Removes a file that was provided.
    pub fn forget(&mut self, path: &Path) {
        self.provided.remove(path);
    }

    /// A file that was provided: by its path, or else the only one of its name, since what is dropped
    /// on a page has no folder.
    fn provided(&self, path: &Path) -> Option<&Provided> {
        let named = || {
            let mut same = self.provided.iter().filter(|(p, _)| p.file_name() == path.file_name());
            let first = same.next().map(|(_, provided)| provided);
            first.filter(|_| same.next().is_none())
        };
        self.provided.get(path).or_else(named)
    }

    /// The stamp of this state of a file; none if it is not there.
    #[must_use]
    pub fn stamp(&self, path: &Path) -> Option<Stamp> {
        if let Some(Provided { bytes, number }) = self.provided(path) {
            return Some(Stamp { size: bytes.len() as u64, mark: u128::from(*number) });
        }
        let about = fs::metadata(path).ok()?;
        let since = about.modified().ok()?.duration_since(std::time::UNIX_EPOCH).ok()?;
        Some(Stamp { size: about.len(), mark: since.as_nanos() })
    }

    /// As [`read_bytes`].
    ///
    /// # Errors
    /// As [`read_bytes`].
    pub fn read_bytes(
        &self,
        path: &Path,
        limit: u64,
        what: &'static str,
    ) -> Result<Vec<u8>, ReadError> {
        match self.provided(path) {
            Some(file) if file.bytes.len() as u64 > limit => {
                Err(ReadError::TooLarge { path: path.into(), limit, what })
            }
            Some(file) => Ok(file.bytes.to_vec()),
            None => read_bytes(path, limit, what),
        }
    }

    /// As [`read_text`].
    ///
    /// # Errors
    /// As [`read_text`].
    pub fn read_text(
        &self,
        path: &Path,
        limit: u64,
        what: &'static str,
    ) -> Result<String, ReadError> {
        to_text(self.read_bytes(path, limit, what)?, path)
    }
}

/// Most that is read of a device or a pipe (bytes), which may have no end: more would take the memory before it is refused. Chosen:
/// larger than any groom in the tests, a small part of the memory of a computer.
const MOST_OF_STREAM: u64 = 1 << 30;

/// The bytes of a file of at most `limit` bytes, of a device or a pipe of at most 1 GiB; `what` names it in errors (`a scene`).
///
/// # Errors
/// [`ReadError`], for a file that is missing, a directory, too large or unreadable.
pub fn read_bytes(path: &Path, limit: u64, what: &'static str) -> Result<Vec<u8>, ReadError> {
    let fail = |source: io::Error| match source.kind() {
        // Where there is no file system, there is no file.
        ErrorKind::NotFound | ErrorKind::Unsupported => ReadError::Missing { path: path.into() },
        ErrorKind::IsADirectory => ReadError::Directory { path: path.into() },
        _ => ReadError::Io { path: path.into(), source },
    };
    // Asked before opening: a folder opens on some systems and fails at the first read on others.
    let about = fs::metadata(path).map_err(fail)?;
    if about.is_dir() {
        return Err(ReadError::Directory { path: path.into() });
    }
    let limit = if about.is_file() { limit } else { limit.min(MOST_OF_STREAM) };
    if about.is_file() && about.len() > limit {
        return Err(ReadError::TooLarge { path: path.into(), limit, what });
    }
    // One byte more than allowed: devices and pipes have no size to ask for, and files grow.
    let bytes = match pipe::read(path, limit + 1).map_err(fail)? {
        Some(bytes) => bytes,
        None => {
            let mut bytes = Vec::new();
            File::open(path)
                .map_err(fail)?
                .take(limit + 1)
                .read_to_end(&mut bytes)
                .map_err(fail)?;
            bytes
        }
    };
    if bytes.len() as u64 > limit {
        return Err(ReadError::TooLarge { path: path.into(), limit, what });
    }
    Ok(bytes)
}

/// The text of a file of at most `limit` bytes; `what` names it in errors (`a scene`).
///
/// # Errors
/// [`ReadError`], as [`read_bytes`] and for bytes that are not UTF-8.
pub fn read_text(path: &Path, limit: u64, what: &'static str) -> Result<String, ReadError> {
    to_text(read_bytes(path, limit, what)?, path)
}

/// Bytes as text; `path` names them in the error.
///
/// # Errors
/// [`ReadError::NotText`].
pub fn to_text(bytes: Vec<u8>, path: &Path) -> Result<String, ReadError> {
    String::from_utf8(bytes).map_err(|e| {
        let good = &e.as_bytes()[..e.utf8_error().valid_up_to()];
        let start = good.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
        let line = good.iter().filter(|&&b| b == b'\n').count() + 1;
        ReadError::NotText { path: path.into(), line, offset: good.len() - start + 1 }
    })
}

/// Writes a file so that it is either complete or as before: the bytes go to a hidden file in the
/// same folder, which is flushed to the disk and renamed over the destination.
///
/// An existing file keeps its permissions and its owner, a link keeps pointing at its target, also one that does not
/// exist yet, and devices and pipes are written directly. A file of another owner, which only its owner or root could
/// give away, is written in place once all bytes are there. Output is buffered.
///
/// # Errors
/// [`WriteError`]; the destination is then untouched, with two exceptions that the error tells: it is written, but its name may
/// not survive a loss of power; or the copy in place failed, and all bytes are in a file beside it.
pub fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let fail = |source| WriteError::Io { path: path.into(), source };
    match destination(path)? {
        Destination::Device => write_directly(path, fill).map_err(fail),
        Destination::File { target, folder, existing } => {
            replace(&mut System, &target, &folder, existing, fill).map_err(fail)
        }
    }
}

/// Checks that a file can be written, without touching it.
///
/// # Errors
/// [`WriteError`], as [`write_atomically`] would give.
pub fn check_destination(path: &Path) -> Result<(), WriteError> {
    match destination(path)? {
        Destination::Device => Ok(()),
        Destination::File { folder, .. } => {
            // Permissions are not enough (root, read-only disks): a file is created to find out.
            let probe = tempfile::tempfile_in(folder);
            probe.map(drop).map_err(|source| WriteError::Io { path: path.into(), source })
        }
    }
}

/// The destination of a path.
enum Destination {
    /// A device or a pipe, to be written as it is: renaming over it would replace it.
    Device,
    /// A file that is or will be.
    File { target: PathBuf, folder: PathBuf, existing: Option<Box<Metadata>> },
}

fn destination(path: &Path) -> Result<Destination, WriteError> {
    // `a.png/` is a folder's name, though its parts are those of `a.png`.
    if path.as_os_str().to_string_lossy().ends_with(std::path::is_separator) {
        return Err(WriteError::Directory { path: path.into() });
    }
    let fail = |source| WriteError::Io { path: path.into(), source };
    let existing = match fs::metadata(path) {
        Ok(m) if m.is_dir() => return Err(WriteError::Directory { path: path.into() }),
        Ok(m) if !m.is_file() => return Ok(Destination::Device),
        Ok(m) => Some(Box::new(m)),
        // Where there is no file system, there is no file.
        Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::Unsupported) => None,
        // A name that is too long, links in a circle, a folder that may not be searched.
        Err(e) => return Err(fail(e)),
    };
    // The permissions of the folder decide whether a file can be replaced, those of the file whether it may be.
    if existing.as_ref().is_some_and(|m| m.permissions().readonly() || !may_write(path)) {
        return Err(WriteError::ReadOnly { path: path.into() });
    }
    // Renaming over a link would replace the link instead of the file it points at.
    let target = match existing {
        Some(_) => fs::canonicalize(path).map_err(fail)?,
        None => end_of_links(path),
    };
    let folder = match target.parent() {
        Some(p) if !p.as_os_str().is_empty() => p.to_path_buf(),
        _ => PathBuf::from("."),
    };
    if !folder.is_dir() {
        return Err(WriteError::NoFolder { path: path.into(), folder });
    }
    Ok(Destination::File { target, folder, existing })
}

/// Whether the system lets this user write a file that exists.
fn may_write(path: &Path) -> bool {
    let opened = File::options().write(true).open(path);
    !opened.is_err_and(|e| e.kind() == ErrorKind::PermissionDenied)
}

/// Links that are followed one after another, as many as Linux follows (`path_resolution(7)`).
const MOST_LINKS: usize = 40;

/// The file that will be where a path leads, which links may lead to before it exists.
fn end_of_links(path: &Path) -> PathBuf {
    let mut end = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&end) {
            // Relative to the folder of the link; an absolute target replaces it.
            Ok(target) => end = end.parent().unwrap_or(Path::new("")).join(target),
            Err(_) => break,
        }
    }
    end
}

fn write_directly(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // Open until the file itself is: a reader without any writer would think that this was all.
    let awaited = pipe::await_reader(path)?;
    let mut buffer = BufWriter::new(File::options().write(true).open(path)?);
    drop(awaited);
    fill(&mut buffer)?;
    buffer.flush()
}
