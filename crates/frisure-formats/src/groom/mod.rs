//! Grooms: hair in the files of other programs.
//!
//! Each format is one module with its declaration. To add a format, write its module and name it in [`Format::ALL`]; help, error
//! messages and lists derive from the declaration. [`Format`] selects a format by its extension, and `docs/formats.md` describes
//! their bytes. Readers check counts, sizes and widths, and that all points are finite.

#[cfg(feature = "alembic")]
mod alembic;
pub mod attributes;
mod checked;
mod curves;
mod data;
mod fit;
mod format;
mod gltf;
mod hair;
mod html;
mod lines;
mod mitsuba;
mod motion;
mod npz;
mod obj;
mod pbrt;
mod ply;
mod program;
mod usc;
#[cfg(feature = "usd")]
mod usd;

use std::path::{Path, PathBuf};

use frisure_files::frame::FrameChoice;
use frisure_files::{self as files, ReadError, WriteError, write_atomically};
use thiserror::Error;

pub use checked::MAX_STRANDS;
pub use data::{Groom, HairColour};
pub use fit::{Fit, FitError, Fitted, Points};
pub use format::Format;
use motion::Samples;
pub use motion::{Motion, MotionError};
pub use program::{Program, ProgramError};

/// Largest file that is read (bytes).
pub const MAX_SIZE: u64 = 8 << 30;

