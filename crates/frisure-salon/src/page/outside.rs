//! The world outside the window: the browser.

use super::files::{self, Chosen, Inbox};
use super::storage::{self, StorageError};
use crate::state::Save;
use crate::window::Wake;
use crate::window::outside::{Dropped, Given, Outside, extensions};
use std::path::PathBuf;
use wasm_bindgen_futures::spawn_local;

/// Name of the text that survives a crash.
const KEPT: &str = "kept";

/// Downloads, files that are chosen or dropped, and what the browser keeps.
pub(crate) struct Page {
    inbox: Inbox,
    wake: Wake,
    /// The browser keeps nothing: told once.
    forbidden: bool,
}

impl Page {
    pub(crate) fn new(wake: Wake) -> Self {
        Self { inbox: Inbox::default(), wake, forbidden: false }
    }
}

impl Outside for Page {
    fn save(&mut self, save: &Save) -> Result<(), String> {
        let said = save.to.said();
        let name = said.rsplit(['/', '\\']).next().unwrap_or("salon");
        files::download(name, &save.bytes)
    }

    fn keep(&mut self, text: Option<&str>) -> Result<(), String> {
        let done = match text {
            Some(text) => storage::set(KEPT, text),
            None => storage::remove(KEPT),
        };
        match done {
            Err(StorageError::Forbidden(_)) if std::mem::replace(&mut self.forbidden, true) => {
                Ok(())
            }
            done => done.map_err(|e| e.to_string()),
        }
    }

    fn kept(&mut self) -> Option<String> {
        // A browser that keeps nothing has kept nothing; it is told when there is something to keep.
        storage::get(KEPT).ok().flatten()
    }

    fn ask_for_file(&mut self) {
        // And what lies beside glTF meshes.
        let accept = extensions().into_iter().chain(["bin"]).map(|e| format!(".{e}"));
        let accept = accept.collect::<Vec<_>>().join(",");
        if let Err(problem) = files::choose(&accept, self.inbox.clone(), self.wake.clone()) {
            web_sys::console::warn_1(&problem.into());
        }
    }

    fn take_in(&mut self, file: Dropped) {
        let (inbox, wake) = (self.inbox.clone(), self.wake.clone());
        spawn_local(async move {
            let name = file.path().to_string_lossy().into_owned();
            let bytes = file.bytes_async().await;
            inbox.borrow_mut().push_back(Chosen { name, bytes });
            wake();
        });
    }

    fn given(&mut self) -> Option<Given> {
        let Chosen { name, bytes } = self.inbox.borrow_mut().pop_front()?;
        let bytes = bytes.unwrap_or_else(|problem| {
            web_sys::console::warn_1(&format!("{name}: {problem}").into());
            // What cannot be read is told by name, as what cannot be understood is.
            Vec::new()
        });
        Some(Given { path: None, name, bytes })
    }

    fn has_paths(&self) -> bool {
        false
    }

    fn folder(&self) -> PathBuf {
        PathBuf::new()
    }
}
