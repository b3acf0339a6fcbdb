//! The text of a scene and everything that was done to it: undo and redo without limit.

use std::path::{Path, PathBuf};

/// A scene being edited: a list of texts, each with what led to it.
///
/// A scene is a few kilobytes, so that whole texts are kept, and undo is exact whatever an edit was.
#[derive(Clone, Debug)]
pub struct Document {
    /// What errors and the window's title call it.
    name: String,
    /// The file it is saved to, if it has one.
    path: Option<PathBuf>,
    edits: Vec<Edit>,
    at: usize,
    saved: Option<usize>,
    /// The text while a slider is held.
    draft: Option<String>,
}

/// A text, and what made it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// In words for a person, such as "Cut the fringe".
    pub label: String,
    /// The whole scene after it.
    pub text: String,
}

impl Document {
    /// A scene that was not edited yet; `label` says where it comes from.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        path: Option<PathBuf>,
        label: impl Into<String>,
        text: impl Into<String>,
    ) -> Self {
        let edits = vec![Edit { label: label.into(), text: text.into() }];
        let saved = path.is_some().then_some(0);
        Self { name: name.into(), path, edits, at: 0, saved, draft: None }
    }

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The file it is saved to.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The folder that paths in the scene are relative to; empty for one without a file.
    #[must_use]
    pub fn folder(&self) -> &Path {
        self.path().and_then(Path::parent).unwrap_or(Path::new(""))
    }

    /// The text as it is now, a slider that is held included.
    #[must_use]
    pub fn text(&self) -> &str {
        self.draft.as_deref().unwrap_or(&self.edits[self.at].text)
    }

    /// Every text, the one it began with first.
    #[must_use]
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// Which of [`Self::edits`] is shown.
    #[must_use]
    pub fn at(&self) -> usize {
        self.at
    }

    /// Whether a slider is held.
    #[must_use]
    pub fn is_draft(&self) -> bool {
        self.draft.is_some()
    }

    /// Whether something would be lost that was not saved.
    #[must_use]
    pub fn is_changed(&self) -> bool {
        // What a scene began with can be had again without a file.
        let kept = self.saved.or((self.path.is_none()).then_some(0));
        let same = |i: usize| self.edits.get(i).is_some_and(|e| e.text == self.text());
        !kept.is_some_and(same)
    }

    /// Shows a text without keeping the one before: a slider moves.
    pub fn draft(&mut self, text: String) {
        self.draft = Some(text);
    }

    /// Makes a new text the current one; what was undone is forgotten.
    pub fn change(&mut self, label: impl Into<String>, text: String) {
        self.draft = None;
        if text == self.edits[self.at].text {
            return;
        }
        self.edits.truncate(self.at + 1);
        if self.saved.is_some_and(|saved| saved > self.at) {
            self.saved = None;
        }
        self.edits.push(Edit { label: label.into(), text });
        self.at += 1;
    }

    /// The slider is let go: what it showed last is kept.
    pub fn keep_draft(&mut self, label: impl Into<String>) {
        if let Some(text) = self.draft.take() {
            self.change(label, text);
        }
    }

    /// Forgets what a held slider showed.
    pub fn drop_draft(&mut self) {
        self.draft = None;
    }

    /// Shows another of the texts; `false` if there is none, or it is shown already.
    pub fn go_to(&mut self, at: usize) -> bool {
        let other = at < self.edits.len() && at != self.at;
        if other {
            (self.at, self.draft) = (at, None);
        }
        other
    }

    /// It was saved as it is.
    pub fn saved_to(&mut self, path: PathBuf) {
        if let Some(name) = path.file_name() {
            self.name = name.to_string_lossy().into_owned();
        }
        self.path = Some(path);
        self.saved = Some(self.at);
    }

    /// Nobody has it as it is, such as after a crash.
    pub(super) fn unsaved(&mut self) {
        self.saved = Some(usize::MAX);
    }

    /// A copy of it was handed out, such as a page's download.
    pub fn handed_out(&mut self) {
        self.saved = Some(self.at);
    }
}
