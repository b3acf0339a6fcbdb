//! The hidden files that outputs are written to before they are renamed, and their removal after a crash.
//!
//! A run that is killed leaves its hidden file. The next run that writes in the folder removes it: a file that is being
//! written is locked by its writer, so one that nobody has locked is left over.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use tempfile::NamedTempFile;

/// How the name of a hidden file begins; random letters and digits follow.
const PREFIX: &str = ".frisure-";

/// How the name of a hidden file ends.
const SUFFIX: &str = ".tmp";

/// Random letters and digits in the name of a hidden file. Chosen: so many that no person gives a file such a name.
const RANDOM: usize = 16;

/// Age below which a hidden file is left alone: between its creation and its lock it looks left over. Chosen.
const YOUNG: Duration = Duration::from_secs(60);

/// The folders that were searched by this process.
static SEARCHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Makes a hidden file in a folder, locked where the system can; removes those that killed runs left there.
pub(crate) fn create(folder: &Path) -> io::Result<NamedTempFile> {
    remove_left_over(folder);
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX).rand_bytes(RANDOM);
    // Temporary files are private by default; an output should be as any new file is.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder).map_err(without_path)?;
    // Where there are no locks, nothing is found left over either.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// The error of the system alone: its path is that of a file which the user never named.
fn without_path(error: io::Error) -> io::Error {
    let cause = error.get_ref().and_then(|wrapped| wrapped.source());
    let cause = cause.and_then(|cause| cause.downcast_ref::<io::Error>());
    match cause.and_then(io::Error::raw_os_error) {
        Some(code) => io::Error::from_raw_os_error(code),
        None => error,
    }
}

/// Removes the hidden files of killed runs from a folder, once in a process: folders of batches have many files.
fn remove_left_over(folder: &Path) {
    let Ok(folder) = fs::canonicalize(folder) else { return };
    if !SEARCHED.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.clone()) {
        return;
    }
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        if name.to_str().is_some_and(is_ours) && is_left_over(&entry.path()) {
            // Another run may have removed it.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether [`create`] gives files such a name: a person may have a `.frisure-notes.tmp` too.
fn is_ours(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX).and_then(|rest| rest.strip_suffix(SUFFIX));
    random.is_some_and(|r| r.len() == RANDOM && r.bytes().all(|b| b.is_ascii_alphanumeric()))
}

/// Whether a hidden file has no writer.
fn is_left_over(path: &Path) -> bool {
    let found = fs::symlink_metadata(path).ok().filter(fs::Metadata::is_file);
    let age = found.and_then(|found| found.modified().ok()?.elapsed().ok());
    age.is_some_and(|age| age > YOUNG)
        && File::options().write(true).open(path).is_ok_and(|file| file.try_lock().is_ok())
}
