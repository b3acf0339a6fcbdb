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
    let mut asked = BTreeSet::new();
    for path in outputs {
        let whole = resolved(path);
        let overwritten = read.contains(&whole);
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

/// The path with as much of it as exists made absolute, links followed.
fn resolved(path: &Path) -> PathBuf {
    if let Ok(whole) = fs::canonicalize(path) {
        return whole;
    }
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.into());
    match (absolute.parent(), absolute.file_name()) {
        (Some(folder), Some(name)) => resolved(folder).join(name),
        _ => absolute,
    }
}

/// A path with a number before the extension: `out/hair.png` is `out/hair-07.png`.
pub(crate) fn numbered(path: &Path, number: usize, count: usize) -> PathBuf {
    let digits = count.saturating_sub(1).to_string().len().max(2);
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number:0digits$}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_go_before_the_extension() {
        let name = |path: &str, number, count| numbered(Path::new(path), number, count);
        assert_eq!(name("out/hair.png", 7, 12), Path::new("out/hair-07.png"));
        assert_eq!(name("hair", 7, 1200), Path::new("hair-0007"));
    }
}
