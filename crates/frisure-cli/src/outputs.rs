//! Files to be written: checked before the work, so that nobody waits for a result that has no
//! place.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use frisure::files::{self, WriteError};

use crate::failure::Failure;

/// Checks that all `outputs` are different files, that none is one of the `inputs`, and that each
/// can be written; makes their folders.
pub(crate) fn prepare(outputs: &[&Path], inputs: &[&Path]) -> Result<(), Failure> {
    let read: BTreeSet<PathBuf> = inputs.iter().map(|path| resolved(path)).collect();
    let mut asked = BTreeSet::new();
    for path in outputs {
        let whole = resolved(path);
        let overwritten = read.contains(&whole);
        if !asked.insert(whole) {
            let message = format!("`{}` is asked for twice", path.display());
            return Err(Failure::wrong_because(message, "give each output a name of its own"));
        }
        if overwritten {
            let message = format!("`{}` is read and would be overwritten", path.display());
            return Err(Failure::wrong_because(message, "give the output another name"));
        }
    }
    for path in outputs {
        if let Some(folder) = path.parent().filter(|p| !p.as_os_str().is_empty()) {
            fs::create_dir_all(folder).map_err(|source| {
                let path = folder.to_path_buf();
                Failure::failed(&WriteError::Io { path, source })
            })?;
        }
        files::check_destination(path).map_err(|e| Failure::failed(&e))?;
    }
    Ok(())
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
