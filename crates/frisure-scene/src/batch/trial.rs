//! The ends of each range, tried on the scene before the work, and the files that scenes read.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::PathBuf;

use frisure_files::head::ScalpSource;

use super::heads::{Batch, SEED};
use super::way::{self, Value, Way, Written};
use crate::edit::EditError;
use crate::error::{Diagnostic, SceneError};
use crate::scene::{HeadSource, Scene};

/// How many heads are tried to find one that can be.
const TRIED: usize = 16;

/// Largest file whose content tells one batch from another (bytes).
const LARGEST: u64 = 1 << 32;

/// Tries the ends of each range; gives what is in the files that the scenes read.
pub(super) fn all(batch: &Batch) -> Result<Vec<Vec<u8>>, SceneError> {
    let Start { index, drawn, scene } = start(batch);
    let mut literals: Vec<String> = drawn.iter().map(|written| written.literal.clone()).collect();
    let mut files = scene.as_ref().map(files_of).unwrap_or_default();
    for (place, parameter) in batch.parameters.iter().enumerate() {
        for end in parameter.way.ends() {
            let kept = std::mem::replace(&mut literals[place], end.literal.clone());
            match scene_of(batch, index, &literals) {
                Ok(scene) => files.extend(files_of(&scene)),
                Err(error) if own(&error, &parameter.key) => {
                    return Err(error_in_batch(batch, &parameter.key, Some(&end), &error));
                }
                // It is impossible with another value of this head: some heads will fail.
                Err(_) => {}
            }
            literals[place] = kept;
        }
    }
    if let Err(error) = scene {
        return Err(impossible(batch, &drawn, &error));
    }
    let what = "a file that a scene reads";
    let read = |path: &PathBuf| frisure_files::read_bytes(path, LARGEST, what);
    // A file that is missing is reported where it is used.
    Ok(files.iter().filter_map(|path| read(path).ok()).collect())
}

/// A head to try others from.
struct Start {
    index: usize,
    drawn: Vec<Written>,
    scene: Result<Scene, EditError>,
}

/// The first head that can be, of the first few; the very first if none can.
fn start(batch: &Batch) -> Start {
    let head = |index: usize| {
        let drawn = batch.drawn(index);
        let literals: Vec<String> = drawn.iter().map(|written| written.literal.clone()).collect();
        Start { index, scene: scene_of(batch, index, &literals), drawn }
    };
    let mut heads = (0..batch.heads().min(TRIED)).map(head);
    heads.find(|start| start.scene.is_ok()).unwrap_or_else(|| head(0))
}

/// The error that no head is possible, at the key that it comes from.
fn impossible(batch: &Batch, drawn: &[Written], error: &EditError) -> SceneError {
    let keys = batch.fixed.iter().map(|(key, _)| (key.as_str(), None));
    let varied = batch.parameters.iter().zip(drawn).map(|(p, w)| (p.key.as_str(), Some(w)));
    let located = keys.chain(varied).find(|(key, _)| own(error, key));
    let (key, written) = located.unwrap_or(("", None));
    error_in_batch(batch, key, written, error)
}

fn scene_of(batch: &Batch, index: usize, literals: &[String]) -> Result<Scene, EditError> {
    let text = batch.text(index, literals)?;
    let scene = Scene::parse(SEED, text, &batch.folder)?;
    scene.hairstyle_spec()?;
    Ok(scene)
}

/// Whether an error is about a key.
fn own(error: &EditError, key: &str) -> bool {
    match error {
        EditError::Scene(error) => error.diagnostic().is_some_and(|diagnostic| {
            diagnostic.key == key
                || diagnostic.key.strip_prefix(key).is_some_and(|rest| rest.starts_with(['.', '[']))
        }),
        EditError::Value { key: other, .. } | EditError::NoPlace { key: other } => other == key,
        _ => false,
    }
}

