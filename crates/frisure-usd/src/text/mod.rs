//! Layers as text, `.usda`.

mod lexer;
mod read;
mod write;

pub(crate) use read::read;
pub use write::write;
