//! The folder of a report.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use frisure::files::{WriteError, write_atomically};

use super::book::Book;
use super::words;
use crate::Experiment;

impl Book<'_> {
    /// Writes the pictures, `report.md` and last `index.html` into a folder, and returns the path of the
    /// page. It creates the folder if needed. Each file is written as a whole, and the page, which contains all pictures, is
    /// always of one run. If writing fails, an old `report.md` may refer to newer pictures. Pictures of
    /// an earlier report in the folder that this report does not have are removed.
    ///
    /// # Errors
    /// [`WriteError`], if a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf, WriteError> {
        let io = |source| WriteError::Io { path: folder.to_path_buf(), source };
        fs::create_dir_all(folder).map_err(io)?;
        let mut old = shown_before(folder);
        let write = |name: &str, bytes: &[u8]| {
            let path = folder.join(name);
            write_atomically(&path, |out| out.write_all(bytes)).map(|()| path)
        };
        for (name, bytes) in self.pictures() {
            write(&name, &bytes)?;
            old.remove(&name);
        }
        write("report.md", self.markdown().as_bytes())?;
        let page = write("index.html", self.html().as_bytes())?;
        for name in old {
            // A picture that cannot be removed does no harm.
            let _ = fs::remove_file(folder.join(name));
        }
        Ok(page)
    }
}

/// The pictures of a report in a folder; empty if the folder has no report of frisure.
fn shown_before(folder: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(folder.join("report.md")).unwrap_or_default();
    if !text.starts_with(&format!("# {}\n", words::TITLE)) {
        return BTreeSet::new();
    }
    let links = text.split("](").skip(1).filter_map(|link| link.split(')').next());
    // Only names: a link out of the folder is not a picture of the report.
    let plain = |name: &&str| {
        [".svg", ".png"].iter().any(|end| name.ends_with(end)) && !name.contains(['/', '\\'])
    };
    links.filter(plain).map(str::to_owned).collect()
}

/// The files of a folder with names of pictures of these experiments.
#[must_use]
pub fn in_the_way(folder: &Path, experiments: &[&Experiment]) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let ours = |name: &str| {
        let of = |e: &&Experiment| {
            let rest = name.strip_prefix(e.name).and_then(|rest| rest.strip_prefix('-'));
            rest.and_then(|rest| rest.strip_suffix(".svg")).is_some_and(number)
        };
        let figure = name.strip_prefix("figure-").and_then(|rest| rest.strip_suffix(".png"));
        experiments.iter().any(of) || figure.is_some_and(number)
    };
    let mut found: Vec<PathBuf> = entries
        .flatten()
        .filter(|e| e.file_name().to_str().is_some_and(ours))
        .map(|e| e.path())
        .collect();
    found.sort();
    found
}
