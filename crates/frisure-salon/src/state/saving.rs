//! Files that the salon writes, and the autosaved text that survives a crash.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use frisure_engine::Request;

use super::document::Document;
use super::jobs::{Destination, Effect, FORMATS, Purpose, Save};
use super::salon::{Salon, parse};
use crate::locale::tr;

/// First line of an autosaved text, before the path of the scene's file; a file format.
const MARK: &str = "# kept by the salon, not saved; file: ";
/// Separates the path from the document's name.
const NAME: &str = "; name: ";

/// Seconds from a change to its autosave.
const AUTOSAVE_DELAY: f64 = 1.0;

/// The autosaved text of a document.
fn autosave_text(document: &Document) -> String {
    let path = document.path().unwrap_or(Path::new("")).display();
    // A line break in the name would end the first line.
    let name = document.name().replace(char::is_control, " ");
    format!("{MARK}{path}{NAME}{name}\n{}", document.text())
}

/// The document of an autosaved text; `None` for any other text.
fn recovered(text: &str) -> Option<Document> {
    let (first, rest) = text.split_once('\n')?;
    let (path, name) = first.strip_prefix(MARK)?.rsplit_once(NAME)?;
    let path = path.trim();
    let path = (!path.is_empty()).then(|| PathBuf::from(path));
    let mut document = Document::new(name, path, tr!("recovered"), rest);
    document.mark_unsaved();
    Some(document)
}

impl Salon {
    /// Queues the scene to be written.
    pub(super) fn save(&mut self, to: Destination) {
        let Some(document) = &self.document else { return };
        let folder = match &to {
            Destination::Path(path) => path.parent().unwrap_or(Path::new("")),
            Destination::Download(_) => document.folder(),
        };
        // A scene saved in another folder still refers to the same files.
        let text = self.text_in(folder).unwrap_or_else(|| document.text().to_owned());
        let bytes = text.into_bytes();
        self.jobs.effects.push_back(Effect::Save(Save { to, bytes, is_scene: true }));
    }

    /// Requests a groom file.
    pub(super) fn export(&mut self, to: Destination) {
        let Some(scene) = self.scene_ref() else { return };
        let format = to.extension();
        if !FORMATS.iter().any(|(extension, _)| *extension == format) {
            let known: Vec<String> = FORMATS.iter().map(|f| format!(".{}", f.0)).collect();
            let hint = tr!("not-a-groom.hint", known = known.join(", "));
            let problem = tr!("not-a-groom", path = to.display());
            return self.notify(problem, hint, true);
        }
        let request = Request::Groom { scene: scene.clone(), format };
        self.jobs.enqueue(Purpose::File(to), scene, request);
    }

    /// Takes the result of [`Effect::Save`].
    pub fn saved(&mut self, save: &Save, result: Result<(), String>) {
        if let Err(problem) = result {
            let text = tr!("not-saved", path = save.to.display(), problem = problem);
            return self.notify(text, tr!("not-saved.hint"), true);
        }
        self.notify(tr!("saved", path = save.to.display()), "", false);
        let Some(document) = self.document.as_mut().filter(|_| save.is_scene) else { return };
        match &save.to {
            Destination::Path(path) => {
                if let Ok(text) = std::str::from_utf8(&save.bytes) {
                    document.change(tr!("paths-from-folder"), text.to_owned());
                }
                document.saved_to(path.clone());
            }
            Destination::Download(_) => document.mark_saved(),
        }
        if let Ok(parsed) = parse(document, document.text()) {
            self.scene = Some(Arc::new(parsed));
        }
        self.discard_autosave();
    }

    /// Autosaves a changed text after [`AUTOSAVE_DELAY`].
    pub(super) fn autosave(&mut self, now: f64) {
        let Some(document) = &self.document else { return };
        let text = autosave_text(document);
        if !document.is_changed() {
            if self.autosaved.is_some() {
                self.discard_autosave();
            }
            self.changed_at = None;
        } else if self.autosaved.as_ref() != Some(&text) {
            // The delay counts from the first change, so that a long drag of a slider is saved too.
            let since = *self.changed_at.get_or_insert(now);
            if now - since >= AUTOSAVE_DELAY {
                self.jobs.effects.push_back(Effect::Autosave(Some(text.clone())));
                (self.autosaved, self.changed_at) = (Some(text), None);
            }
        }
    }

    fn discard_autosave(&mut self) {
        (self.autosaved, self.changed_at) = (None, None);
        self.jobs.effects.push_back(Effect::Autosave(None));
    }

    /// Offers the text that an earlier run autosaved.
    pub fn offer_recovery(&mut self, text: &str) {
        self.recoverable = recovered(text);
        if self.recoverable.is_none() && !text.trim().is_empty() {
            self.notify(tr!("autosave-unreadable"), tr!("autosave-unreadable.hint"), true);
        }
    }

    /// Opens the recovered document, or deletes it.
    pub(super) fn recover(&mut self, wanted: bool) {
        let Some(document) = self.recoverable.take() else { return };
        if wanted {
            self.open_document(document);
        } else {
            self.discard_autosave();
        }
    }

    /// A name for a new file of this scene.
    #[must_use]
    pub fn file_name(&self, extension: &str) -> String {
        let name = self.document.as_ref().map_or("hair", Document::name);
        let stem = Path::new(name).file_stem().map(|s| s.to_string_lossy().to_string());
        let stem = stem.filter(|s| !s.is_empty()).unwrap_or_else(|| "hair".into());
        let plain = |c: char| if c.is_alphanumeric() || "-_. ".contains(c) { c } else { '-' };
        format!("{}.{extension}", stem.chars().map(plain).collect::<String>().to_lowercase())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_autosaved_document_is_recovered() {
        for path in [None, Some(PathBuf::from("/a b/Ringlets.toml"))] {
            let document =
                Document::new("x", path.clone(), "Opened", "[hair]\nlength = \"9 cm\"\n");
            let back = recovered(&autosave_text(&document)).unwrap();
            assert_eq!((back.text(), back.path()), (document.text(), path.as_deref()));
            assert!(back.is_changed());
        }
        assert!(recovered("anything").is_none() && recovered("a\nb").is_none());
    }
}
