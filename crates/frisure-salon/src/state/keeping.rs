//! Files that leave the salon, and the text that survives a crash.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use frisure::formats::groom::Format;
use frisure_engine::Request;

use super::command::understand;
use super::desk::Purpose;
use super::{Document, Errand, Salon, autosave};

/// A file for the world outside to write.
#[derive(Clone, Debug, PartialEq)]
pub struct Save {
    /// Where to.
    pub to: Destination,
    /// What is in it.
    pub bytes: Vec<u8>,
    /// Whether it is the scene itself: then its end is told by [`Salon::saved`].
    pub is_scene: bool,
}

/// Where a file goes.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination {
    /// To a path.
    Path(PathBuf),
    /// Under a name to wherever the browser keeps what it is given.
    Download(String),
}

impl Destination {
    /// Its extension, in small letters.
    #[must_use]
    pub fn extension(&self) -> String {
        let path = match self {
            Self::Path(path) => path.as_path(),
            Self::Download(name) => Path::new(name),
        };
        path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
    }

    /// What a person calls it.
    #[must_use]
    pub fn said(&self) -> String {
        match self {
            Self::Path(path) => path.display().to_string(),
            Self::Download(name) => name.clone(),
        }
    }
}

/// Groom formats that can be exported: extension, and what it is.
pub const FORMATS: [(&str, &str); Format::ALL.len()] = {
    let mut formats = [("", ""); Format::ALL.len()];
    let mut i = 0;
    while i < formats.len() {
        formats[i] = (Format::ALL[i].extensions()[0], Format::ALL[i].title());
        i += 1;
    }
    formats
};

impl Salon {
    /// Hands the scene out to be written.
    pub(super) fn save(&mut self, to: Destination) {
        let Some(document) = &self.document else { return };
        let folder = match &to {
            Destination::Path(path) => path.parent().unwrap_or(Path::new("")),
            Destination::Download(_) => document.folder(),
        };
        // A scene that moves still names the same files.
        let text = self.text_in(folder).unwrap_or_else(|| document.text().to_owned());
        let bytes = text.into_bytes();
        self.desk.errands.push_back(Errand::Save(Save { to, bytes, is_scene: true }));
    }

    /// Orders a groom file.
    pub(super) fn export(&mut self, to: Destination) {
        let Some(asked) = self.asked() else { return };
        let format = to.extension();
        if !FORMATS.iter().any(|(extension, _)| *extension == format) {
            let known: Vec<String> = FORMATS.iter().map(|f| format!(".{}", f.0)).collect();
            let hint = format!("Grooms are written as {}.", known.join(", "));
            self.tell(format!("no groom is called `{}`", to.said()), hint, true);
            return;
        }
        let order = Request::Groom { scene: asked.clone(), format };
        self.desk.queue(Purpose::File(to), asked, order);
    }

    /// A file was written, or not.
    pub fn saved(&mut self, save: &Save, result: Result<(), String>) {
        match result {
            Ok(()) => {
                self.tell(format!("Saved {}.", save.to.said()), "", false);
                if let (true, Some(document)) = (save.is_scene, &mut self.document) {
                    match &save.to {
                        Destination::Path(path) => {
                            if let Ok(text) = std::str::from_utf8(&save.bytes) {
                                document.change("Paths from its folder", text.to_owned());
                            }
                            document.saved_to(path.clone());
                        }
                        Destination::Download(_) => document.handed_out(),
                    }
                    if let Ok(understood) = understand(document, document.text()) {
                        self.scene = Some(Arc::new(understood));
                    }
                    self.forget_kept();
                }
            }
            Err(problem) => {
                let hint = "Nothing was overwritten. Save it under another name.";
                self.tell(format!("cannot save {}: {problem}", save.to.said()), hint, true);
            }
        }
    }

    /// Keeps the text a while after it changed.
    pub(super) fn keep_now_and_then(&mut self, now: f64) {
        let Some(document) = &self.document else { return };
        let kept = autosave::keep(document);
        if !document.is_changed() {
            if self.kept.is_some() {
                self.forget_kept();
            }
            self.changed_at = None;
        } else if self.kept.as_ref() != Some(&kept) {
            let since = *self.changed_at.get_or_insert(now);
            // A slider that is held for minutes is kept, too.
            if now - since >= autosave::AFTER {
                self.desk.errands.push_back(Errand::Autosave(Some(kept.clone())));
                (self.kept, self.changed_at) = (Some(kept), None);
            }
        }
    }

    fn forget_kept(&mut self) {
        (self.kept, self.changed_at) = (None, None);
        self.desk.errands.push_back(Errand::Autosave(None));
    }

    /// What another start of the salon kept and nobody saved.
    pub fn found_kept(&mut self, text: &str) {
        self.recoverable = autosave::kept(text);
        if self.recoverable.is_none() && !text.trim().is_empty() {
            let hint = "It is left as it is until something else is kept.";
            self.tell("what was kept over the last crash cannot be read", hint, true);
        }
    }

    /// Takes up what was kept, or forgets it.
    pub(super) fn recover(&mut self, wanted: bool) {
        let Some(document) = self.recoverable.take() else { return };
        if wanted {
            self.open_document(document);
        } else {
            self.forget_kept();
        }
    }

    /// The name that a new file of this scene would have.
    #[must_use]
    pub fn file_name(&self, extension: &str) -> String {
        let name = self.document.as_ref().map_or("hair", Document::name);
        let stem = Path::new(name).file_stem().map(|s| s.to_string_lossy().to_string());
        let stem = stem.filter(|s| !s.is_empty()).unwrap_or_else(|| "hair".into());
        let plain = |c: char| if c.is_alphanumeric() || "-_. ".contains(c) { c } else { '-' };
        format!("{}.{extension}", stem.chars().map(plain).collect::<String>().to_lowercase())
    }
}
