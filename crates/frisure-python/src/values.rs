//! Python values as TOML, as scenes have them.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple};
use toml::{Table, Value};

use crate::errors::{argument, argument_type};

/// Most lists and tables within each other. Chosen below the 80 that the parser of TOML reads, so that the key is named.
const DEEPEST: usize = 64;

/// Most values within each other, together: lists that are shared can be written many more times than they are in memory. Chosen: a batch that
/// lists each of its heads has fewer.
const MOST: usize = 1_000_000;

/// Bytes of text that count as a value besides the text itself.
const TEXT: usize = 1000;

/// Longest name of a value in a message (characters).
const LONGEST_NAME: usize = 200;

/// The value as TOML; errors call it `name`.
pub(crate) fn toml(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Value> {
    Conversion::of(name).within(value, name, 0)
}

/// A mapping as a table.
pub(crate) fn table(items: &Bound<'_, PyMapping>, name: &str) -> PyResult<Table> {
    Conversion::of(name).table_within(items, name, 0)
}

/// A value that is being converted.
struct Conversion<'a> {
    /// What the whole of it is called.
    name: &'a str,
    /// How many more values it may have.
    left: usize,
}

impl<'a> Conversion<'a> {
    fn of(name: &'a str) -> Self {
        Self { name, left: MOST }
    }

    /// Counts so many more values.
    fn count(&mut self, py: Python<'_>, values: usize) -> PyResult<()> {
        let Some(left) = self.left.checked_sub(values) else {
            let name = shortened(self.name);
            let problem = format!(
                "{name} has more than {MOST} values, counting shared lists wherever they are; scenes have fewer"
            );
            return Err(argument(py, &problem));
        };
        self.left = left;
        Ok(())
    }

    /// A value in so many lists and tables.
    fn within(&mut self, value: &Bound<'_, PyAny>, name: &str, depth: usize) -> PyResult<Value> {
        self.count(value.py(), 1)?;
        // The interpreter's own types first. A bool is an int in Python, and no number in scenes.
        if let Ok(value) = value.cast::<PyBool>() {
            return Ok(Value::Boolean(value.is_true()));
        }
        if let Ok(found) = value.cast::<PyString>() {
            let text = text(found, name)?;
            self.count(value.py(), text.len() / TEXT)?;
            return Ok(Value::String(text));
        }
        if value.is_instance_of::<PyInt>() {
            return integer(value, name);
        }
        if let Ok(number) = value.cast::<PyFloat>() {
            return Ok(Value::Float(number.value()));
        }
        if depth > DEEPEST {
            let name = shortened(name);
            let problem = format!(
                "{name} is in more than {DEEPEST} dicts and lists, or in itself; scenes have fewer"
            );
            return Err(argument(value.py(), &problem));
        }
        if let Ok(items) = value.cast::<PyMapping>() {
            return self.table_within(items, name, depth).map(Value::Table);
        }
        if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
            let items = value.try_iter()?.enumerate();
            let items =
                items.map(|(i, item)| self.within(&item?, &format!("{name}[{i}]"), depth + 1));
            return items.collect::<PyResult<_>>().map(Value::Array);
        }
        self.foreign(value, name, depth)
    }

    fn table_within(
        &mut self,
        items: &Bound<'_, PyMapping>,
        name: &str,
        depth: usize,
    ) -> PyResult<Table> {
        let mut table = Table::new();
        for item in items.items()? {
            let (key, value) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
            let Ok(key) = key.cast::<PyString>() else {
                let (shown, name) = (key.repr()?, shortened(name));
                let problem = format!("the key {shown} of {name} is no text");
                return Err(argument_type(items.py(), &problem));
            };
            let key = text(key, name)?;
            self.count(items.py(), key.len() / TEXT)?;
            if !value.is_none() {
                let value = self.within(&value, &format!("{name}[{key:?}]"), depth + 1)?;
                table.insert(key, value);
            }
        }
        Ok(table)
    }

    /// Values of other libraries: paths, NumPy's numbers and arrays.
    fn foreign(&mut self, value: &Bound<'_, PyAny>, name: &str, depth: usize) -> PyResult<Value> {
        let py = value.py();
        if value.hasattr("__fspath__")? {
            let path = py.import("os")?.call_method1("fspath", (value,))?;
            return self.within(&path, name, depth + 1);
        }
        if value.hasattr("tolist")? {
            // NumPy's arrays and scalars. An array of one number in many places takes memory as a list only.
            let size = value.getattr_opt("size")?.and_then(|size| size.extract::<usize>().ok());
            if size.is_some_and(|size| size > self.left) {
                self.count(py, MOST + 1)?;
            }
            let plain = value.call_method0("tolist")?;
            if !plain.get_type().is(value.get_type()) {
                return self.within(&plain, name, depth + 1);
            }
        }
        let (kind, name) = (value.get_type().qualname()?, shortened(name));
        let problem = format!(
            "{name} is of the type {kind}; scenes have text, numbers, bools, lists, dicts and paths"
        );
        Err(argument_type(py, &problem))
    }
}

/// A text; one with half of a surrogate pair has no UTF-8.
fn text(value: &Bound<'_, PyString>, name: &str) -> PyResult<String> {
    let wrong = |_| {
        let problem = format!("{} has a lone surrogate, which is no character", shortened(name));
        argument(value.py(), &problem)
    };
    value.to_str().map(str::to_owned).map_err(wrong)
}

fn shortened(name: &str) -> String {
    match name.char_indices().nth(LONGEST_NAME) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}

fn integer(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Value> {
    let whole = value.extract::<i64>().map_err(|_| {
        let problem = format!("{name} is {value}; scenes have whole numbers of 64 bits");
        argument(value.py(), &problem)
    });
    whole.map(Value::Integer)
}

/// A value as one line.
pub(crate) fn inline(value: &Value) -> String {
    value.to_string()
}

/// The error of a mapping that cannot be written as TOML.
pub(crate) fn unwritable(py: Python<'_>, error: &toml::ser::Error) -> PyErr {
    argument(py, &format!("it cannot be written as a scene: {error}"))
}
