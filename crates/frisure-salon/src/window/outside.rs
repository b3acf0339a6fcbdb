//! What the window needs of the world: files, a place for the text that survives a crash.

use std::path::PathBuf;

use eframe::egui::DroppedFile;
use frisure::formats::contents;

use crate::state::{Destination, Save};

/// A file on its way.
pub type Dropped = std::sync::Arc<dyn DroppedFile + Send + Sync>;

/// A file that somebody opened or dropped.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Its path, where there are paths.
    pub path: Option<PathBuf>,
    /// Its name.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// The extensions of what can be opened, without dots.
#[must_use]
pub fn extensions() -> Vec<&'static str> {
    let mut all = contents::extensions();
    all.insert(0, "toml");
    all
}

/// The world outside the window.
pub trait Outside {
    /// Writes a file, or hands it to the browser.
    ///
    /// # Errors
    /// What went wrong, for a person.
    fn save(&mut self, save: &Save) -> Result<(), String>;

    /// Keeps a text over a crash, or forgets it.
    ///
    /// # Errors
    /// What went wrong, for a person.
    fn keep(&mut self, text: Option<&str>) -> Result<(), String>;

    /// The text that was kept.
    fn kept(&mut self) -> Option<String>;

    /// Lets a person choose a file to open; it comes through [`Self::given`] later.
    fn ask_for_file(&mut self);

    /// A person dropped a file; what is in it comes through [`Self::given`] later.
    fn take_in(&mut self, file: Dropped);

    /// A file that a person chose or dropped.
    fn given(&mut self) -> Option<Given>;

    /// Whether a destination is a path that the window should ask for; on a page the browser does.
    fn has_paths(&self) -> bool;

    /// Where files go if nobody says otherwise.
    fn folder(&self) -> PathBuf;

    /// Where a file of this name goes.
    fn destination(&self, name: &str) -> Destination {
        match self.has_paths() {
            true => Destination::Path(self.folder().join(name)),
            false => Destination::Download(name.to_owned()),
        }
    }
}
