//! A groom, in memory.

use frisure_look::Melanin;
use frisure_strands::{AccessoryMesh, Strands, Surface};

/// The hair of a file, in metres, z up. Not every format holds all of it: see [`super::Format`].
///
/// ```
/// use frisure_files::frame::FrameChoice;
/// use frisure_formats::groom::{Format, Groom, decode, encode};
/// use frisure_strands::Strands;
/// use glam::Vec3;
///
/// let mut hairs = Strands::new();
/// hairs.push(&[Vec3::ZERO, Vec3::new(0.0, 0.0, -0.1)], &[35e-6; 2]);
/// let format = Format::named("hair").unwrap();
/// let bytes = encode(format, &Groom::of(hairs), FrameChoice::default())?;
/// let read = decode(format, &bytes, "curls.hair".as_ref(), FrameChoice::default())?;
/// assert_eq!(read.hairs.len(), 1);
/// # Ok::<(), frisure_formats::groom::GroomError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Groom {
    /// Its name; may be empty.
    pub name: String,
    /// The hairs, with attributes of the names in [`super::attributes`]; may be empty.
    pub hairs: Strands,
    /// The guides that they follow, in the order in which `guide` counts them; may be empty.
    pub guides: Strands,
    /// The head that it is rooted in.
    pub head: Option<Surface>,
    /// What holds the hair, for formats of which [`super::Format::holds_accessories`] is true. Readers leave it out.
    pub accessories: Vec<AccessoryMesh>,
    /// The colour of its hairs, where they have none of their own.
    pub colour: Option<HairColour>,
    /// At how many times the file has its points: readers take the first of several, as [`Self::told`] says. 0 of hair that does not move.
    pub times: usize,
}

/// The colour of hair, for pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairColour {
    /// Its pigment; none where hair is dyed.
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

    /// What a person should know of how it was read: that there are several times, of which it is the first.
    #[must_use]
    pub fn told(&self) -> Option<String> {
        let times = self.times;
        (times > 1)
            .then(|| format!("the hair of the file moves: of its {times} times the first is read"))
    }

    /// The strands for a format that holds one kind: the hairs, or the guides where there are no hairs.
    #[must_use]
    pub fn strands(&self) -> &Strands {
        if self.hairs.is_empty() { &self.guides } else { &self.hairs }
    }
}
