//! Heads and grooms from files: which of them a file is, and the scene that names it.

use std::path::{Component, Path, PathBuf};

use frisure::formats::contents::{self, Contents};
use frisure::scene::{HeadSource, edit};
use frisure_engine::{Diagnostic, Request, Response, SceneRef};
use toml_edit::{DocumentMut, Value};

use super::desk::{Job, Purpose};
use super::{Chosen, Document, Salon};

/// The panel in which unit and axis of a file are said.
pub const FILES_PANEL: &str = "Head and groom";

/// The hair with which a head that is opened first begins.
const USUAL_HAIR: &str = "caucasian-wavy";

/// What the keys of a head are, and of a groom: those of another file mean nothing for this one.
const HEAD: [&str; 8] = [
    "head.mesh",
    "head.up",
    "head.unit",
    "head.scale",
    "head.scalp_group",
    "head.scalp_colour",
    "head.scalp_mask",
    "head.scalp_weights",
];
const GROOM: [&str; 3] = ["groom.file", "groom.up", "groom.unit"];

/// Keys of scenes that name files.
const PATHS: [&str; 5] =
    ["head.mesh", "head.scalp_mask", "head.scalp_weights", "groom.file", "light.environment"];

impl Salon {
    /// Takes a file that somebody opened or dropped, and finds out what it is.
    pub(super) fn take_file(&mut self, path: String) {
        if contents::by_name(Path::new(&path)) == Contents::default() {
            let known = contents::extensions().join(", ");
            let hint = format!("Scenes are .toml files; heads and grooms are {known}.");
            return self.tell(format!("{path} cannot be opened here"), hint, true);
        }
        self.offered.push_back(path);
    }

    /// Has the next file looked into; `false` if there is none.
    pub(super) fn look_into_files(&mut self) -> bool {
        let Some(path) = self.offered.front().cloned() else { return false };
        match &self.desk.hair {
            Some(Job { purpose: Purpose::Contents, .. }) => {}
            // What is computed now is mostly for nothing once it is known.
            Some(_) => self.desk.outdate(),
            None => {
                let order = Request::Contents { path };
                self.desk.start(Purpose::Contents, SceneRef::default(), order);
            }
        }
        true
    }

    /// Takes the answer of what is in a file.
    pub(super) fn looked_into(&mut self, answer: Response) {
        let Some(path) = self.offered.pop_front() else { return };
        match answer {
            Response::Contents(contents) => self.use_file(&path, contents),
            Response::Failed(refusal) => self.complain(&refusal),
            _ => {}
        }
    }

    /// Makes a file the scene's head, its groom, or both.
    pub(super) fn use_file(&mut self, path: &str, contents: Contents) {
        let name = file_name(path);
        let label = match contents {
            Contents { head: true, groom: true } => format!("Head and hair of {name}"),
            Contents { groom: true, .. } => format!("Hair of {name}"),
            Contents { .. } => format!("Head of {name}"),
        };
        let is_new = self.document.is_none();
        if is_new {
            let stem = Path::new(&name).file_stem().unwrap_or_default().to_string_lossy();
            let text = format!("[hair]\ntype = \"{USUAL_HAIR}\"\n");
            let text = edit::set_key(&text, "name", &quoted(&stem)).unwrap_or(text);
            let text = edit::set_keys(&text, &keys(&quoted(path), contents)).unwrap_or(text);
            self.open_document(Document::new(stem, None, label, text));
        } else {
            let written = self.as_written(path);
            self.name_file(&label, &written, contents);
        }
        if contents.head && contents.groom {
            let hint = format!("“Use the mannequin” under “{FILES_PANEL}” takes its hair alone.");
            self.tell(format!("{name} has a head and hair; both are taken."), hint, false);
        }
    }

    fn name_file(&mut self, label: &str, path: &str, contents: Contents) {
        let Some(base) = self.base() else { return };
        if self.names(path, contents) {
            // The same file is opened again because it is another by now.
            self.forget_hair();
        } else {
            let text = edit::set_keys(base, &keys(&quoted(path), contents));
            if !self.change(label, text, false) {
                return;
            }
        }
        (self.framed, self.gallery) = (self.framed && !contents.head, false);
        if contents.groom {
            (self.chosen, self.alone) = (Chosen::default(), None);
        }
    }

    /// Whether the scene names a file already.
    fn names(&self, path: &str, contents: Contents) -> bool {
        let (Some(document), Some(understood)) = (&self.document, &self.scene) else {
            return false;
        };
        let (path, scene) = (document.folder().join(path), &understood.scene);
        let head = matches!(&scene.head, HeadSource::Mesh(file) if file.path == path);
        let groom = scene.groom.as_ref().is_some_and(|file| file.path == path);
        (head || !contents.head) && (groom || !contents.groom)
    }

