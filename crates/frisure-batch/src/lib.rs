//! Computes batches of heads and writes them as Parquet.
//!
//! A [`Batch`] says what varies; a [`Run`] computes one [`Shard`] of it into a folder, part by part. A part
//! is a Parquet file of neighbouring heads, written atomically. A run skips the parts that exist, and so resumes a run that
//! was killed. The bytes of a part follow from the batch alone, on any number of shards and threads. A head that fails is a
//! row with the message of the error. If the batch has views, the pictures and maps of a part are in a second file, which is written
//! before the part.
//!
//! ```
//! use frisure_batch::{Batch, Run, Shard};
//!
//! let text = r#"
//!     samples = 2
//!     volume = false
//!     [set]
//!     "wisps.count" = 3
//!     [vary]
//!     "hair.length" = { from = "3 cm", to = "6 cm" }
//! "#;
//! let batch = Batch::parse("lengths", text, "".as_ref())?;
//! let folder = tempfile::tempdir()?;
//! let done = Run::new(batch, folder.path(), Shard::WHOLE)?.all(&())?;
//! assert_eq!((done.heads, done.failed), (2, 0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

mod head;
mod parquet;
mod part;
mod row;
mod run;
mod shard;
mod view;

pub use frisure::scene::batch::{Batch, Kind, Sample, Value};
pub use part::Part;
pub use row::{Measured, Row};
pub use run::{BatchError, Done, Run};
pub use shard::{Shard, ShardError};
