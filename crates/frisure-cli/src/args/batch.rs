//! The command line of `frisure batch`.

use std::path::PathBuf;

use clap::Args;
use frisure_batch::Shard;

const BATCH_EXAMPLES: &str = "\
Examples:
  frisure batch people.toml -o heads
  frisure batch people.toml -o heads --shard 3/100
  frisure batch people.toml --list > heads.csv
  frisure batch people.toml --scene 4711 -o head.toml && frisure predict head.toml -o head.abc

The batch (TOML) names a scene, keys of it, and how they differ from head to head: over a [grid], or
drawn from ranges, distributions and tables of measured people in [vary]. docs/batch.md tells how,
and what the columns are.

Heads are written in parts of some rows, each whole or not there. The same command leaves those
that are there and computes the others; it may be killed at any time. What a head is follows from
the batch and its number alone, whatever the shards and threads. A head that cannot be is a row
that says why, and no error.";

/// Arguments of `frisure batch`.
#[derive(Args, Debug)]
#[command(after_help = BATCH_EXAMPLES)]
pub(crate) struct Batch {
    /// The batch (TOML).
    pub(crate) spec: PathBuf,

    /// Write the heads into this folder; with --scene, the scene into this file.
    #[arg(long, short, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,

    /// Only the i-th of N equal shares, from 1/N to N/N: for as many programs or machines at a time,
    /// into one folder.
    #[arg(long, value_name = "i/N", default_value_t = Shard::WHOLE)]
    pub(crate) shard: Shard,

    /// Print what the heads would be, with commas between, SI units, and compute nothing.
    #[arg(long, conflicts_with = "output")]
    pub(crate) list: bool,

    /// Write the scene of the head with this number, from 0, to standard output or to the file of -o:
    /// `frisure predict` makes all its hairs again.
    #[arg(long, value_name = "INDEX", conflicts_with_all = ["list", "shard"])]
    pub(crate) scene: Option<usize>,
}
