//! Errors as Python exceptions, which `python/frisure/errors.py` declares.

use frisure::files::ReadError;
use frisure::scene::edit::EditError;
use frisure::scene::{Diagnostic, SceneError};
use frisure_engine::Error;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What follows the name of a file in messages about a text that was edited since it was read: its lines are not those of the file.
pub(crate) const EDITED: &str = " (edited)";

/// The exception for an error.
pub(crate) fn raise(py: Python<'_>, error: &Error) -> PyErr {
    let text = frisure_cli::plain(error);
    // Python writes the name of the exception in its place.
    let text = text.strip_prefix("error: ").map(str::to_owned).unwrap_or(text);
    let made = match error {
        Error::Cancelled(_) => return PyKeyboardInterrupt::new_err(()),
        Error::Scene(SceneError::Invalid(found)) => scene_error(py, &text, found),
        Error::Scene(SceneError::Read(ReadError::Missing { path })) => {
            make(py, "SceneNotFoundError", (text, path.display().to_string()), None)
        }
        Error::Scene(SceneError::Read(_)) => make(py, "SceneError", (text,), None),
        Error::Invalid { .. } => make(py, "ArgumentError", (text,), None),
        Error::Failed { .. } | Error::Internal(_) => make(py, "FailedError", (text,), None),
    };
    made.unwrap_or_else(|e| e)
}

/// The exception for a value that is not taken; the text names the argument.
pub(crate) fn argument(py: Python<'_>, text: &str) -> PyErr {
    make(py, "ArgumentError", (text,), None).unwrap_or_else(|e| e)
}

/// The exception for a value of a type that is not taken.
pub(crate) fn argument_type(py: Python<'_>, text: &str) -> PyErr {
    make(py, "ArgumentTypeError", (text,), None).unwrap_or_else(|e| e)
}

/// The exception for an edit of a scene that is impossible; the scene is called `name`.
pub(crate) fn edit(py: Python<'_>, error: EditError, name: &str) -> PyErr {
    match error {
        EditError::Scene(SceneError::Invalid(mut found)) => {
            // An edit knows the text alone.
            found.file = name.to_owned();
            raise(py, &Error::Scene(SceneError::Invalid(found)))
        }
        EditError::Scene(error) => raise(py, &Error::Scene(error)),
        error => raise(py, &Error::because(&error, "")),
    }
}

/// The exception for an error at a position of a scene.
fn scene_error(py: Python<'_>, text: &str, found: &Diagnostic) -> PyResult<PyErr> {
    let Diagnostic { file, line, column, key, value, allowed, hint, .. } = found;
    let place = PyDict::new(py);
    place.set_item("problem", found.message())?;
    place.set_item("file", file.strip_suffix(EDITED).unwrap_or(file))?;
    place.set_item("line", line)?;
    place.set_item("column", column)?;
    place.set_item("key", key)?;
    place.set_item("value", value)?;
    place.set_item("allowed", allowed)?;
    place.set_item("hint", hint)?;
    make(py, "SceneError", (text,), Some(&place))
}

fn make<'py>(
    py: Python<'py>,
    class: &str,
    arguments: impl pyo3::call::PyCallArgs<'py>,
    named: Option<&Bound<'py, PyDict>>,
) -> PyResult<PyErr> {
    let class = py.import("frisure.errors")?.getattr(class)?;
    Ok(PyErr::from_value(class.call(arguments, named)?))
}
