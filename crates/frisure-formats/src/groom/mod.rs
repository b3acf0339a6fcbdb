//! Grooms: hair in the files of other programs.
//!
//! One module per format; [`Format`] says what each can hold, and `docs/formats.md` tells every byte that
//! matters. What is read has been checked: counts, sizes, widths, points that are nowhere.

mod alembic;
pub mod attributes;
mod checked;
mod gltf;
pub mod hair;
mod lines;
mod mitsuba;
mod npz;
pub mod obj;
mod pbrt;
pub mod ply;
mod usc;
mod usd;

use std::io;
use std::path::{Path, PathBuf};

use frisure_look::Melanin;
use frisure_strands::{Strands, Surface};
use thiserror::Error;

use frisure_files::frame::{Frame, FrameChoice};
use frisure_files::{self as files, ReadError, WriteError, write_atomically};

pub use checked::MAX_STRANDS;

/// What a groom file holds, in metres, z up. Not every format holds all of it: see [`Format`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Groom {
    /// What it is called; may be empty.
    pub name: String,
    /// The hairs, with attributes of the names in [`attributes`]; may be empty.
    pub hairs: Strands,
    /// The guides that they follow, in the order in which `guide` counts them; may be empty.
    pub guides: Strands,
    /// The head that it is rooted in.
    pub head: Option<Surface>,
    /// The colour of its hairs, where they have none of their own.
    pub colour: Option<HairColour>,
}

/// What a picture has to know of the colour of hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairColour {
    /// Its pigment; unknown where hair is dyed.
    pub melanin: Option<Melanin>,
    /// Colour of much of it (linear, primaries of sRGB).
    pub colour: [f32; 3],
}

impl Groom {
    /// A groom of nothing but hairs.
    #[must_use]
    pub fn of(hairs: Strands) -> Self {
        Self { hairs, ..Self::default() }
    }

    /// The groom with so many points a strand, and how far (m) its strands are from what they were: see
    /// [`Strands::resampled`].
    #[must_use]
    pub fn resampled(&self, points: usize) -> (Self, f32) {
        let (hairs, guides) = (self.hairs.resampled(points), self.guides.resampled(points));
        let error = hairs.error.max(guides.error);
        let Self { name, head, colour, .. } = self;
        let (name, head, colour) = (name.clone(), head.clone(), *colour);
        (Self { name, hairs: hairs.strands, guides: guides.strands, head, colour }, error)
    }

    /// The strands for a format that knows one kind: the hairs, or the guides where there are none.
    #[must_use]
    pub fn strands(&self) -> &Strands {
        if self.hairs.is_empty() { &self.guides } else { &self.hairs }
    }
}

/// Largest file that is read (bytes).
pub const MAX_SIZE: u64 = 8 << 30;

/// Why a groom could not be written or read.
#[derive(Debug, Error)]
pub enum GroomError {
    /// The extension names no known format.
    #[error("`{}` has no known groom extension; known are {}", path.display(), known(|_| true))]
    Extension {
        /// The path asked for.
        path: PathBuf,
    },
    /// The format is written, but not read.
    #[error("`{}` cannot be read: of grooms, only {} can", path.display(), known(Format::is_read))]
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
    #[error("`{}` is not a usable {format} file: {what}", path.display())]
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

fn known(which: impl Fn(Format) -> bool) -> String {
    let names = Format::ALL.into_iter().filter(|f| which(*f)).flat_map(Format::extensions);
    names.map(|e| format!(".{e}")).collect::<Vec<_>>().join(", ")
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
    /// Universal Scene Description, binary.
    Usdc,
    /// Universal Scene Description, as text.
    Usda,
    /// Universal Scene Description, a package.
    Usdz,
    /// Alembic in the Ogawa container, as Unreal's specification of grooms has it.
    Alembic,
    /// `.data` of USC-HairSalon, for what learns from hairstyles.
    Usc,
    /// Arrays of `NumPy`.
    Npz,
    /// Text of Mitsuba 3's curves.
    Mitsuba,
    /// Curves of pbrt-v4.
    Pbrt,
    /// Lines of glTF, binary.
    Gltf,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Hair,
        Self::Obj,
        Self::Ply,
        Self::Usdc,
        Self::Usda,
        Self::Usdz,
        Self::Alembic,
        Self::Usc,
        Self::Npz,
        Self::Mitsuba,
        Self::Pbrt,
        Self::Gltf,
    ];

