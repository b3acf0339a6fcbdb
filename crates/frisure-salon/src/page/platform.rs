//! The browser: downloads, opened and dropped files, and local storage.

use super::files::{self, Inbox, PickedFile};
use super::storage::{self, StorageError};
use crate::state::Save;
use crate::window::platform::{DroppedFile, InputFile, Platform, extensions};
use crate::work::Wake;
use std::path::PathBuf;
use wasm_bindgen_futures::spawn_local;

/// Name of the autosaved text in the browser's storage; a file format.
const AUTOSAVE: &str = "kept";

/// Name of the chosen language in the browser's storage.
const LANGUAGE: &str = "language";

/// The browser platform.
pub(crate) struct Browser {
    inbox: Inbox,
    wake: Wake,
    /// Whether the salon has reported that the browser forbids storage.
    reported: bool,
}

impl Browser {
    pub(crate) fn new(wake: Wake) -> Self {
        Self { inbox: Inbox::default(), wake, reported: false }
    }
}

impl Platform for Browser {
    fn save(&mut self, save: &Save) -> Result<(), String> {
        let path = save.to.display();
        let name = path.rsplit(['/', '\\']).next().unwrap_or("salon");
        files::download(name, &save.bytes)
    }

    fn write_autosave(&mut self, text: Option<&str>) -> Result<(), String> {
        let done = match text {
            Some(text) => storage::set(AUTOSAVE, text),
            None => storage::remove(AUTOSAVE),
        };
        match done {
            Err(StorageError::Forbidden(_)) if std::mem::replace(&mut self.reported, true) => {
                Ok(())
            }
            done => done.map_err(|e| e.to_string()),
        }
    }

    fn read_autosave(&mut self) -> Option<String> {
        // If the browser forbids storage, the first autosave reports it.
        storage::get(AUTOSAVE).ok().flatten()
    }

    fn read_language(&self) -> Option<String> {
        storage::get(LANGUAGE).ok().flatten()
    }

    fn write_language(&mut self, tag: &str) {
        // If the browser forbids storage, the next visit has the browser's language.
        let _ = storage::set(LANGUAGE, tag);
    }

    fn show_open_dialog(&mut self) {
        // Also the buffers of glTF meshes.
        let accept = extensions().into_iter().chain(["bin"]).map(|e| format!(".{e}"));
        let accept = accept.collect::<Vec<_>>().join(",");
        if let Err(problem) = files::pick(&accept, self.inbox.clone(), self.wake.clone()) {
            web_sys::console::warn_1(&problem.into());
        }
    }

    fn read_dropped(&mut self, file: DroppedFile) {
        let (inbox, wake) = (self.inbox.clone(), self.wake.clone());
        spawn_local(async move {
            let name = file.path().to_string_lossy().into_owned();
            let bytes = file.bytes_async().await;
            inbox.borrow_mut().push_back(PickedFile { name, bytes });
            wake();
        });
    }

    fn next_file(&mut self) -> Option<InputFile> {
        let PickedFile { name, bytes } = self.inbox.borrow_mut().pop_front()?;
        let bytes = bytes.unwrap_or_else(|problem| {
            web_sys::console::warn_1(&format!("{name}: {problem}").into());
            // An unreadable file is reported as one that is not a scene.
            Vec::new()
        });
        Some(InputFile { path: None, name, bytes })
    }

    fn has_paths(&self) -> bool {
        false
    }

    fn link(&self, what: &str, code: &str) -> String {
        let address = web_sys::window().and_then(|window| window.location().href().ok());
        let address = address.unwrap_or_default();
        let page = address.split(['?', '#']).next().unwrap_or_default();
        format!("{page}?{what}={code}")
    }

    fn folder(&self) -> PathBuf {
        PathBuf::new()
    }
}