    /// What a file that lies beside another is good for is not known here: hair that was refused is tried again.
    pub(super) fn try_again(&mut self) {
        if self.refused.is_some() {
            self.forget_hair();
        }
    }

    fn forget_hair(&mut self) {
        self.refused = None;
        if let Some(seen) = &mut self.shown {
            seen.key = None;
        }
        self.desk.outdate();
    }

    /// The mannequin instead of the scene's head, or hair of the scene's own instead of its groom's.
    pub(super) fn without_file(&mut self, contents: Contents) {
        let Some(base) = self.base() else { return };
        // The keys that are about the file go with it.
        let (label, key) = match contents.head {
            true => ("The mannequin's head", HEAD[0]),
            false => ("Hair of its own", GROOM[0]),
        };
        let text = edit::set_keys(base, &[(key, None)]);
        if self.change(label, text, false) {
            self.framed &= !contents.head;
        }
    }

    /// A path as the scene writes it: from the scene's folder, if the file lies there or near by.
    fn as_written(&self, path: &str) -> String {
        let folder = self.document.as_ref().map_or(Path::new(""), Document::folder);
        near(folder, Path::new(path)).unwrap_or_else(|| path.to_owned())
    }

    /// The text as it is to be in a folder, with the same files.
    pub(super) fn text_in(&self, folder: &Path) -> Option<String> {
        let document = self.document.as_ref()?;
        let text = document.text();
        let table: DocumentMut = text.parse().ok()?;
        let moved = PATHS.iter().filter_map(|key| {
            let item = key.split('.').try_fold(table.as_item(), |item, part| item.get(part))?;
            let whole = plain(&document.folder().join(item.as_str()?));
            let from_there = near(folder, &whole).or_else(|| whole.to_str().map(str::to_owned))?;
            let other = whole.is_absolute() && item.as_str() != Some(&from_there);
            other.then(|| (*key, quoted(&from_there)))
        });
        let moved: Vec<_> = moved.collect();
        let keys: Vec<_> = moved.iter().map(|(key, value)| (*key, Some(value.as_str()))).collect();
        if keys.is_empty() { Some(text.to_owned()) } else { edit::set_keys(text, &keys).ok() }
    }

    /// What a person in the salon can do about what is wrong with a file; scenes name keys instead.
    pub(super) fn hint_for(&self, refusal: &Diagnostic) -> String {
        let is_missing = refusal.problem.contains("there is no file");
        match refusal.key.as_str() {
            "groom.file" | "head.mesh" if is_missing => {
                "Drop the file on the window, or open it; or undo.".into()
            }
            "groom.file" if refusal.line > 0 && !refusal.hint.is_empty() => format!(
                "Choose its unit and the axis that points up under “{FILES_PANEL}”, or open the head that it was made on."
            ),
            "head.mesh" if !refusal.hint.is_empty() => {
                format!("Choose its unit under “{FILES_PANEL}”.")
            }
            _ => refusal.hint.clone(),
        }
    }

    /// Whether the scene's head is from a file, and whether its hair is.
    #[must_use]
    pub fn files(&self) -> Contents {
        self.scene.as_ref().map_or(Contents::default(), |understood| Contents {
            head: understood.scene.head != HeadSource::Mannequin,
            groom: understood.scene.groom.is_some(),
        })
    }
}

/// A path without ways up, as it is written.
fn plain(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut all, part| {
        match part {
            Component::ParentDir => drop(all.pop()),
            part => all.push(part),
        }
        all
    })
}

/// The keys that name a file, and without value those that said something of another.
fn keys(written: &str, contents: Contents) -> Vec<(&'static str, Option<&str>)> {
    let of = |keys: &[&'static str], wanted: bool| {
        let value = |place: usize| (place == 0).then_some(written);
        let all = keys.iter().enumerate().map(|(place, key)| (*key, value(place)));
        all.filter(|_| wanted).collect::<Vec<_>>()
    };
    // How many guides a groom is to have is said of any.
    [of(&HEAD, contents.head), of(&GROOM, contents.groom)].concat()
}

fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name();
    name.map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// A text as TOML writes it.
fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}

/// The way from a folder to a file in it, or in a folder at most two above; both whole paths.
fn near(folder: &Path, file: &Path) -> Option<String> {
    if !folder.is_absolute() || !file.is_absolute() {
        return None;
    }
    let ups = folder.ancestors().take(3).position(|above| file.starts_with(above))?;
    let above = folder.ancestors().nth(ups)?;
    // From the root of all, a whole path is clearer.
    above.parent().filter(|_| ups == 0 || above.components().count() > 2)?;
    let inside = file.strip_prefix(above).ok()?;
    let parts = inside.components().map(|part| match part {
        Component::Normal(name) => name.to_str(),
        _ => None,
    });
    let parts: Option<Vec<&str>> = parts.collect();
    Some(std::iter::repeat_n("..", ups).chain(parts?).collect::<Vec<_>>().join("/"))
}
