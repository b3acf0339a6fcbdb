//! Batches: tens of thousands of heads as data.
//!
//! A [`Batch`] says what varies; a [`Run`] computes one [`Shard`] of it into a folder, part by part. A part
//! is a Parquet file of neighbouring heads. It is written aside and renamed, so that it is whole or not
//! there; a run leaves what is there already, and so goes on where another was killed. Which heads are in a
//! part, and every byte of it, follow from the batch alone, whatever the shards and threads. A head that
//! cannot be is a row that says why.
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
mod run;
mod shard;

pub use frisure::scene::batch::{Batch, Kind, Sample, Value};
pub use head::{Measured, Row};
pub use part::Part;
pub use run::{BatchError, Done, Run};
pub use shard::{Shard, ShardError};
