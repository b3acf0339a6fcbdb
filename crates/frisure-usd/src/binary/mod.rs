//! Layers in binary, `.usdc` ("crate").
//!
//! Pixar publishes no description but the source, `pxr/usd/sdf/crateFile.cpp` of OpenUSD, from which all of this is taken.
//! A file is a head of 88 bytes (the magic, a version, where the table of contents is), values anywhere, and six
//! sections: words (`TOKENS`), which of them are strings, fields (a word and a [`Rep`]), sets of fields, a tree of
//! paths, and specs (a path, its set of fields, what it is). Read are versions from 0.4.0 on, as Pixar's own library does;
//! written is 0.8.0, which that library wrote for years and Blender still writes: some readers take nothing older than
//! its compressed structure, and some do not know yet what is newer.

mod compressed;
mod read;
mod structure;
mod values;
mod write;

use super::value::{Base, Kind, Shape};

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
struct Rep(u64);

impl Rep {
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

/// What values are, beyond the plain ones of [`KINDS`].
mod code {
    pub(super) const TOKEN_LIST_OP: u8 = 32;
    pub(super) const PATH_LIST_OP: u8 = 34;
    pub(super) const TOKEN_VECTOR: u8 = 41;
    pub(super) const SPECIFIER: u8 = 42;
    pub(super) const VARIABILITY: u8 = 44;
    pub(super) const TIME_SAMPLES: u8 = 46;
}

/// What specs are.
mod spec {
    pub(super) const ATTRIBUTE: u32 = 1;
    pub(super) const PRIM: u32 = 6;
    pub(super) const ROOT: u32 = 7;
    pub(super) const RELATIONSHIP: u32 = 8;
}

/// Plain values.
const KINDS: [(u8, Kind); 31] = {
    const fn several(base: Base, shape: Shape) -> Kind {
        Kind { base, shape }
    }
    use Base::{Double, Float, Half, Int};
    [
        (1, Kind::one(Base::Bool)),
        (2, Kind::one(Base::UChar)),
        (3, Kind::one(Int)),
        (4, Kind::one(Base::UInt)),
        (5, Kind::one(Base::Int64)),
        (6, Kind::one(Base::UInt64)),
        (7, Kind::one(Half)),
        (8, Kind::one(Float)),
        (9, Kind::one(Double)),
        (10, Kind::one(Base::String)),
        (11, Kind::one(Base::Token)),
        (12, Kind::one(Base::Asset)),
        (13, several(Double, Shape::Matrix(2))),
        (14, several(Double, Shape::Matrix(3))),
        (15, several(Double, Shape::Matrix(4))),
        (16, several(Double, Shape::Quaternion)),
        (17, several(Float, Shape::Quaternion)),
        (18, several(Half, Shape::Quaternion)),
        (19, Kind::tuple(Double, 2)),
        (20, Kind::tuple(Float, 2)),
        (21, Kind::tuple(Half, 2)),
        (22, Kind::tuple(Int, 2)),
        (23, Kind::tuple(Double, 3)),
        (24, Kind::tuple(Float, 3)),
        (25, Kind::tuple(Half, 3)),
        (26, Kind::tuple(Int, 3)),
        (27, Kind::tuple(Double, 4)),
        (28, Kind::tuple(Float, 4)),
        (29, Kind::tuple(Half, 4)),
        (30, Kind::tuple(Int, 4)),
        (56, Kind::one(Base::TimeCode)),
    ]
};
