//! Layers in binary, `.usdc` ("crate").
//!
//! Pixar publishes no description but the source, `pxr/usd/sdf/crateFile.cpp` of OpenUSD, from which all of this is taken.
//! A file is a head of 88 bytes (the magic, a version, where the table of contents is), values anywhere, and six
//! sections: words (`TOKENS`), which of them are strings, fields (a word and a [`ValueRep`]), sets of fields, a tree of
//! paths, and specs (a path, its set of fields, what it is). Read are versions from 0.4.0 on, as Pixar's own library does;
//! written is 0.8.0, which that library wrote for years and Blender still writes: some readers take nothing older than
//! its compressed structure, and some do not know yet what is newer.

mod compressed;
mod read;
mod structure;
mod values;
mod write;

pub(super) use read::read;
pub use write::write;

/// The first bytes of a file.
pub(super) const MAGIC: &[u8] = b"PXR-USDC";

/// Bytes of the head.
const HEAD: usize = 88;

/// Fewer integers than this are not compressed.
const FEW: u64 = 16;

/// A value in 8 bytes: what it is, and itself or where it is in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct ValueRep(u64);

impl ValueRep {
    const ARRAY: u64 = 1 << 63;
    const INLINED: u64 = 1 << 62;
    const COMPRESSED: u64 = 1 << 61;
    /// A change to an array of a weaker layer.
    const EDIT: u64 = 1 << 60;

    fn inlined(code: u8, payload: u32) -> Self {
        Self(Self::INLINED | u64::from(code) << 48 | u64::from(payload))
    }

    fn at(code: u8, place: usize, flags: u64) -> Self {
        Self(flags | u64::from(code) << 48 | place as u64)
    }

    fn has(self, flag: u64) -> bool {
        self.0 & flag != 0
    }

    fn code(self) -> u8 {
        self.0.to_le_bytes()[6]
    }

    fn payload(self) -> u64 {
        self.0 & ((1 << 48) - 1)
    }
}

/// Types of values beside the plain ones of [`super::value::TYPES`].
mod code {
    pub(super) const TOKEN_LIST_OP: u8 = 32;
    pub(super) const PATH_LIST_OP: u8 = 34;
    pub(super) const TOKEN_VECTOR: u8 = 41;
    pub(super) const SPECIFIER: u8 = 42;
    pub(super) const VARIABILITY: u8 = 44;
    pub(super) const TIME_SAMPLES: u8 = 46;
    pub(super) const DOUBLE_VECTOR: u8 = 48;
}

/// Types of specs.
mod spec {
    pub(super) const ATTRIBUTE: u32 = 1;
    pub(super) const PRIM: u32 = 6;
    pub(super) const ROOT: u32 = 7;
    pub(super) const RELATIONSHIP: u32 = 8;
}
