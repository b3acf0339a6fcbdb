//! Whether arrays that are asked for have room in memory, told before the memory is taken: without room a process would end.

use frisure_engine::{Error, memory};
use pyo3::prelude::*;

use crate::errors::raise;

/// Memory that is not looked up (bytes): asking the system takes longer than solving a few rods.
const SMALL: f64 = 16e6;

/// Checks that so many things (`rods`, `lines`) of so many bytes each have room in memory.
///
/// # Errors
/// [`Error::Invalid`], with the memory that is needed and free, and how many have room.
pub(crate) fn check(things: &str, count: usize, each: f64) -> Result<(), Error> {
    if count as f64 * each <= SMALL {
        return Ok(());
    }
    let fits = |count: usize| memory::check_points(count as f64, each);
    let Err(error) = fits(count) else { return Ok(()) };
    // The most that fit, by halves: the library says whether some do.
    let (mut least, mut most) = (0, count);
    while most - least > 1 + least / 1000 {
        let middle = least + (most - least) / 2;
        if fits(middle).is_ok() {
            least = middle;
        } else {
            most = middle;
        }
    }
    let needed = count as f64 * each;
    let problem =
        format!("{count} {things} need {needed:.3e} bytes, {each:.0} bytes each: {error}");
    Err(Error::invalid(problem, &format!("about {least} {things} have room")))
}

/// An empty list with room for so many values.
///
/// # Errors
/// [`Error::Invalid`], where a system that does not tell what is free has no room.
pub(crate) fn list<T>(things: &str, count: usize) -> Result<Vec<T>, Error> {
    let mut list = Vec::new();
    match list.try_reserve_exact(count) {
        Ok(()) => Ok(list),
        Err(_) => {
            let each = size_of::<T>();
            let problem = format!("{count} {things} of {each} bytes each have no room in memory");
            Err(Error::invalid(problem, "compute fewer at a time"))
        }
    }
}

/// Raises the error of things without room, for arrays that Python makes.
#[pyfunction]
pub(crate) fn check_room(py: Python<'_>, things: &str, count: usize, each: f64) -> PyResult<()> {
    check(things, count, each).map_err(|error| raise(py, &error))
}
