//! Heads and grooms from files: finding out what a file has, and naming it in the scene.

use std::path::Path;

use frisure::formats::contents::{self, Contents};
use frisure::scene::key_groups::{GROOM, HEAD};
use frisure::scene::{HeadSource, edit};
use frisure_engine::{Request, Response, SceneRef};
use toml_edit::Value;

use super::controls::files_panel;
use super::document::Document;
use super::jobs::{Job, Purpose};
use super::salon::Salon;
use super::selection::Selected;
use crate::locale::tr;

/// Hair type of a new scene that starts from a head.
const DEFAULT_HAIR_TYPE: &str = "caucasian-wavy";

impl Salon {
    /// Queues an opened or dropped file, to find out what it has.
    pub(super) fn queue_file(&mut self, path: String) {
        if contents::by_name(Path::new(&path)) == Contents::default() {
            let known = contents::extensions().join(", ");
            let hint = tr!("unknown-file.hint", known = known);
            return self.notify(tr!("unknown-file", path = path), hint, true);
        }
        self.pending_files.push_back(path);
    }

    /// Requests the contents of the next queued file; returns whether there is one.
    pub(super) fn inspect_next_file(&mut self) -> bool {
        let Some(path) = self.pending_files.front().cloned() else { return false };
        match &self.jobs.hair {
            Some(Job { purpose: Purpose::Contents, .. }) => {}
            // The file will most likely change the hair that is being computed.
            Some(_) => self.jobs.cancel_hair(),
            None => {
                let request = Request::Contents { path };
                self.jobs.start(Purpose::Contents, SceneRef::default(), request);
            }
        }
        true
    }

    /// Takes the response about the contents of a file.
    pub(super) fn file_inspected(&mut self, response: Response) {
        let Some(path) = self.pending_files.pop_front() else { return };
        match response {
            Response::Contents(contents) => self.use_file(&path, contents),
            Response::Failed(error) => self.report_error(&error),
            _ => {}
        }
    }

    /// Makes a file the scene's head, its groom, or both; begins a scene where there is none.
    pub(super) fn use_file(&mut self, path: &str, contents: Contents) {
        let name = file_name(path);
        let label = match contents {
            Contents { head: true, groom: true } => tr!("file-head-and-hair", name = &*name),
            Contents { groom: true, .. } => tr!("file-hair", name = &*name),
            Contents { .. } => tr!("file-head", name = &*name),
        };
        if self.document.is_none() {
            let stem = Path::new(&name).file_stem().unwrap_or_default().to_string_lossy();
            let text = format!("[hair]\ntype = \"{DEFAULT_HAIR_TYPE}\"\n");
            let text = edit::set_key(&text, "name", &quoted(&stem)).unwrap_or(text);
            let text = edit::set_keys(&text, &keys(&quoted(path), contents)).unwrap_or(text);
            self.open_document(Document::new(stem, None, label, text));
        } else {
            let written = self.as_written(path);
            self.name_file(&label, &written, contents);
        }
        if contents.head && contents.groom {
            let hint = tr!("file-has-both.hint", panel = &*files_panel());
            self.notify(tr!("file-has-both", name = &*name), hint, false);
        }
    }

    fn name_file(&mut self, label: &str, path: &str, contents: Contents) {
        let Some(base) = self.base() else { return };
        if self.names(path, contents) {
            // The user opens the same file again because it has changed.
            self.invalidate_hair();
        } else {
            let text = edit::set_keys(base, &keys(&quoted(path), contents));
            if !self.change(label, text, false) {
                return;
            }
        }
        (self.framed, self.gallery) = (self.framed && !contents.head, false);
        if contents.groom {
            (self.selected, self.isolated) = (Selected::default(), None);
        }
    }

    /// Whether the scene names a file already.
    fn names(&self, path: &str, contents: Contents) -> bool {
        let Some((document, parsed)) = self.document.as_ref().zip(self.scene.as_ref()) else {
            return false;
        };
        let (path, scene) = (document.folder().join(path), &parsed.scene);
        let head = matches!(&scene.head, HeadSource::Mesh(file) if file.path == path);
        let groom = scene.groom.as_ref().is_some_and(|file| file.path == path);
        (head || !contents.head) && (groom || !contents.groom)
    }

    /// Requests refused hair again: a file that was missing may be there now.
    pub(super) fn retry(&mut self) {
        if self.refused.is_some() {
            self.invalidate_hair();
        }
    }

    fn invalidate_hair(&mut self) {
        self.refused = None;
        if let Some(current) = &mut self.current {
            current.key = None;
        }
        self.jobs.cancel_hair();
    }

    /// Uses a file as head or groom; without a path the mannequin, or the scene's own hair.
    pub(super) fn set_file(&mut self, path: Option<String>, contents: Contents) {
        if let Some(path) = path {
            return self.use_file(&path, contents);
        }
        let Some(base) = self.base() else { return };
        // Removing the path removes the keys about the file, too.
        let (label, key) = match contents.head {
            true => (tr!("mannequin-head"), HEAD[0]),
            false => (tr!("own-hair"), GROOM[0]),
        };
        let text = edit::set_keys(base, &[(key, None)]);
        if self.change(&label, text, false) {
            self.framed &= !contents.head;
        }
    }

    /// A path as the scene writes it: relative to the scene's folder, if the file is in it or near it.
    fn as_written(&self, path: &str) -> String {
        let folder = self.document.as_ref().map_or(Path::new(""), Document::folder);
        edit::relative_path(folder, Path::new(path)).unwrap_or_else(|| path.to_owned())
    }

    /// The text with its paths rewritten for another folder.
    pub(super) fn text_in(&self, folder: &Path) -> Option<String> {
        let document = self.document.as_ref()?;
        edit::in_folder(document.text(), document.folder(), folder).ok()
    }
}

/// The edits that name a file: its path, and `None` for the keys about the file before.
fn keys(written: &str, contents: Contents) -> Vec<(&'static str, Option<&str>)> {
    let of = |keys: &[&'static str], wanted: bool| {
        let value = |place: usize| (place == 0).then_some(written);
        let all = keys.iter().enumerate().map(|(place, key)| (*key, value(place)));
        all.filter(|_| wanted).collect::<Vec<_>>()
    };
    // The number of guides applies to any groom and stays.
    let groom: Vec<_> = GROOM.into_iter().filter(|key| *key != "groom.guides").collect();
    [of(&HEAD, contents.head), of(&groom, contents.groom)].concat()
}

fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name();
    name.map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// A TOML string.
pub(super) fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}
