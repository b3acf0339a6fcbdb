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
//! [`keys`] declares every key of a scene once. The JSON Schema, the reference in `docs/scene.md`, error messages, batch keys and
//! the controls of programs follow from it, and `operation` does the same for the operations of steps. A scene is read in four
//! steps, each of which reports the position of an error: keys that do not exist (`unknown_keys`), numbers (`document`), keys that
//! exclude each other (`exclusive`), and the rest (`read`). Ranges that depend on the use of a scene are checked by `check`.

#![forbid(unsafe_code)]

pub mod batch;
mod check;
mod choice;
mod control;
mod declaration;
mod document;
pub mod edit;
mod error;
mod exclusive;
pub mod history;
pub mod key_groups;
mod key_location;
pub mod keys;
mod keywords;
mod kind;
pub mod measurements;
mod natural_look;
mod operation;
mod placement;
pub mod quantity;
mod read;
mod record;
mod scene;
mod schema;
mod similar;
mod source;
mod step;
mod template;
mod unit_hint;
mod unknown_keys;
mod write;

pub use control::{OptionList, Panel, Slider, Unit};
pub use declaration::Declaration;
pub use error::{Diagnostic, SceneError, escaped, quoted};
pub use frisure_files::head::{HeadFile, ScalpSource};
pub use keywords::levels;
pub use natural_look::NaturalLook;
pub use operation::Button;
pub use placement::Placement;
pub use scene::*;
pub use schema::{options, schema};
pub use step::{buttons, parse_step};
pub use template::{template, worn_template};
pub use write::{WriteStepError, write_selection, write_step};
