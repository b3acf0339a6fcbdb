//! The world outside a window of the desktop.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};

use frisure::files::{read_bytes, write_atomically};
use frisure::formats::contents::{self, Contents};

use super::outside::{Dropped, Given, Outside, extensions};
use crate::state::{Destination, Save};

/// Largest file that is opened (bytes).
const MOST: u64 = 1 << 30;

/// Files of the system, and its dialog.
pub struct Desktop {
    /// Where the text that survives a crash is.
    kept: Option<PathBuf>,
    given: (Sender<Given>, Receiver<Given>),
    wake: super::Wake,
}

impl Desktop {
    /// The usual folders of the system; `kept` overrides where the text is kept.
    #[must_use]
    pub fn new(kept: Option<PathBuf>, wake: super::Wake) -> Self {
        let usual = || {
            let dirs = directories::ProjectDirs::from("", "", "frisure")?;
            Some(dirs.data_local_dir().join("salon-kept.toml"))
        };
        Self { kept: kept.or_else(usual), given: channel(), wake }
    }
}

/// Reads a file that somebody names. Heads and grooms are read where hair is computed.
///
/// # Errors
/// What went wrong, for a person.
pub fn read(path: &Path) -> Result<Given, String> {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let bytes = match contents::by_name(path) == Contents::default() {
        true => read_bytes(path, MOST, "a file").map_err(|e| full(&e))?,
        false => Vec::new(),
    };
    // A scene names it from its own folder.
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.into());
    Ok(Given { path: Some(whole), name, bytes })
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

impl Outside for Desktop {
    fn save(&mut self, save: &Save) -> Result<(), String> {
        match &save.to {
            Destination::Path(path) => write(path, &save.bytes),
            Destination::Download(name) => write(&self.folder().join(name), &save.bytes),
        }
    }

    fn keep(&mut self, text: Option<&str>) -> Result<(), String> {
        let Some(path) = &self.kept else { return Ok(()) };
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

    fn kept(&mut self) -> Option<String> {
        std::fs::read_to_string(self.kept.as_ref()?).ok()
    }

    fn ask_for_file(&mut self) {
        let sender = self.given.0.clone();
        let wake = self.wake.clone();
        // The dialog blocks, and the window must not.
        std::thread::spawn(move || {
            let dialog = rfd::FileDialog::new()
                .set_title("Open a scene, a head or a groom")
                .add_filter("Scenes, heads and grooms", &extensions());
            if let Some(given) = dialog.pick_file().and_then(|path| read(&path).ok())
                && sender.send(given).is_ok()
            {
                wake();
            }
        });
    }

    fn take_in(&mut self, file: Dropped) {
        // What cannot be read is told by name, as what cannot be understood is.
        let path = file.path();
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let given =
            read(path).unwrap_or(Given { path: Some(path.into()), name, bytes: Vec::new() });
        let _ = self.given.0.send(given);
    }

    fn given(&mut self) -> Option<Given> {
        self.given.1.try_recv().ok()
    }

    fn has_paths(&self) -> bool {
        true
    }

    fn folder(&self) -> PathBuf {
        std::env::current_dir().unwrap_or_default()
    }
}
