//! The declaration of a groom format.

use std::fmt;
use std::io::{self, Write};

use frisure_files::frame::{Frame, FrameChoice};

use super::data::Groom;
use super::motion::Samples;

/// Reads a groom from the bytes of a file, or returns what is wrong with them.
pub(super) type Reader = fn(&[u8], FrameChoice) -> Result<Groom, String>;

/// Writes a groom that has been checked, at one time or, if the format can, at several.
pub(super) type Writer = fn(&mut dyn Write, &Samples<'_>, Frame) -> io::Result<()>;

/// A groom format; help, error messages and lists derive from it.
pub(super) struct Declaration {
    /// The extensions that name it, without a dot; the first is the one to show.
    pub(super) extensions: &'static [&'static str],
    /// The name that programs show.
    pub(super) title: &'static str,
    /// Unit and axes by convention, for files that state none.
    pub(super) frame: Frame,
    /// Whether a file can hold guides besides hairs.
    pub(super) holds_guides: bool,
    /// The number of points per strand that its readers require, if they require one.
    pub(super) usual_points: Option<usize>,
    /// The most hairs that its readers show well, if there is such a number.
    pub(super) most_hairs: Option<usize>,
    /// Checks that the format can hold a groom.
    pub(super) check: fn(&Groom) -> Result<(), String>,
    /// Writes what `check` has passed.
    pub(super) write: Writer,
    /// Whether a file can hold strands at several times.
    pub(super) moves: bool,
    /// Reads a groom; none where the format is only written.
    pub(super) read: Option<Reader>,
}

/// A groom format, one of [`Format::ALL`].
///
/// ```
/// use frisure_formats::groom::Format;
///
/// let format = Format::of("curls.npz".as_ref())?;
/// assert_eq!(format.extensions(), ["npz"]);
/// assert!(format.is_read() && format.holds_guides());
/// # Ok::<(), frisure_formats::groom::GroomError>(())
/// ```
#[derive(Clone, Copy)]
pub struct Format(pub(super) &'static Declaration);

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.extension() == other.extension()
    }
}

impl Eq for Format {}

impl fmt::Debug for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Format({})", self.extension())
    }
}

impl Format {
    /// The extensions that name it, without a dot; the first is the one to show.
    #[must_use]
    pub const fn extensions(self) -> &'static [&'static str] {
        self.0.extensions
    }

    /// The extension to show, without a dot.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        self.0.extensions[0]
    }

    /// The name that programs show.
    #[must_use]
    pub const fn title(self) -> &'static str {
        self.0.title
    }

    /// Whether it is read, too.
    #[must_use]
    pub const fn is_read(self) -> bool {
        self.0.read.is_some()
    }

    /// Whether a file can hold guides besides hairs.
    #[must_use]
    pub const fn holds_guides(self) -> bool {
        self.0.holds_guides
    }

    /// The number of points per strand that its readers require, if they require one.
    #[must_use]
    pub const fn usual_points(self) -> Option<usize> {
        self.0.usual_points
    }

    /// The most hairs that its readers show well, if there is such a number.
    #[must_use]
    pub const fn most_hairs(self) -> Option<usize> {
        self.0.most_hairs
    }

    /// That number, if some strand of a groom has another.
    #[must_use]
    pub fn other_points(self, groom: &Groom) -> Option<usize> {
        let mut strands = groom.hairs.iter().chain(groom.guides.iter());
        self.usual_points().filter(|n| strands.any(|strand| strand.points.len() != *n))
    }

    /// Unit and axes by convention, for files that state none.
    #[must_use]
    pub const fn frame(self) -> Frame {
        self.0.frame
    }
}