/// The error about a value, at its position in the batch.
fn error_in_batch(
    batch: &Batch,
    key: &str,
    written: Option<&Written>,
    error: &EditError,
) -> SceneError {
    let span = place(batch, key, written);
    let here = batch.source.slice(span.clone()).to_owned();
    let diagnostic = match error {
        EditError::Scene(SceneError::Invalid(inner)) => {
            // The value as it is written here, if it is, or else as it would be in the scene.
            let value =
                if here.contains(['{', '[']) || here.is_empty() { &inner.value } else { &here };
            let diagnostic = Diagnostic { allowed: inner.allowed.clone(), ..Diagnostic::default() };
            // Its line numbers are those of the scene with all keys set, which is no file.
            let problem = inner.problem.split(" on line ").next().unwrap_or_default();
            let diagnostic = Diagnostic { problem: problem.to_owned(), ..diagnostic };
            let diagnostic = diagnostic.key(inner.key.as_str()).value(value.as_str());
            // A hint about a bare number is not about what is written here.
            let bare = inner.problem.is_empty() && written.is_some_and(Written::is_number);
            if bare { diagnostic } else { diagnostic.hint(inner.hint.as_str()) }
        }
        error => Diagnostic::new(error.to_string()).key(key),
    };
    let diagnostic = match written.and_then(|written| in_table(batch, key, written)) {
        Some(cell) if diagnostic.hint.is_empty() => diagnostic.hint(cell),
        Some(cell) => {
            let both = format!("{cell}; {}", diagnostic.hint);
            diagnostic.hint(both)
        }
        None => diagnostic,
    };
    diagnostic.at(&batch.source, span)
}

/// The cell of a table that a value of a key comes from, if it does.
fn in_table(batch: &Batch, key: &str, written: &Written) -> Option<String> {
    let parameter = batch.parameters.iter().find(|parameter| parameter.key == key)?;
    let Way::Column { sheet, cells } = &parameter.way else { return None };
    batch.sheets[*sheet].place_of(key, cells.iter().position(|cell| cell == written)?)
}

/// The span of a value of a key in the batch, or of the key.
fn place(batch: &Batch, key: &str, written: Option<&Written>) -> Range<usize> {
    let Ok(document) = batch.source.document() else { return 0..0 };
    let mut found = 0..0;
    for name in ["set", "grid", "vary"] {
        let Some(table) = document.get_ref().get(name) else { continue };
        search(table, "", key, &mut |span, value| {
            found = span;
            if let Some(written) = written {
                narrow(batch, value, written, &mut found);
            }
        });
    }
    if found.is_empty() { batch.source.locate("scene") } else { found }
}

type Tree<'a> = toml::Spanned<toml::de::DeValue<'a>>;

/// Finds a key, dotted in any way.
fn search(tree: &Tree<'_>, path: &str, key: &str, found: &mut dyn FnMut(Range<usize>, &Tree<'_>)) {
    let Some(table) = tree.get_ref().as_table() else { return };
    for (name, value) in table {
        let name = name.get_ref();
        let path = if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
        match path == key {
            true => found(value.span(), value),
            false => search(value, &path, key, found),
        }
    }
}

/// Narrows a span to the part that is just this value.
fn narrow(batch: &Batch, tree: &Tree<'_>, written: &Written, found: &mut Range<usize>) {
    let values: Vec<&Tree<'_>> = match tree.get_ref() {
        toml::de::DeValue::Table(table) => table.iter().map(|(_, value)| value).collect(),
        toml::de::DeValue::Array(items) => items.iter().collect(),
        _ => return,
    };
    for value in values {
        let text = batch.source.slice(value.span());
        let same = text == written.literal || same_number(text, written);
        if same {
            *found = value.span();
        } else {
            narrow(batch, value, written, found);
        }
    }
}

/// Whether a text is the number, in whatever unit.
fn same_number(text: &str, written: &Written) -> bool {
    let Value::Number(x) = written.value else { return false };
    let units = crate::quantity::Dimension::all();
    let word = way::word(text);
    word.is_some_and(|word| units.iter().any(|unit| unit.parse(&word) == Ok(x)))
        || text.parse() == Ok(x)
}

/// The files that shape the hair of a scene.
fn files_of(scene: &Scene) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let groom = scene.groom.iter();
    for head in groom.clone().filter_map(|file| file.head.as_ref()).chain([&scene.head]) {
        let HeadSource::Mesh(file) = head else { continue };
        found.insert(file.path.clone());
        if let ScalpSource::Mask(path) | ScalpSource::Weights(path) = &file.scalp {
            found.insert(path.clone());
        }
    }
    found.extend(groom.map(|file| file.path.clone()));
    found
}
