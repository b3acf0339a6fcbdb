//! Scenes, heads and grooms to and from files: one module per format, nothing solved, nothing
//! printed.
//!
//! | module | reads | writes |
//! | --- | --- | --- |
//! | [`scene`] | a TOML scene into a [`scene::Scene`] | a commented scene to start from, and steps |
//! | [`scene::batch`] | a TOML description of many scenes | the text of each |
//! | [`history`] | a scene with what was done and undone | the same |
//! | [`head`] | OBJ, USD, glTF and PLY meshes, scalp masks | |
//! | [`groom`] | `.hair`, `.obj`, `.ply`, `.usdc`, `.usda`, `.abc`, `.data`, `.npz` | the same, `.txt` and `.pbrt` for renderers, `.glb` |
//! | [`measurements`] | tables of measured hair (`.csv`) | a scene of that hair |
//! | [`contents`] | what a file is that somebody hands over: head, groom, or both | |
//! | [`environment`] | `.hdr` and `.exr` pictures of surroundings | |
//! | [`picture`] | | PNG |
//! | [`report`] | | JSON |
//! | [`kept`] | parts of long work, kept so that it can go on | the same |
//!
//! Every file is written beside its destination and renamed over it when it is complete, so that
//! an interrupted program leaves the old file or the new one and never a half of it
//! ([`files::write_atomically`]). The same input gives the same bytes.

pub mod contents;
mod digest;
pub mod environment;
pub mod files;
pub mod frame;
pub mod groom;
pub mod head;
pub mod history;
pub mod kept;
pub mod measurements;
pub mod picture;
mod ply;
pub mod quantity;
pub mod report;
pub mod scene;
mod usd;
