//! Grooms: strands in the formats that other programs read.
//!
//! | extension | what is in it | unit, axes |
//! | --- | --- | --- |
//! | `.hair` | points, thickness, colour | cm, z up |
//! | `.obj` | polylines | m, y up |
//! | `.ply` | points with radius and strand number, edges | m, z up |

pub mod hair;
pub mod obj;
pub mod ply;

use std::io;
use std::path::{Path, PathBuf};

use frisure_strands::Strands;
use thiserror::Error;

use crate::files::{ReadError, WriteError, write_atomically};

/// Extensions that grooms can be written with.
pub const EXTENSIONS: [&str; 3] = ["hair", "obj", "ply"];

/// Why a groom could not be written or read.
#[derive(Debug, Error)]
pub enum GroomError {
    /// The extension names no known format.
    #[error(
        "`{}` has no known groom extension; known are {}",
        path.display(),
        known()
    )]
    Extension {
        /// The path asked for.
        path: PathBuf,
    },
    /// The format is written, but not read.
    #[error("`{}` cannot be read: of grooms, only .hair can", path.display())]
    Unread {
        /// The path asked for.
        path: PathBuf,
    },
    /// The format cannot hold these strands.
    #[error("a {format} file cannot hold {what}")]
    CannotHold {
        /// The format, such as `.hair`.
        format: &'static str,
        /// What it has no room for.
        what: String,
    },
    /// The file is not what its name says, or is damaged.
    #[error("`{}` is not a {format} file: {what}", path.display())]
    Malformed {
        /// The path read.
        path: PathBuf,
        /// The format expected.
        format: &'static str,
        /// What is wrong.
        what: String,
    },
    /// The file could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

fn known() -> String {
    EXTENSIONS.map(|e| format!(".{e}")).join(", ")
}

/// A groom format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Cem Yuksel's binary format.
    Hair,
    /// Wavefront polylines.
    Obj,
    /// Stanford polygons, binary.
    Ply,
}

impl Format {
    /// The format that a path's extension names.
    ///
    /// # Errors
    /// [`GroomError::Extension`], listing those that are known.
    pub fn of(path: &Path) -> Result<Self, GroomError> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("hair") => Ok(Self::Hair),
            Some("obj") => Ok(Self::Obj),
            Some("ply") => Ok(Self::Ply),
            _ => Err(GroomError::Extension { path: path.into() }),
        }
    }
}

/// Writes strands in the format that the path's extension names, atomically.
///
/// # Errors
/// [`GroomError`].
pub fn write_groom(path: &Path, strands: &Strands) -> Result<(), GroomError> {
    let fill = encoder(Format::of(path)?, strands)?;
    write_atomically(path, |out| fill(out, strands))?;
    Ok(())
}

/// The bytes of a groom file, the same that [`write_groom`] writes.
///
/// # Errors
/// [`GroomError::CannotHold`].
pub fn encode(format: Format, strands: &Strands) -> Result<Vec<u8>, GroomError> {
    let fill = encoder(format, strands)?;
    let mut bytes = Vec::new();
    // Memory takes all bytes.
    fill(&mut bytes, strands).map_err(|source| WriteError::Io { path: PathBuf::new(), source })?;
    Ok(bytes)
}

/// Writes strands to anything.
type Encoder = fn(&mut dyn io::Write, &Strands) -> io::Result<()>;

/// What writes strands in a format, if it can hold them.
fn encoder(format: Format, strands: &Strands) -> Result<Encoder, GroomError> {
    Ok(match format {
        Format::Hair => {
            hair::check(strands)?;
            hair::encode
        }
        Format::Obj => obj::encode,
        Format::Ply => {
            ply::check(strands)?;
            ply::encode
        }
    })
}

/// Reads strands from a file in the format that the path's extension names. So far that is `.hair`.
///
/// # Errors
/// [`GroomError`], for a format that is only written, or a file that is not what its name says.
pub fn read_groom(path: &Path) -> Result<Strands, GroomError> {
    match Format::of(path)? {
        Format::Hair => hair::read(path),
        Format::Obj | Format::Ply => Err(GroomError::Unread { path: path.into() }),
    }
}
