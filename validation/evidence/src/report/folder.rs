//! The folder of a report.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use frisure::files::{WriteError, write_atomically};

use super::book::Book;
use super::words;
use crate::Experiment;

impl Book<'_> {
    /// Writes the pictures, `report.md` and last `index.html` into a folder, which is made; gives the path of the
    /// page. Each file is whole or as it was, and the page, which has everything inside, is of one run in any case; where
    /// writing fails on the way, a `report.md` that is left may show newer pictures than it tells of. Pictures that
    /// an earlier report in the folder showed and this one does not are removed.
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
            // What cannot be removed is only in the way of tidiness.
            let _ = fs::remove_file(folder.join(name));
        }
        Ok(page)
    }
}

/// The pictures that a report of ours in a folder shows; none where there is no such report.
fn shown_before(folder: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(folder.join("report.md")).unwrap_or_default();
    if !text.starts_with(&format!("# {}\n", words::TITLE)) {
        return BTreeSet::new();
    }
    let links = text.split("](").skip(1).filter_map(|link| link.split(')').next());
    // Names alone: a link that leads out of the folder is none of ours.
    let plain = |name: &&str| {
        [".svg", ".png"].iter().any(|end| name.ends_with(end)) && !name.contains(['/', '\\'])
    };
    links.filter(plain).map(str::to_owned).collect()
}

/// What is in a folder under a name that a picture of these experiments may have.
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
