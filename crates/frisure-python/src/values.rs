//! Python values as TOML, as scenes have them.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple};
use toml::{Table, Value};

/// The value as TOML; errors call it `name`.
pub(crate) fn toml(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Value> {
    // The interpreter's own types first. A bool is an int in Python, and no number in scenes.
    if let Ok(value) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(value.is_true()));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_str()?.to_owned()));
    }
    if value.is_instance_of::<PyInt>() {
        return integer(value, name);
    }
    if let Ok(number) = value.cast::<PyFloat>() {
        return Ok(Value::Float(number.value()));
    }
    if let Ok(items) = value.cast::<PyMapping>() {
        return table(items, name).map(Value::Table);
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        return list(value, name);
    }
    foreign(value, name)
}

/// A mapping as a table.
pub(crate) fn table(items: &Bound<'_, PyMapping>, name: &str) -> PyResult<Table> {
    let mut table = Table::new();
    for item in items.items()? {
        let (key, value) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
        let Ok(key) = key.cast::<PyString>() else {
            let shown = key.repr()?;
            return Err(PyTypeError::new_err(format!("the key {shown} of {name} is no text")));
        };
        let key = key.to_str()?.to_owned();
        if !value.is_none() {
            let value = toml(&value, &format!("{name}[{key:?}]"))?;
            table.insert(key, value);
        }
    }
    Ok(table)
}

fn integer(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Value> {
    let whole = value.extract::<i64>().map_err(|_| {
        PyValueError::new_err(format!("{name} is {value}; scenes have whole numbers of 64 bits"))
    });
    whole.map(Value::Integer)
}

fn list(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Value> {
    let items = value.try_iter()?.enumerate();
    let items = items.map(|(i, item)| toml(&item?, &format!("{name}[{i}]")));
    items.collect::<PyResult<_>>().map(Value::Array)
}

/// Values of other libraries: paths, NumPy's numbers and arrays.
fn foreign(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Value> {
    let py = value.py();
    if value.hasattr("__fspath__")? {
        let path = py.import("os")?.call_method1("fspath", (value,))?;
        return toml(&path, name);
    }
    if value.hasattr("tolist")? {
        // NumPy's arrays and scalars.
        let plain = value.call_method0("tolist")?;
        if !plain.get_type().is(value.get_type()) {
            return toml(&plain, name);
        }
    }
    let kind = value.get_type().qualname()?;
    let message = format!(
        "{name} is of the type {kind}; scenes have text, numbers, bools, lists, dicts and paths"
    );
    Err(PyTypeError::new_err(message))
}

/// A value as one line.
pub(crate) fn inline(value: &Value) -> String {
    value.to_string()
}

/// The error of a mapping that cannot be written as TOML.
pub(crate) fn unwritable(error: &toml::ser::Error) -> PyErr {
    PyValueError::new_err(format!("it cannot be written as a scene: {error}"))
}
