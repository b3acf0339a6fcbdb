//! Output files: checked before the work, so that no result is computed that cannot be written.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use frisure::files::{self, WriteError};
use frisure_engine::Error;

use crate::interrupt;

/// The folders that were created, the deepest first of each path.
static CREATED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Checks that all `outputs` are different files, that none is one of the `inputs`, and that each
/// can be written; creates their folders.
pub(crate) fn prepare(outputs: &[&Path], inputs: &[&Path]) -> Result<(), Error> {
    let read: BTreeSet<PathBuf> = inputs.iter().map(|path| resolved(path)).collect();
    let mut asked: BTreeSet<PathBuf> = BTreeSet::new();
    for path in outputs {
        let whole = resolved(path);
        let overwritten = read.contains(&whole);
        let linked = asked.iter().find(|other| same_file(other, &whole));
        if let Some(other) = linked {
            let (path, other) = (path.display(), other.display());
            let message = format!("`{path}` and `{other}` are one file, by a hard link");
            return Err(Error::invalid(message, "give each output a file of its own"));
        }
        if !asked.insert(whole) {
            let message = format!("`{}` is given twice", path.display());
            return Err(Error::invalid(message, "give each output a name of its own"));
        }
        if overwritten {
            let message = format!("`{}` is read and would be overwritten", path.display());
            return Err(Error::invalid(message, "give the output another name"));
        }
    }
    for path in outputs {
        if let Some(folder) = path.parent().filter(|p| !p.as_os_str().is_empty()) {
            CREATED.lock().unwrap_or_else(PoisonError::into_inner).extend(missing(folder));
            fs::create_dir_all(folder).map_err(|source| {
                let path = folder.to_path_buf();
                Error::failed(&WriteError::Io { path, source }, "")
            })?;
        }
        files::check_destination(path).map_err(|e| Error::failed(&e, ""))?;
    }
    Ok(())
}

/// Checks that the disk of a file has room for so many bytes, as far as it can be asked.
pub(crate) fn check_room(path: &Path, bytes: u64) -> Result<(), Error> {
    let Some(free) = free_room(path).filter(|free| *free < bytes) else { return Ok(()) };
    let (path, needed, free) = (path.display(), megabytes(bytes), megabytes(free));
    let problem = format!("`{path}` may need {needed} MB, and there are {free} MB on its disk");
    Err(Error::failed(
        &io::Error::new(io::ErrorKind::StorageFull, problem),
        "make room, or write to another disk",
    ))
}

/// Millions of bytes, rounded up.
fn megabytes(bytes: u64) -> u64 {
    bytes.div_ceil(1_000_000)
}

/// Bytes that a user may still write on the disk of a file; none where that is not known.
#[cfg(unix)]
fn free_room(path: &Path) -> Option<u64> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let disk = nix::sys::statvfs::statvfs(folder.unwrap_or(Path::new("."))).ok()?;
    Some((disk.blocks_available() as u64).saturating_mul(disk.fragment_size() as u64))
}

/// Bytes that a user may still write on the disk of a file; none where that is not known.
#[cfg(not(unix))]
fn free_room(_: &Path) -> Option<u64> {
    None
}

/// A folder and its parents that do not exist, the deepest first.
fn missing(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let named = folder.ancestors().filter(|f| !f.as_os_str().is_empty());
    named.take_while(|f| !f.exists()).map(Path::to_path_buf)
}

/// Removes the folders that [`prepare`] created and that are still empty.
pub(crate) fn remove_empty_folders() {
    for folder in CREATED.lock().unwrap_or_else(PoisonError::into_inner).iter() {
        // Folders with files cannot be removed.
        let _ = fs::remove_dir(folder);
    }
}

/// Writes a text; the file is complete or as before.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), Error> {
    let write = |out: &mut dyn io::Write| out.write_all(text.as_bytes());
    interrupt::writing(|| files::write_atomically(path, write)).map_err(|e| Error::failed(&e, ""))
}

/// Links that are followed one after another, as many as Linux follows (`path_resolution(7)`).
const MOST_LINKS: usize = 40;

/// The path with as much of it as exists made absolute, links followed, also those to files that do not exist yet.
fn resolved(path: &Path) -> PathBuf {
    resolved_within(path, MOST_LINKS)
}

fn resolved_within(path: &Path, links: usize) -> PathBuf {
    if let Ok(whole) = fs::canonicalize(path) {
        return whole;
    }
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.into());
    let (Some(folder), Some(name)) = (absolute.parent(), absolute.file_name()) else {
        return absolute;
    };
    let folder = resolved_within(folder, links);
    match fs::read_link(&absolute) {
        Ok(target) if links > 0 => resolved_within(&folder.join(target), links - 1),
        _ => folder.join(name),
    }
}

/// Whether two different paths are hard links to one file that exists.
#[cfg(unix)]
fn same_file(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let of = |path: &Path| fs::metadata(path).ok().filter(fs::Metadata::is_file);
    let known = of(a).zip(of(b));
    a != b && known.is_some_and(|(a, b)| (a.dev(), a.ino()) == (b.dev(), b.ino()))
}

/// Whether two different paths are hard links to one file that exists: the standard library does not tell here.
#[cfg(not(unix))]
fn same_file(_: &Path, _: &Path) -> bool {
    false
}

/// A path with a number before the extension: `out/hair.png` is `out/hair-07.png`.
pub(crate) fn numbered(path: &Path, number: usize, count: usize) -> PathBuf {
    let digits = count.saturating_sub(1).to_string().len().max(2);
    suffixed(path, &format!("{number:0digits$}"))
}

/// A path with a word before the extension: `out/hair.png` is `out/hair-front.png`.
pub(crate) fn suffixed(path: &Path, word: &str) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push("-");
    name.push(word);
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_disk_without_room_is_told_with_both_numbers() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        assert!(check_room(&path, 1).is_ok());
        let error = check_room(&path, u64::MAX).unwrap_err().to_string();
        assert!(error.contains("may need 18446744073710 MB, and there are"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn two_outputs_through_one_link_are_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("old"), "old").unwrap();
        fs::hard_link(path("old"), path("hard")).unwrap();
        std::os::unix::fs::symlink("old", path("soft")).unwrap();
        // Its target does not exist yet.
        std::os::unix::fs::symlink("new", path("early")).unwrap();
        // A link to itself has an end.
        std::os::unix::fs::symlink("round", path("round")).unwrap();
        let fault = |a: &str, b: &str| {
            let (a, b) = (path(a), path(b));
            prepare(&[&a, &b], &[]).err().map(|e| e.to_string())
        };
        for (a, b, expected) in [
            ("old", "hard", "by a hard link"),
            ("hard", "soft", "by a hard link"),
            ("old", "soft", "is given twice"),
            ("new", "early", "is given twice"),
            ("early", "new", "is given twice"),
        ] {
            let fault = fault(a, b).unwrap_or_default();
            assert!(fault.contains(expected), "{a}, {b}: {fault}");
        }
        assert_eq!(fault("old", "new"), None);
        assert_eq!(resolved(&path("round")).file_name(), path("round").file_name());
    }

    #[test]
    fn numbers_go_before_the_extension() {
        let name = |path: &str, number, count| numbered(Path::new(path), number, count);
        assert_eq!(name("out/hair.png", 7, 12), Path::new("out/hair-07.png"));
        assert_eq!(name("hair", 7, 1200), Path::new("hair-0007"));
    }
}