/// Why a groom could not be written or read.
#[derive(Debug, Error)]
pub enum GroomError {
    /// The extension names no known format.
    #[error("`{}` has no known groom extension; known are {}", path.display(), known(|_| true))]
    Extension {
        /// The path given.
        path: PathBuf,
    },
    /// The format is written, but not read.
    #[error("`{}` cannot be read: of grooms, only {} can", path.display(), known(Format::is_read))]
    Unread {
        /// The path given.
        path: PathBuf,
    },
    /// The format cannot hold these strands.
    #[error("a .{format} file cannot hold {what}")]
    CannotHold {
        /// The extension of the format.
        format: &'static str,
        /// What it has no room for.
        what: String,
    },
    /// The specification of the format prescribes another unit or up axis than those chosen.
    #[error("a .{format} file is in metres, {up} up, by its specification")]
    Frame {
        /// The extension of the format.
        format: &'static str,
        /// The up axis that it prescribes.
        up: &'static str,
    },
    /// The file is not what its name says, or is damaged.
    #[error("`{}` is not a usable .{format} file: {what}", path.display())]
    Malformed {
        /// The path read.
        path: PathBuf,
        /// The extension of the format expected.
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

impl GroomError {
    /// Whether another unit of the file may mend it: its hair has a size or a place that no hair has.
    #[must_use]
    pub fn may_be_of_unit(&self) -> bool {
        matches!(self, Self::Malformed { what, .. } if checked::may_be_of_unit(what))
    }
}

fn known(which: impl Fn(Format) -> bool) -> String {
    let names = Format::ALL.iter().filter(|f| which(**f)).flat_map(|f| f.extensions());
    names.map(|e| format!(".{e}")).collect::<Vec<_>>().join(", ")
}

impl Format {
    /// All formats; a new format is a file of its own and a line here.
    pub const ALL: &[Self] = &[
        Self(&hair::FORMAT),
        Self(&obj::FORMAT),
        Self(&ply::FORMAT),
        #[cfg(feature = "usd")]
        Self(&usd::USDC),
        #[cfg(feature = "usd")]
        Self(&usd::USDA),
        #[cfg(feature = "usd")]
        Self(&usd::USDZ),
        #[cfg(feature = "alembic")]
        Self(&alembic::FORMAT),
        Self(&usc::FORMAT),
        Self(&npz::FORMAT),
        Self(&mitsuba::FORMAT),
        Self(&pbrt::FORMAT),
        Self(&gltf::FORMAT),
        Self(&html::FORMAT),
    ];

    /// The format of an extension without a dot, in any case of letters.
    #[must_use]
    pub fn named(extension: &str) -> Option<Self> {
        let names = |f: &&Self| f.extensions().iter().any(|e| e.eq_ignore_ascii_case(extension));
        Self::ALL.iter().find(names).copied()
    }

    /// Checks that a file of the format can have the unit and axes of `choice`: glTF prescribes metres with y up, and a
    /// page has metres with z up.
    ///
    /// # Errors
    /// [`GroomError::Frame`].
    pub fn check_frame(self, choice: FrameChoice) -> Result<(), GroomError> {
        // Only these prescribe both; other formats state them in the file, or leave them to their readers.
        let prescribes =
            [gltf::FORMAT.extensions, html::FORMAT.extensions].contains(&self.0.extensions);
        if !prescribes || choice.or(self.frame()) == self.frame() {
            return Ok(());
        }
        Err(GroomError::Frame { format: self.extension(), up: self.frame().up.name() })
    }

    /// Whether files of the format state their unit.
    #[must_use]
    pub fn states_unit(self) -> bool {
        ["usdc", "usda", "usdz", "abc", "npz"].contains(&self.extension())
    }

    /// Whether a file of the format can hold what holds the hair, as meshes.
    #[must_use]
    pub fn holds_accessories(self) -> bool {
        ["usd", "usda", "usdc", "usdz", "abc", "glb", "obj"].contains(&self.extension())
    }

    /// Checks that a file of the format can hold accessories.
    ///
    /// # Errors
    /// [`GroomError::CannotHold`], listing the formats that can.
    pub fn check_accessories(self) -> Result<(), GroomError> {
        if self.holds_accessories() {
            return Ok(());
        }
        let what = format!("accessories; {} can", known(Self::holds_accessories));
        Err(GroomError::CannotHold { format: self.extension(), what })
    }

    /// Checks that a file of the format can hold strands at several times: see [`Motion`].
    ///
    /// # Errors
    /// [`GroomError::CannotHold`], listing the formats that can.
    pub fn check_motion(self) -> Result<(), GroomError> {
        if self.0.moves {
            return Ok(());
        }
        let what = format!("several times; {} can", known(|f| f.0.moves));
        Err(GroomError::CannotHold { format: self.extension(), what })
    }

    /// The format that a path's extension names.
    ///
    /// # Errors
    /// [`GroomError::Extension`], listing those that are known.
    pub fn of(path: &Path) -> Result<Self, GroomError> {
        let extension = path.extension().and_then(|e| e.to_str());
        let found = extension.and_then(Self::named);
        found.ok_or_else(|| GroomError::Extension { path: path.into() })
    }
}

/// Writes a groom in the format that the path's extension names, atomically.
///
/// # Errors
/// [`GroomError`].
pub fn write_groom(path: &Path, groom: &Groom, choice: FrameChoice) -> Result<(), GroomError> {
    let format = Format::of(path)?;
    check(format, groom, choice)?;
    let samples = Samples::still(groom);
    write_atomically(path, |out| (format.0.write)(out, &samples, choice.or(format.frame())))?;
    Ok(())
}

/// Writes hair that moves in the format that the path's extension names, atomically: its first sample as
/// [`write_groom`] does, with points and widths at all times.
///
/// Alembic has the times in seconds; a stage has 24 time codes in a second.
///
/// # Errors
/// [`GroomError`]; [`GroomError::CannotHold`] for a format whose files have one time only.
pub fn write_motion(path: &Path, motion: &Motion, choice: FrameChoice) -> Result<(), GroomError> {
    let format = Format::of(path)?;
    format.check_motion()?;
    check(format, motion.first(), choice)?;
    let samples = Samples::of(motion);
    write_atomically(path, |out| (format.0.write)(out, &samples, choice.or(format.frame())))?;
    Ok(())
}

/// The bytes of a groom file, the same that [`write_groom`] writes.
///
/// # Errors
/// [`GroomError::CannotHold`], [`GroomError::Frame`].
pub fn encode(format: Format, groom: &Groom, choice: FrameChoice) -> Result<Vec<u8>, GroomError> {
    check(format, groom, choice)?;
    let mut bytes = Vec::new();
    // Memory takes all bytes.
    (format.0.write)(&mut bytes, &Samples::still(groom), choice.or(format.frame()))
        .map_err(|source| WriteError::Io { path: PathBuf::new(), source })?;
    Ok(bytes)
}

/// Checks that a format has room for a groom, and has the unit and axes.
fn check(format: Format, groom: &Groom, choice: FrameChoice) -> Result<(), GroomError> {
    format.check_frame(choice)?;
    if !groom.accessories.is_empty() {
        format.check_accessories()?;
    }
    let checked = checked::check_lines(groom).and_then(|()| (format.0.check)(groom));
    checked.map_err(|what| GroomError::CannotHold { format: format.extension(), what })
}

/// Reads a groom from a file in the format that the path's extension names.
///
/// # Errors
/// [`GroomError`], for a format that is only written, or a file that is not what its name says.
pub fn read_groom(path: &Path, choice: FrameChoice) -> Result<Groom, GroomError> {
    let format = Format::of(path)?;
    if !format.is_read() {
        return Err(GroomError::Unread { path: path.into() });
    }
    let bytes = files::read_bytes(path, MAX_SIZE, "a groom")?;
    decode(format, &bytes, path, choice)
}

/// A groom from the bytes of a file; `path` is what errors call it.
///
/// # Errors
/// As [`read_groom`].
pub fn decode(
    format: Format,
    bytes: &[u8],
    path: &Path,
    choice: FrameChoice,
) -> Result<Groom, GroomError> {
    let Some(read) = format.0.read else { return Err(GroomError::Unread { path: path.into() }) };
    let groom = read(bytes, choice);
    let groom = groom.and_then(|groom| {
        checked::check_following(&groom)?;
        Ok(groom)
    });
    groom.map_err(|what| GroomError::Malformed {
        path: path.into(),
        format: format.extension(),
        what,
    })
}
