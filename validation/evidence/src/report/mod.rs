//! Findings as documents: one page that opens offline, and Markdown with its pictures beside it.

mod html;
mod markdown;
pub(crate) mod words;

use std::fs;
use std::path::{Path, PathBuf};

use frisure::io::files::{WriteError, write_atomically};

use crate::{Effort, Experiment, Finding, Item};

/// Every experiment that was run, and what it found.
pub struct Book<'a> {
    /// How much was computed.
    pub effort: Effort,
    /// In the order of the report.
    pub chapters: Vec<(&'a Experiment, Finding)>,
}

impl Book<'_> {
    /// Whether every criterion of every finding holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.chapters.iter().all(|(_, finding)| finding.holds())
    }

    /// One page with everything inside.
    #[must_use]
    pub fn html(&self) -> String {
        html::page(self)
    }

    /// Markdown that refers to files of [`Self::pictures`].
    #[must_use]
    pub fn markdown(&self) -> String {
        markdown::page(self)
    }

    /// Names (with extensions) and bytes of plots and pictures.
    #[must_use]
    pub fn pictures(&self) -> Vec<(String, Vec<u8>)> {
        let mut files = Vec::new();
        for (experiment, finding) in &self.chapters {
            for (number, item) in finding.items.iter().enumerate() {
                match item {
                    Item::Plot(plot) => {
                        files.push((plot_name(experiment, number), plot.to_string().into_bytes()));
                    }
                    Item::Picture(picture) => {
                        files.push((format!("{}.png", picture.name), picture.png.clone()));
                    }
                    Item::Text(_) | Item::Table(_) => {}
                }
            }
        }
        files
    }

    /// Writes `index.html`, `report.md` and the pictures into a folder, which is made; gives the paths
    /// of the two.
    ///
    /// # Errors
    /// [`WriteError`], if a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<[PathBuf; 2], WriteError> {
        let io = |source| WriteError::Io { path: folder.to_path_buf(), source };
        fs::create_dir_all(folder).map_err(io)?;
        let write = |name: &str, bytes: &[u8]| {
            let path = folder.join(name);
            write_atomically(&path, |out| out.write_all(bytes)).map(|()| path)
        };
        for (name, bytes) in self.pictures() {
            write(&name, &bytes)?;
        }
        Ok([
            write("index.html", self.html().as_bytes())?,
            write("report.md", self.markdown().as_bytes())?,
        ])
    }
}

/// The file of the plot that is the `number`th item of a finding.
fn plot_name(experiment: &Experiment, number: usize) -> String {
    format!("{}-{number}.svg", experiment.name)
}
