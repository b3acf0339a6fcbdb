//! Scene files: TOML in, a checked description of hair out; and edits of their text.
//!
//! | module | reads | writes |
//! | --- | --- | --- |
//! | crate root | a TOML scene into a [`Scene`] | a commented scene to start from, and steps |
//! | [`batch`] | a TOML description of many scenes | the text of each |
//! | [`edit`] | | single keys and steps in the text of a scene |
//! | [`history`] | a scene with its steps, done and undone | the same |
//! | [`measurements`] | tables of measured hair (`.csv`) | a scene of that hair |
//! | [`quantity`] | numbers with units, such as `25 cm` | the same |
//!
//! A scene is read in three steps, each with the position of what is wrong: keys that do not exist
//! (`shape`), values of the wrong kind (`key`), and values that mean nothing together or are out
//! of range (`resolve`). `file` lists the keys and is their reference; the JSON Schema is made from
//! it.

#![forbid(unsafe_code)]

mod bare;
pub mod batch;
mod blame;
pub mod edit;
mod error;
mod exclusive;
mod file;
pub mod history;
mod key;
mod light;
pub mod measurements;
pub mod quantity;
mod resolve;
mod scene;
mod schema;
mod shape;
mod source;
mod step;
mod template;
mod words;

pub use error::{Fault, SceneError};
pub use frisure_files::head::{HeadFile, ScalpSource};
use scene::without_mark;
pub use scene::*;
pub use schema::{NumberKey, number_key, schema};
pub use step::{Button, WriteStepError, buttons, parse_step, write_step};
pub(crate) use step::{Record, parse_record};
pub use template::template;
