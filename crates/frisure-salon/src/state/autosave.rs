//! The text that survives a crash.

use std::path::{Path, PathBuf};

use super::Document;

/// First line of what is kept: what follows is the path of the scene's file, if it had one, and what it
/// is called.
const MARK: &str = "# kept by the salon, not saved; file: ";
const NAME: &str = "; name: ";

/// Seconds from a change to when it is kept.
pub(super) const AFTER: f64 = 1.0;

/// What is kept of a document.
#[must_use]
pub(super) fn keep(document: &Document) -> String {
    let path = document.path().unwrap_or(Path::new("")).display();
    // A name with a line's end would be part of the scene.
    let name = document.name().replace(char::is_control, " ");
    format!("{MARK}{path}{NAME}{name}\n{}", document.text())
}

/// A document that was kept; `None` for a text that no salon wrote.
#[must_use]
pub(super) fn kept(text: &str) -> Option<Document> {
    let (first, rest) = text.split_once('\n')?;
    let (path, name) = first.strip_prefix(MARK)?.rsplit_once(NAME)?;
    let path = path.trim();
    let path = (!path.is_empty()).then(|| PathBuf::from(path));
    let mut document = Document::new(name, path, "Recovered", rest);
    document.unsaved();
    Some(document)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_comes_back() {
        for path in [None, Some(PathBuf::from("/a b/Ringlets.toml"))] {
            let document =
                Document::new("x", path.clone(), "Opened", "[hair]\nlength = \"9 cm\"\n");
            let back = kept(&keep(&document)).unwrap();
            assert_eq!((back.text(), back.path()), (document.text(), path.as_deref()));
            assert!(back.is_changed());
        }
        assert!(kept("anything").is_none() && kept("a\nb").is_none());
    }
}
