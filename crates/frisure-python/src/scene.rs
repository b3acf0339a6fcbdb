//! Scenes: read, checked, edited.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use frisure::hairstyle::PRESETS;
use frisure::hairstyle::styling::Operation;
use frisure::scene::keys::KEYS;
use frisure::scene::{Scene, SceneError, edit, parse_step, template};
use frisure_engine::Error;
use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::errors;
use crate::values::{inline, table, toml, unwritable};

/// The checked text of a scene; it never changes.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct SceneText {
    pub(crate) scene: Arc<Scene>,
    /// What errors call it.
    name: String,
    /// The folder that its paths are relative to.
    folder: PathBuf,
}

impl SceneText {
    fn parsed(py: Python<'_>, name: String, text: String, folder: PathBuf) -> PyResult<Self> {
        let read = Scene::parse(&name, text, &folder).and_then(checked);
        let scene = read.map_err(|e| errors::raise(py, &Error::Scene(e)))?;
        Ok(Self { scene: Arc::new(scene), name, folder })
    }

    /// The same scene with an edited text.
    fn with_text(&self, py: Python<'_>, text: String) -> PyResult<Self> {
        Self::parsed(py, self.name.clone(), text, self.folder.clone())
    }
}

/// The scene, if its numbers are in the ranges of a head of hair.
fn checked(scene: Scene) -> Result<Scene, SceneError> {
    scene.hairstyle_spec()?;
    Ok(scene)
}

#[pymethods]
impl SceneText {
    /// Reads the text of a scene.
    #[staticmethod]
    fn parse(py: Python<'_>, text: String, name: String, folder: PathBuf) -> PyResult<Self> {
        Self::parsed(py, name, text, folder)
    }

    /// Reads a scene file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read = Scene::read(&path).and_then(checked);
        let scene = read.map_err(|e| errors::raise(py, &Error::Scene(e)))?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(Self { scene: Arc::new(scene), name: path.display().to_string(), folder })
    }

    /// Writes a mapping as TOML, and reads that.
    #[staticmethod]
    fn from_mapping(
        py: Python<'_>,
        mapping: &Bound<'_, PyMapping>,
        folder: PathBuf,
    ) -> PyResult<Self> {
        let table = table(mapping, "scene")?;
        let text = ::toml::to_string(&table).map_err(|e| unwritable(&e))?;
        Self::parsed(py, "<dict>".into(), text, folder)
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
        self.with_text(py, text.map_err(|e| errors::edit(py, e))?)
    }

    /// The scene with one more step: the name of its operation, and the value of that.
    fn with_step(&self, py: Python<'_>, name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let value = toml(value, name)?;
        let text = format!("{name} = {}", inline(&value));
        let step = parse_step(name, text).map_err(|e| errors::raise(py, &Error::Scene(e)))?;
        let text = edit::append(self.scene.text(), &[step]);
        self.with_text(py, text.map_err(|e| errors::edit(py, e))?)
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
