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

The batch (TOML) names a scene and the keys of it that differ between heads: over a [grid], or drawn
from ranges, distributions and tables of measured people in [vary]. docs/batch.md describes the keys
and the columns.

The command writes heads in parts of some rows; each part is complete or absent. The same command
keeps existing parts and computes the others; it can be killed at any time. A head depends only on
the batch and its index, not on shards and threads. A head that cannot be computed is a row with a
message, not an error of the command.";

/// Arguments of `frisure batch`.
#[derive(Args, Debug)]
#[command(after_help = BATCH_EXAMPLES)]
pub(crate) struct Batch {
    /// The batch (TOML).
    pub(crate) spec: PathBuf,

    /// Write the heads into this folder; with --scene, the scene into this file.
    #[arg(long, short, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,

    /// Compute only the i-th of N equal shares, from 1/N to N/N: for N programs or machines that write into
    /// one folder.
    #[arg(long, value_name = "i/N", default_value_t = Shard::WHOLE)]
    pub(crate) shard: Shard,

    /// Print the parameters of all heads as CSV in SI units, and compute nothing.
    #[arg(long, conflicts_with = "output")]
    pub(crate) list: bool,

    /// Write the scene of the head with this number, from 0, to standard output or to the file of -o:
    /// `frisure predict` then computes all its hairs.
    #[arg(long, value_name = "INDEX", conflicts_with_all = ["list", "shard"])]
    pub(crate) scene: Option<usize>,
}
