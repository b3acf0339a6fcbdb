//! The interface to desktop or browser: files, dialogs, and storage for the autosaved text.

use std::path::PathBuf;
use std::sync::Arc;

use frisure::formats::contents;

use crate::state::Save;

/// A file that was dropped on the window.
pub type DroppedFile = Arc<dyn eframe::egui::DroppedFile + Send + Sync>;

/// An opened or dropped file.
#[derive(Clone, Debug, PartialEq)]
pub struct InputFile {
    /// Its path, if the platform has paths.
    pub path: Option<PathBuf>,
    /// Its name.
    pub name: String,
    /// Its contents; empty for a head or groom with a path, which the engine reads.
    pub bytes: Vec<u8>,
}

/// The extensions of the files that can be opened, without dots.
#[must_use]
pub fn extensions() -> Vec<&'static str> {
    [vec!["toml", "png", "jpg", "jpeg"], contents::extensions()].concat()
}

/// The interface of desktop or browser for the window.
pub trait Platform {
    /// Writes a file, or passes it to the browser as a download.
    ///
    /// # Errors
    /// The reason, for a message.
    fn save(&mut self, save: &Save) -> Result<(), String>;

    /// Stores the autosaved text; `None` deletes it.
    ///
    /// # Errors
    /// The reason, for a message.
    fn write_autosave(&mut self, text: Option<&str>) -> Result<(), String>;

    /// The autosaved text.
    fn read_autosave(&mut self) -> Option<String>;

    /// The tag of the language that was chosen before.
    fn read_language(&self) -> Option<String> {
        None
    }

    /// Keeps the tag of the chosen language for the next start. Where this is impossible, the next start has the system's language.
    fn write_language(&mut self, _tag: &str) {}

    /// Shows the system's dialog to open files; they come through [`Self::next_file`].
    fn show_open_dialog(&mut self);

    /// Reads a dropped file; it comes through [`Self::next_file`].
    fn read_dropped(&mut self, file: DroppedFile);

    /// The next opened or dropped file.
    fn next_file(&mut self) -> Option<InputFile>;

    /// Whether files have paths, so that dialogs have a field for them; in a browser they do not.
    fn has_paths(&self) -> bool;

    /// A link to a page of the salon that opens a scene by its code, as a `scene` or an `exercise`.
    fn link(&self, what: &str, code: &str) -> String {
        // Where pages of the salon are is not known on a desktop.
        format!("?{what}={code}")
    }

    /// The folder that dialogs propose.
    fn folder(&self) -> PathBuf;
}
