//! The Python package `frisure`: this crate is its extension module `frisure._frisure`, and `python/frisure` the part
//! written in Python, which has the documentation of what a user calls.
//!
//! The module has no solver and no file format of its own: `frisure_engine` computes, as for the other programs.
//!
//! | file | what it has |
//! | --- | --- |
//! | `array.rs` | memory of Rust as NumPy arrays, without copies |
//! | `batch.rs` | parts of a batch of heads |
//! | `command.rs` | the command `frisure` |
//! | `errors.rs` | errors as Python exceptions |
//! | `fit.rs` | fits of measured fibres |
//! | `hairstyle.rs` | hairstyles: predicted, styled, drawn, written |
//! | `photo.rs` | photos of locks: measured |
//! | `picture.rs` | pictures of hairstyles |
//! | `room.rs` | whether arrays have room in memory |
//! | `rods` | many single rods at once, as arrays |
//! | `scene.rs` | scenes: read, edited |
//! | `strands.rs` | strands as arrays |
//! | `values.rs` | Python values as TOML |
//! | `work.rs` | long work on another thread, with progress and Ctrl-C |

#![forbid(unsafe_code)]

mod array;
#[cfg(feature = "batch")]
mod batch;
mod command;
mod errors;
mod fit;
mod hairstyle;
mod head_derivatives;
mod photo;
mod picture;
mod rods;
mod room;
mod scene;
mod strands;
mod values;
mod work;

use pyo3::prelude::*;

/// Makes the module.
#[pymodule]
fn _frisure(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<array::Memory>()?;
    module.add_class::<scene::SceneText>()?;
    module.add_class::<hairstyle::Prediction>()?;
    module.add_class::<head_derivatives::HeadAtRest>()?;
    module.add_class::<strands::StrandData>()?;
    module.add_class::<rods::RodsAtRest>()?;
    module.add_function(wrap_pyfunction!(picture::render, module)?)?;
    module.add_function(wrap_pyfunction!(picture::render_png, module)?)?;
    module.add_function(wrap_pyfunction!(picture::read_png, module)?)?;
    module.add_function(wrap_pyfunction!(picture::save_picture, module)?)?;
    module.add_function(wrap_pyfunction!(scene::preset_names, module)?)?;
    module.add_function(wrap_pyfunction!(scene::preset_text, module)?)?;
    module.add_function(wrap_pyfunction!(scene::operation_names, module)?)?;
    module.add_function(wrap_pyfunction!(scene::scene_keys, module)?)?;
    module.add_function(wrap_pyfunction!(rods::settle_rods, module)?)?;
    module.add_function(wrap_pyfunction!(rods::inverse_rods, module)?)?;
    module.add_function(wrap_pyfunction!(rods::check_rods, module)?)?;
    module.add_function(wrap_pyfunction!(room::check_room, module)?)?;
    module.add_function(wrap_pyfunction!(work::after_fork, module)?)?;
    module.add_function(wrap_pyfunction!(fit::fit_fibres, module)?)?;
    module.add_function(wrap_pyfunction!(photo::measure_photo, module)?)?;
    #[cfg(feature = "batch")]
    {
        module.add_function(wrap_pyfunction!(batch::missing_parts, module)?)?;
        module.add_function(wrap_pyfunction!(batch::run_batch, module)?)?;
        module.add_function(wrap_pyfunction!(batch::compute_part, module)?)?;
    }
    module.add_function(wrap_pyfunction!(command::run_command, module)?)
}
