//! Layers of Universal Scene Description, as text (`.usda`), in binary (`.usdc`) and in a package
//! (`.usdz`): what hair and heads need of it.
//!
//! An implementation of our own: of the libraries at hand, `openusd` 0.8 needs a newer compiler than the
//! workspace and brings a composition engine, and other programs find no prims in the binary files of 0.6.
//! Layers are read as they stand in one file; what joins several (references, payloads, variants, inherits) is noted at
//! its prim ([`Prim::arcs`]) and not followed.
//!
//! Whatever is read, no memory is taken for a number that the file's size does not back up, and nesting ends at
//! [`MAX_DEPTH`].

#![forbid(unsafe_code)]

mod binary;
mod layer;
mod mesh;
mod package;
mod stage;
mod text;
mod value;

pub use layer::{Attribute, Layer, MAX_DEPTH, Prim, Relationship, Specifier};
pub use mesh::Mesh;
pub use stage::{Stage, StagePrim};
pub use value::{Data, ScalarType, Shape, Value, ValueType};

/// Whether a file begins as one of the three kinds does.
pub fn is_usd(bytes: &[u8]) -> bool {
    [binary::MAGIC, package::MAGIC, b"#usda"].iter().any(|magic| bytes.starts_with(magic))
}

/// A layer from a file of any of the three kinds, recognised by its first bytes; the error says what is wrong where.
pub fn read(bytes: &[u8]) -> Result<Layer, String> {
    let bytes = if bytes.starts_with(package::MAGIC) { package::first(bytes)? } else { bytes };
    if bytes.starts_with(binary::MAGIC) {
        return binary::read(bytes);
    }
    let text = std::str::from_utf8(bytes).ok().map(|t| t.trim_start_matches('\u{feff}'));
    match text {
        Some(text) if text.starts_with("#usda") => text::read(text),
        _ => Err("it begins neither with `#usda` nor with `PXR-USDC`".into()),
    }
}

pub use binary::write as write_binary;
pub use text::write as write_text;