    /// The extensions that name it, without a dot; the first is the one to show.
    #[must_use]
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Hair => &["hair"],
            Self::Obj => &["obj"],
            Self::Ply => &["ply"],
            Self::Usdc => &["usdc", "usd"],
            Self::Usda => &["usda"],
            Self::Usdz => &["usdz"],
            Self::Alembic => &["abc"],
            Self::Usc => &["data"],
            Self::Npz => &["npz"],
            Self::Mitsuba => &["txt"],
            Self::Pbrt => &["pbrt"],
            Self::Gltf => &["glb"],
        }
    }

    /// What it is, in a few words for a person.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Hair => "Cem Yuksel's hair file",
            Self::Obj => "Wavefront polylines",
            Self::Ply => "Stanford points and edges",
            Self::Usdc => "Universal Scene Description, binary",
            Self::Usda => "Universal Scene Description, text",
            Self::Usdz => "Universal Scene Description, package",
            Self::Alembic => "Alembic curves for Unreal, Blender, Houdini and Maya",
            Self::Usc => "hairstyles of USC-HairSalon",
            Self::Npz => "arrays for NumPy",
            Self::Mitsuba => "curves for Mitsuba 3",
            Self::Pbrt => "curves for pbrt-v4",
            Self::Gltf => "glTF lines for the web",
        }
    }

    /// Whether it is read, too.
    #[must_use]
    pub fn is_read(self) -> bool {
        match self {
            Self::Hair | Self::Obj | Self::Ply => true,
            Self::Usdc | Self::Usda | Self::Usdz | Self::Alembic | Self::Usc | Self::Npz => true,
            Self::Mitsuba | Self::Pbrt | Self::Gltf => false,
        }
    }

    /// Whether it tells guides from hairs, so that a file can hold both.
    #[must_use]
    pub fn tells_guides(self) -> bool {
        match self {
            Self::Alembic | Self::Npz | Self::Gltf => true,
            Self::Hair | Self::Obj | Self::Ply => false,
            Self::Usdc | Self::Usda | Self::Usdz => true,
            Self::Usc | Self::Mitsuba | Self::Pbrt => false,
        }
    }

    /// How many points its readers expect a strand to have, where it matters to them.
    #[must_use]
    pub fn usual_points(self) -> Option<usize> {
        match self {
            Self::Hair | Self::Obj | Self::Ply => None,
            Self::Usdc | Self::Usda | Self::Usdz | Self::Alembic => None,
            Self::Usc => Some(100),
            Self::Npz | Self::Mitsuba | Self::Pbrt | Self::Gltf => None,
        }
    }

    /// Unit and axes that it has by convention, where neither file nor person says anything else.
    #[must_use]
    pub fn frame(self) -> Frame {
        match self {
            Self::Hair => Frame::CENTIMETRES_Z,
            Self::Obj => Frame::METRES_Y,
            Self::Ply => Frame::METRES_Z,
            Self::Usdc | Self::Usda | Self::Usdz => Frame::METRES_Z,
            Self::Alembic => Frame::CENTIMETRES_Y,
            Self::Usc => Frame::METRES_Y,
            Self::Npz => Frame::METRES_Z,
            Self::Mitsuba => Frame::METRES_Y,
            Self::Pbrt => Frame::METRES_Y,
            Self::Gltf => Frame::METRES_Y,
        }
    }

    /// The format that a path's extension names.
    ///
    /// # Errors
    /// [`GroomError::Extension`], listing those that are known.
    pub fn of(path: &Path) -> Result<Self, GroomError> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        let named = |f: &Self| extension.as_deref().is_some_and(|e| f.extensions().contains(&e));
        Self::ALL.into_iter().find(named).ok_or_else(|| GroomError::Extension { path: path.into() })
    }

    /// How errors call it, such as `.hair`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hair => ".hair",
            Self::Obj => ".obj",
            Self::Ply => ".ply",
            Self::Usdc => ".usdc",
            Self::Usda => ".usda",
            Self::Usdz => ".usdz",
            Self::Alembic => ".abc",
            Self::Usc => ".data",
            Self::Npz => ".npz",
            Self::Mitsuba => ".txt",
            Self::Pbrt => ".pbrt",
            Self::Gltf => ".glb",
        }
    }
}

