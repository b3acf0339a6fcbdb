//! The desktop: files, the system's dialog, and the autosave file.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};

use frisure::files::{read_bytes, write_atomically};
use frisure::formats::contents::{self, Contents};

use super::platform::{DroppedFile, InputFile, Platform, extensions};
use crate::locale::tr;
use crate::state::{Destination, Save};
use crate::work::Wake;

/// Maximum size of a scene (bytes).
const MAX_SIZE: u64 = 1 << 30;

/// The desktop platform.
pub struct Desktop {
    autosave: Option<PathBuf>,
    /// The file with the tag of the chosen language.
    language: Option<PathBuf>,
    files: (Sender<InputFile>, Receiver<InputFile>),
    wake: Wake,
}

impl Desktop {
    /// Creates it with an autosave file; by default one in the user's data folder.
    #[must_use]
    pub fn new(autosave: Option<PathBuf>, wake: Wake) -> Self {
        let usual = || {
            let dirs = directories::ProjectDirs::from("", "", "frisure")?;
            Some(dirs.data_local_dir().join("salon-kept.toml"))
        };
        let autosave = autosave.or_else(usual);
        let language = autosave.as_ref().map(|path| path.with_file_name("salon-language"));
        Self { autosave, language, files: channel(), wake }
    }
}

/// Reads a scene; for a head or groom, only its name and path, because the engine reads its contents.
///
/// # Errors
/// The reason, for a message.
pub fn read(path: &Path) -> Result<InputFile, String> {
    let bytes = match contents::by_name(path) == Contents::default() {
        true => read_bytes(path, MAX_SIZE, "a file").map_err(|e| full(&e))?,
        false => Vec::new(),
    };
    Ok(InputFile { bytes, ..unread(path) })
}

/// A file without its contents.
fn unread(path: &Path) -> InputFile {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    // The scene's folder is not the working folder.
    let path = std::path::absolute(path).unwrap_or_else(|_| path.into());
    InputFile { path: Some(path), name, bytes: Vec::new() }
}

fn full(error: &dyn std::error::Error) -> String {
    match error.source() {
        Some(cause) => format!("{error}: {cause}"),
        None => error.to_string(),
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    write_atomically(path, |out| out.write_all(bytes)).map_err(|e| full(&e))
}

impl Platform for Desktop {
    fn save(&mut self, save: &Save) -> Result<(), String> {
        match &save.to {
            Destination::Path(path) => write(path, &save.bytes),
            Destination::Download(name) => write(&self.folder().join(name), &save.bytes),
        }
    }

    fn write_autosave(&mut self, text: Option<&str>) -> Result<(), String> {
        let Some(path) = &self.autosave else { return Ok(()) };
        match text {
            Some(text) => {
                let folder = path.parent().unwrap_or(Path::new(""));
                std::fs::create_dir_all(folder).map_err(|e| e.to_string())?;
                write(path, text.as_bytes())
            }
            None => match std::fs::remove_file(path) {
                Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(e.to_string()),
                _ => Ok(()),
            },
        }
    }

    fn read_autosave(&mut self) -> Option<String> {
        std::fs::read_to_string(self.autosave.as_ref()?).ok()
    }

    fn read_language(&self) -> Option<String> {
        std::fs::read_to_string(self.language.as_ref()?).ok()
    }

    fn write_language(&mut self, tag: &str) {
        let Some(path) = &self.language else { return };
        let folder = path.parent().unwrap_or(Path::new(""));
        // The choice is made again in a moment; a message about it would be in the way.
        if std::fs::create_dir_all(folder).is_ok() {
            let _ = write(path, tag.as_bytes());
        }
    }

    fn show_open_dialog(&mut self) {
        let (sender, wake) = (self.files.0.clone(), self.wake.clone());
        // The language is that of this thread.
        let (title, filter) = (tr!("open-title"), tr!("open-filter"));
        // The dialog blocks its thread.
        std::thread::spawn(move || {
            let dialog = rfd::FileDialog::new().set_title(title).add_filter(filter, &extensions());
            if let Some(file) = dialog.pick_file().and_then(|path| read(&path).ok())
                && sender.send(file).is_ok()
            {
                wake();
            }
        });
    }

    fn read_dropped(&mut self, file: DroppedFile) {
        // An unreadable file is reported as one that is not a scene.
        let file = read(file.path()).unwrap_or_else(|_| unread(file.path()));
        let _ = self.files.0.send(file);
    }

    fn next_file(&mut self) -> Option<InputFile> {
        self.files.1.try_recv().ok()
    }

    fn has_paths(&self) -> bool {
        true
    }

    fn folder(&self) -> PathBuf {
        std::env::current_dir().unwrap_or_default()
    }
}
