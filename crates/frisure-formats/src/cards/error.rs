//! What can be wrong with a file of cards.

use std::path::PathBuf;

use frisure_files::WriteError;
use thiserror::Error;

/// Extensions of cards, without dots.
pub const EXTENSIONS: &[&str] = &[
    "glb",
    "obj",
    #[cfg(feature = "usd")]
    "usdc",
    #[cfg(feature = "usd")]
    "usda",
];

/// Why cards could not be written.
#[derive(Debug, Error)]
pub enum CardsFileError {
    /// The extension names no format of cards.
    #[error("`{}` has no known extension of cards; known are .{}", path.display(), EXTENSIONS.join(", ."))]
    Extension {
        /// The path given.
        path: PathBuf,
    },
    /// The file would be larger than its format can be.
    #[error("{size} bytes of cards and textures: a .glb file has at most 4 GiB")]
    Size {
        /// Bytes.
        size: u64,
    },
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
