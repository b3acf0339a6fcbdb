//! Scenes: read, checked, edited.

use std::path::{Path, PathBuf, absolute};
use std::sync::Arc;
use std::{env, io};

use frisure::files::write_atomically;
use frisure::hairstyle::PRESETS;
use frisure::hairstyle::styling::Operation;
use frisure::scene::edit::EditError;
use frisure::scene::keys::KEYS;
use frisure::scene::{Scene, SceneError, edit, parse_step, template};
use frisure_engine::Error;
use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::errors::{self, EDITED};
use crate::values::{inline, table, toml, unwritable};

/// The checked text of a scene; it never changes.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct SceneText {
    pub(crate) scene: Arc<Scene>,
    /// What errors call it.
    name: String,
    /// The folder that its paths are relative to, absolute: the working directory may change.
    folder: PathBuf,
    /// Whether the text is another than that of the file with its name.
    edited: bool,
}

impl SceneText {
    fn parsed(
        py: Python<'_>,
        name: String,
        text: String,
        folder: &Path,
        edited: bool,
    ) -> PyResult<Self> {
        let folder = whole(folder).map_err(|e| errors::raise(py, &Error::failed(&e, "")))?;
        let read = Scene::parse(&label(&name, edited), text, &folder).and_then(checked);
        let scene = read.map_err(|e| errors::raise(py, &Error::Scene(e)))?;
        Ok(Self { scene: Arc::new(scene), name, folder, edited })
    }

    /// The same scene with an edited text.
    fn with_text(&self, py: Python<'_>, text: String) -> PyResult<Self> {
        Self::parsed(py, self.name.clone(), text, &self.folder, true)
    }

    /// The exception for an edit that is impossible.
    fn wrong_edit(&self, py: Python<'_>, error: EditError) -> PyErr {
        errors::edit(py, error, &label(&self.name, true))
    }
}

/// What messages call a scene of a name; texts that never were in a file, such as `<dict>`, are called the same when they are edited.
fn label(name: &str, edited: bool) -> String {
    let suffix = if edited && !name.starts_with('<') { EDITED } else { "" };
    format!("{name}{suffix}")
}

/// A folder by its absolute path; the working directory for none.
fn whole(folder: &Path) -> io::Result<PathBuf> {
    if folder.as_os_str().is_empty() { env::current_dir() } else { absolute(folder) }
}

/// The scene, if its numbers are in the ranges of a head of hair.
fn checked(scene: Scene) -> Result<Scene, SceneError> {
    scene.hairstyle_spec()?;
    Ok(scene)
}

#[pymethods]
impl SceneText {
    /// Reads the text of a scene; `edited`, if it is another than that of the file with its name.
    #[staticmethod]
    fn parse(
        py: Python<'_>,
        text: String,
        name: String,
        folder: PathBuf,
        edited: bool,
    ) -> PyResult<Self> {
        Self::parsed(py, name, text, &folder, edited)
    }

    /// Reads a scene file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read = Scene::read(&path).and_then(checked);
        let scene = read.map_err(|e| errors::raise(py, &Error::Scene(e)))?;
        let folder = whole(path.parent().unwrap_or(Path::new("")));
        let folder = folder.map_err(|e| errors::raise(py, &Error::failed(&e, "")))?;
        // Once more, since what it names must be found from another working directory, too.
        Self::parsed(py, path.display().to_string(), scene.text().to_owned(), &folder, false)
    }

    /// Writes a mapping as TOML, and reads that.
    #[staticmethod]
    fn from_mapping(
        py: Python<'_>,
        mapping: &Bound<'_, PyMapping>,
        folder: PathBuf,
    ) -> PyResult<Self> {
        let table = table(mapping, "scene")?;
        let text = ::toml::to_string(&table).map_err(|e| unwritable(py, &e))?;
        Self::parsed(py, "<dict>".into(), text, &folder, false)
    }

    /// The text.
    #[getter]
    fn text(&self) -> &str {
        self.scene.text()
    }

    /// What errors call it: the path of its file, if it has one.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// Whether the text is another than that of the file with its name.
    #[getter]
    fn edited(&self) -> bool {
        self.edited
    }

    /// The folder that its paths are relative to.
    #[getter]
    fn folder(&self) -> PathBuf {
        self.folder.clone()
    }

    /// The name of its hair type.
    #[getter]
    fn hair_type(&self) -> &str {
        self.scene.hair_type
    }

    /// The scene with keys set, or removed where the value is `None`.
    fn with_values(
        &self,
        py: Python<'_>,
        changes: Vec<(String, Option<Bound<'_, PyAny>>)>,
    ) -> PyResult<Self> {
        let mut written = Vec::new();
        for (key, value) in changes {
            let value = value.map(|value| toml(&value, &key)).transpose()?;
            written.push((key, value.as_ref().map(inline)));
        }
        let changes: Vec<_> =
            written.iter().map(|(key, value)| (key.as_str(), value.as_deref())).collect();
        let text = edit::set_keys(self.scene.text(), &changes);
        self.with_text(py, text.map_err(|e| self.wrong_edit(py, e))?)
    }

    /// The scene with one more step: the name of its operation, and the value of that.
    fn with_step(&self, py: Python<'_>, name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let value = toml(value, name)?;
        let text = format!("{name} = {}", inline(&value));
        let step = parse_step(name, text).map_err(|e| errors::raise(py, &Error::Scene(e)))?;
        let text = edit::append(self.scene.text(), &[step]);
        self.with_text(py, text.map_err(|e| self.wrong_edit(py, e))?)
    }

    /// Writes the text to a file, as a whole or not at all; in another folder than the scene's its paths are rewritten.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let folder = whole(path.parent().unwrap_or(Path::new("")));
        let folder = folder.map_err(|e| errors::raise(py, &Error::failed(&e, "")))?;
        let text = edit::in_folder(self.scene.text(), &self.folder, &folder);
        let text = text.map_err(|e| self.wrong_edit(py, e))?;
        let written = py.detach(|| write_atomically(&path, |out| out.write_all(text.as_bytes())));
        written.map_err(|e| errors::raise(py, &Error::failed(&e, "")))
    }

    /// The number of a key in SI units, given or not; `None` for a key that has no number.
    fn number(&self, key: &str) -> Option<f64> {
        let declared = KEYS.iter().find(|declared| declared.path == key)?;
        Some(declared.number_in(&self.scene)).filter(|number| !number.is_nan())
    }

    /// How many steps the scene has.
    #[getter]
    fn step_count(&self) -> usize {
        self.scene.steps().len()
    }
}

/// The names of the hair types, with what they are.
#[pyfunction]
pub(crate) fn preset_names() -> Vec<(&'static str, &'static str)> {
    PRESETS.iter().map(|preset| (preset.name, preset.description)).collect()
}

/// The text of a scene of a hair type; `None` if there is no such type.
#[pyfunction]
pub(crate) fn preset_text(name: &str) -> Option<String> {
    PRESETS.iter().find(|preset| preset.name == name).map(template)
}

/// The names of the operations of steps.
#[pyfunction]
pub(crate) fn operation_names() -> Vec<&'static str> {
    Operation::NAMES.to_vec()
}

/// The paths of the keys of scenes, with their documentation.
#[pyfunction]
pub(crate) fn scene_keys() -> Vec<(&'static str, String)> {
    KEYS.iter().map(|key| (key.path, key.doc.clone())).collect()
}
