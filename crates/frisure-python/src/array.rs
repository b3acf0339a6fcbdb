//! Memory of Rust as NumPy arrays, without copies.

use std::any::Any;
use std::sync::Arc;

use glam::Vec3;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// Memory that NumPy reads where it is: `numpy.asarray(memory)` is a read-only array of it, and keeps it alive.
///
/// NumPy asks for `__array_interface__`, which has the address.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct Memory {
    /// Owns the memory, and never changes it.
    _owner: Arc<dyn Any + Send + Sync>,
    address: usize,
    shape: Vec<usize>,
    kind: &'static str,
}

/// A row of an array: one number or some of one type.
pub(crate) trait Row: Send + Sync + 'static {
    /// The type of the numbers, as NumPy writes it.
    const KIND: &'static str;
    /// How many there are; an array of single numbers has no second axis.
    const COLUMNS: usize;
}

macro_rules! rows {
    ($($row:ty => $kind:literal, $columns:literal;)*) => {
        $(
            impl Row for $row {
                // Of this machine's byte order.
                const KIND: &'static str = if cfg!(target_endian = "big") {
                    concat!(">", $kind)
                } else {
                    concat!("<", $kind)
                };
                const COLUMNS: usize = $columns;
            }
        )*
    };
}

rows! {
    u8 => "u1", 1;
    u32 => "u4", 1;
    [u32; 3] => "u4", 3;
    f32 => "f4", 1;
    [f32; 2] => "f4", 2;
    [f32; 3] => "f4", 3;
    Vec3 => "f4", 3;
}

// NumPy reads a point as three numbers.
const _: () = assert!(size_of::<Vec3>() == size_of::<[f32; 3]>());

impl Memory {
    /// Rows in memory that `owner` owns, and neither moves nor changes.
    pub(crate) fn rows<R: Row>(owner: Arc<dyn Any + Send + Sync>, rows: &[R]) -> Self {
        let shape = match R::COLUMNS {
            1 => vec![rows.len()],
            columns => vec![rows.len(), columns],
        };
        Self { _owner: owner, address: rows.as_ptr().addr(), shape, kind: R::KIND }
    }

    /// Single numbers in a shape with as many places.
    pub(crate) fn whole<R: Row>(values: Vec<R>, shape: Vec<usize>) -> Self {
        assert_eq!((shape.iter().product(), 1), (values.len(), R::COLUMNS));
        let owner = Arc::new(values);
        let address = owner.as_ptr().addr();
        Self { _owner: owner, address, shape, kind: R::KIND }
    }
}

#[pymethods]
impl Memory {
    /// Where the numbers are, as NumPy asks for it (array interface, version 3).
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("typestr", self.kind)?;
        interface.set_item("shape", PyTuple::new(py, &self.shape)?)?;
        // True: it must not be written to.
        interface.set_item("data", (self.address, true))?;
        Ok(interface)
    }
}
