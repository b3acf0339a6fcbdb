//! The edited text of a scene, with unlimited undo and redo.

use std::path::{Path, PathBuf};

/// An edited scene: a list of texts, each with the label of its edit.
///
/// A scene is a few kilobytes, so the document stores whole texts, and undo is exact for every edit.
#[derive(Clone, Debug)]
pub struct Document {
    /// Its name in errors and in the window.
    name: String,
    /// The file it is saved to, if it has one.
    path: Option<PathBuf>,
    edits: Vec<Edit>,
    at: usize,
    saved: Option<usize>,
    /// The text while a slider or the comb is dragged.
    draft: Option<String>,
}

/// A text, and the label of the edit that made it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The label, such as "Length: 18 cm".
    pub label: String,
    /// The whole text after the edit.
    pub text: String,
}

impl Document {
    /// An unedited scene; `label` names its origin.
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

    /// Its name.
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

    /// The current text, with the draft of what is dragged.
    #[must_use]
    pub fn text(&self) -> &str {
        self.draft.as_deref().unwrap_or(&self.edits[self.at].text)
    }

    /// All texts, the first one first.
    #[must_use]
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// The index of the current text in [`Self::edits`].
    #[must_use]
    pub fn at(&self) -> usize {
        self.at
    }

    /// Whether the user drags a slider or the comb.
    #[must_use]
    pub fn is_draft(&self) -> bool {
        self.draft.is_some()
    }

    /// Whether there are unsaved changes.
    #[must_use]
    pub fn is_changed(&self) -> bool {
        // The first text of a scene without a file is from the gallery and does not need to be saved.
        let saved = self.saved.or((self.path.is_none()).then_some(0));
        let same = |i: usize| self.edits.get(i).is_some_and(|e| e.text == self.text());
        !saved.is_some_and(same)
    }

    /// Replaces the current text during a drag of a slider or of the comb, without an edit.
    pub fn draft(&mut self, text: String) {
        self.draft = Some(text);
    }

    /// Adds an edit and makes it the current one; edits that were undone are dropped.
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

    /// Makes the draft an edit.
    pub fn keep_draft(&mut self, label: impl Into<String>) {
        if let Some(text) = self.draft.take() {
            self.change(label, text);
        }
    }

    /// Drops the draft.
    pub fn drop_draft(&mut self) {
        self.draft = None;
    }

    /// Makes another text the current one; `false` if it does not exist or is the current one already.
    pub fn go_to(&mut self, at: usize) -> bool {
        let other = at < self.edits.len() && at != self.at;
        if other {
            (self.at, self.draft) = (at, None);
        }
        other
    }

    /// Marks the current text as saved to a file.
    pub fn saved_to(&mut self, path: PathBuf) {
        if let Some(name) = path.file_name() {
            self.name = name.to_string_lossy().into_owned();
        }
        self.path = Some(path);
        self.saved = Some(self.at);
    }

    /// Marks all texts as unsaved, as after a crash.
    pub(super) fn mark_unsaved(&mut self) {
        self.saved = Some(usize::MAX);
    }

    /// Marks the current text as saved without a file, as by a download.
    pub fn mark_saved(&mut self) {
        self.saved = Some(self.at);
    }
}
