//! Archives of Alembic in the Ogawa container: objects and properties, read and written.
//!
//! Knows no hair: what objects mean (curves, transforms) is for the caller. Only the first sample in time is
//! read; properties are written with one sample or with several, evenly apart. The C++ library is the reference; no crate writes Alembic.
//!
//! Whatever is read, no memory is taken for a size that the file does not back up.
//!
//! Source: the Alembic library 1.8.12 (<https://github.com/alembic/alembic>), whose files the tests compare
//! with.
//!
//! ```
//! use frisure_ogawa::read::Archive;
//! use frisure_ogawa::write::{Object, Pod, Property, Sample, write_archive};
//!
//! let count = Sample::of(Pod::U32, 1, 1, |out| out.extend(7_u32.to_le_bytes()));
//! let object = Object {
//!     name: "groom".into(),
//!     metadata: "schema=Example".into(),
//!     properties: vec![Property::scalar("count", "", count)],
//!     children: Vec::new(),
//! };
//! let mut file = Vec::new();
//! write_archive(&mut file, "", None, vec![object])?;
//!
//! let archive = Archive::open(&file)?;
//! let object = &archive.children(&archive.top())?[0];
//! let property = archive.properties(object)?[0];
//! assert_eq!(archive.sample(&property)?, 7_u32.to_le_bytes());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

mod container;
mod murmur;
pub mod parameter;
pub mod read;
pub mod write;