/// Writes a groom in the format that the path's extension names, atomically.
///
/// # Errors
/// [`GroomError`].
pub fn write_groom(path: &Path, groom: &Groom, choice: FrameChoice) -> Result<(), GroomError> {
    let format = Format::of(path)?;
    check(format, groom)?;
    write_atomically(path, |out| fill(format, out, groom, choice.or(format.frame())))?;
    Ok(())
}

/// The bytes of a groom file, the same that [`write_groom`] writes.
///
/// # Errors
/// [`GroomError::CannotHold`].
pub fn encode(format: Format, groom: &Groom, choice: FrameChoice) -> Result<Vec<u8>, GroomError> {
    check(format, groom)?;
    let mut bytes = Vec::new();
    // Memory takes all bytes.
    fill(format, &mut bytes, groom, choice.or(format.frame()))
        .map_err(|source| WriteError::Io { path: PathBuf::new(), source })?;
    Ok(bytes)
}

/// Checks that a format has room for a groom.
fn check(format: Format, groom: &Groom) -> Result<(), GroomError> {
    let checked = match format {
        Format::Hair => hair::check(groom.strands()),
        Format::Obj => Ok(()),
        Format::Ply => ply::check(groom.strands()),
        Format::Usdc | Format::Usda | Format::Usdz => usd::check(groom),
        Format::Alembic => alembic::check(groom),
        Format::Usc => usc::check(groom.strands()),
        Format::Npz => Ok(()),
        Format::Mitsuba => mitsuba::check(groom.strands()),
        Format::Pbrt => pbrt::check(groom.strands()),
        Format::Gltf => gltf::check(groom),
    };
    checked.map_err(|what| GroomError::CannotHold { format: format.name(), what })
}

/// Writes what [`check`] has passed.
fn fill(format: Format, out: &mut dyn io::Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    match format {
        Format::Hair => hair::encode(out, groom.strands(), frame),
        Format::Obj => obj::encode(out, groom.strands(), frame),
        Format::Ply => ply::encode(out, groom.strands(), frame),
        Format::Usdc => usd::encode_binary(out, groom, frame),
        Format::Usda => usd::encode_text(out, groom, frame),
        Format::Usdz => usd::encode_package(out, groom, frame),
        Format::Alembic => alembic::encode(out, groom, frame),
        Format::Usc => usc::encode(out, groom.strands(), frame),
        Format::Npz => npz::encode(out, groom, frame),
        Format::Mitsuba => mitsuba::encode(out, groom.strands(), frame),
        Format::Pbrt => pbrt::encode(out, groom.strands(), frame),
        Format::Gltf => gltf::encode(out, groom, frame),
    }
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
    let groom = match format {
        Format::Hair => hair::decode(bytes, choice),
        Format::Usdc | Format::Usda | Format::Usdz => usd::decode(bytes, choice),
        Format::Alembic => alembic::decode(bytes, choice),
        Format::Obj => obj::decode(bytes, choice),
        Format::Ply => ply::decode(bytes, choice),
        Format::Usc => usc::decode(bytes, choice),
        Format::Npz => npz::decode(bytes, choice),
        Format::Mitsuba | Format::Pbrt | Format::Gltf => {
            return Err(GroomError::Unread { path: path.into() });
        }
    };
    let groom = groom.and_then(|groom| {
        checked::check_following(&groom)?;
        Ok(groom)
    });
    groom.map_err(|what| GroomError::Malformed { path: path.into(), format: format.name(), what })
}
