//! Heads, grooms, environment maps and pictures to and from files: one module per format. This crate
//! solves nothing and prints nothing.
//!
//! | module | reads | writes |
//! | --- | --- | --- |
//! | [`head`] | OBJ, USD, glTF and PLY meshes, scalp masks | |
//! | [`groom`] | `.hair`, `.obj`, `.ply`, `.usdc`, `.usda`, `.usdz`, `.abc`, `.data`, `.npz` | the same, `.txt` and `.pbrt` for renderers, `.glb`, `.html` |
//! | [`cards`] | | hair cards: `.glb`, `.obj`, `.usdc`, `.usda` |
//! | [`contents`] | what a file holds: head, groom, or both | |
//! | [`environment`] | environment maps, `.hdr` and `.exr` | |
//! | [`picture`] | PNG, JPEG | PNG, OpenEXR |
//! | [`report`] | | JSON |
//!
//! Every file is written beside its destination and renamed over it when it is complete, so that
//! an interrupted program leaves the complete old file or the complete new one
//! ([`frisure_files::write_atomically`]). The same input gives the same bytes.

#![forbid(unsafe_code)]

mod accessory_names;
pub mod cards;
pub mod contents;
pub mod environment;
pub mod groom;
pub mod head;
pub mod picture;
mod ply;
pub mod report;
#[cfg(feature = "usd")]
mod stage_frame;
