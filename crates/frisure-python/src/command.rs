//! The command `frisure`.

use std::ffi::OsString;

use pyo3::prelude::*;

use crate::work;

/// Runs the command line, whose first argument is the name of the program, and returns its exit status.
#[pyfunction]
pub(crate) fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<u8> {
    work::begin(py)?;
    Ok(py.detach(|| frisure_cli::run(arguments)))
}
